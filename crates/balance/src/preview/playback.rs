//! Playback: the plan as it is played, from knot to knot.

use gait::{HalfStep, Speed, interpolate};
use model::{JointVector, Motion, Side};
use nalgebra::Vector2;

use crate::preview::{Footprint, KNOT, Pace};

/// The last four realised knots, and where now is among them.
#[derive(Clone, Copy, Debug)]
pub struct Playback {
    /// Oldest first; now is between the second and the third.
    knots: [Knot; 4],
    /// Since the second knot [s].
    elapsed: f64,
    /// A speed that is not planned yet.
    pace: Option<Pace>,
}

/// One realised instant.
#[derive(Clone, Copy, Debug)]
pub struct Knot {
    /// Physical joints.
    pub angles: JointVector,
    /// The bearing foot.
    pub footprint: Footprint,
    /// Half-steps since the beginning, with their progress.
    pub place: f64,
    /// The speed factor.
    pub speed: f64,
    /// How the vertical is taken to lean over the floor, in the walk frame: x and y of the unit vector [-].
    pub vertical: Vector2<f64>,
    /// Share of the weight that the bearing foot carries.
    pub weight: f64,
}

impl Playback {
    /// At the second of four knots.
    pub fn new(knots: [Knot; 4]) -> Self {
        Self { knots, elapsed: 0.0, pace: None }
    }

    /// The newest knot: what is planned next comes after it.
    pub fn newest(&self) -> &Knot {
        &self.knots[3]
    }

    /// One more knot takes the place of the oldest.
    pub fn push(&mut self, knot: Knot) {
        self.knots.rotate_left(1);
        self.knots[3] = knot;
    }

    /// Plays on for `dt` [s].
    pub fn advance(&mut self, dt: f64) {
        let planned = self.planned_speed(self.elapsed + dt / 2.0);
        let rate = self.pace.as_mut().map_or(1.0, |pace| pace.advance(dt, planned));
        self.elapsed += dt * rate;
    }

    /// Whether now is at the third knot or beyond, which is the second one then: one more is to be planned.
    pub fn passes_knot(&mut self) -> bool {
        let passes = self.elapsed >= KNOT;
        if passes {
            self.elapsed -= KNOT;
            self.pace = self.pace.take().and_then(Pace::after_knot);
        }
        passes
    }

    /// Since the second knot [s].
    pub fn elapsed(&self) -> f64 {
        self.elapsed
    }

    /// Heads for another speed at once, from the speed there is. `planned` is that of the newest knot.
    pub fn hasten(&mut self, planned: &Speed, target: f64) {
        let now = self.pace.take().map_or_else(|| planned.rewound(self.lead()), |pace| pace.speed());
        self.pace = Some(Pace::new(now, target));
    }

    /// The speed goes on as planned.
    pub fn keep_pace(&mut self) {
        self.pace = None;
    }

    /// The plan is made: what it says about the speed is played once the knots come that it made.
    pub fn is_planned(&mut self, target: f64) {
        self.pace = self.pace.take().map(|pace| Pace::planned(pace.speed(), target));
    }

    /// The speed that was hastened to, as it is at the newest knot.
    pub fn pace_at_newest(&self, target: f64) -> Option<Speed> {
        self.pace.as_ref().map(|pace| {
            let mut speed = pace.speed();
            speed.request(target);
            speed.advance(self.lead());
            speed
        })
    }

    /// Where the walk is now.
    ///
    /// * `newest` – where it is at the newest knot
    pub fn half_step(&self, newest: HalfStep) -> HalfStep {
        let [_, from, to, _] = &self.knots;
        let place = (from.place + (to.place - from.place) * self.share()).max(0.0);
        let index = place.floor();
        let behind = newest.index.saturating_sub(index as u64);
        HalfStep {
            index: index as u64,
            support: if behind.is_multiple_of(2) { newest.support } else { newest.support.other() },
            progress: place - index,
        }
    }

    /// The speed factor of now.
    pub fn speed(&self) -> f64 {
        self.pace.as_ref().map_or_else(|| self.planned_speed(self.elapsed), |pace| pace.speed().state().value)
    }

    /// Share of the weight that the bearing foot is to carry now.
    pub fn weight_on_bearing(&self) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.weight + (to.weight - from.weight) * self.share()
    }

    /// What is asked now, in physical joints.
    pub fn physical_motion(&self) -> Motion {
        let [before, from, to, after] = &self.knots;
        let state = |before: &Knot, here: &Knot, after: &Knot| {
            Motion::between(&before.angles, &here.angles, &after.angles, KNOT)
        };
        interpolate(&state(before, from, to), &state(from, to, after), self.share(), KNOT)
    }

    /// How the vertical is planned to lean over the floor now, and its rate, in the walk frame [-, 1/s].
    pub fn vertical(&self) -> [Vector2<f64>; 2] {
        let [_, from, to, _] = &self.knots;
        let change = to.vertical - from.vertical;
        [from.vertical + change * self.share(), change / KNOT]
    }

    /// The foot that bears now, on the side that does.
    pub fn footprint(&self, support: Side) -> &Footprint {
        let [_, from, to, _] = &self.knots;
        if support == from.footprint.side { &from.footprint } else { &to.footprint }
    }

    fn planned_speed(&self, elapsed: f64) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.speed + (to.speed - from.speed) * elapsed / KNOT
    }

    /// Of the way from the second knot to the third.
    fn share(&self) -> f64 {
        self.elapsed / KNOT
    }

    /// Until the newest knot [s].
    fn lead(&self) -> f64 {
        2.0 * KNOT - self.elapsed
    }
}
