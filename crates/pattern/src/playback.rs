//! Playback: interpolates the planned knots.

use gait::{Speed, interpolate};
use interface::HalfStep;
use model::{Motion, Side};
use nalgebra::Vector2;

use crate::knot::{KNOT, Knot};
use crate::speed_override::SpeedOverride;

/// The last four knots, and the present among them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Playback {
    /// Oldest first; the present lies between the second and the third.
    knots: [Knot; 4],
    /// Time since the second knot (s).
    elapsed: f64,
    /// A commanded speed that is not planned yet.
    speed_override: Option<SpeedOverride>,
}

impl Playback {
    /// At the second of four knots.
    pub(crate) fn new(knots: [Knot; 4]) -> Self {
        Self { knots, elapsed: 0.0, speed_override: None }
    }

    /// The newest knot, after which the next one is planned.
    pub(crate) fn newest(&self) -> &Knot {
        &self.knots[3]
    }

    /// Replaces the oldest knot by a new one.
    pub(crate) fn push(&mut self, knot: Knot) {
        self.knots.rotate_left(1);
        self.knots[3] = knot;
    }

    /// Advances by `dt` (s).
    pub(crate) fn advance(&mut self, dt: f64) {
        let planned = self.planned_speed(self.elapsed + dt / 2.0);
        let rate = self.speed_override.as_mut().map_or(1.0, |speed| speed.advance(dt, planned));
        self.elapsed += dt * rate;
    }

    /// Whether the present has reached the third knot. Then that knot becomes the second one, and the next one must be
    /// [pushed](Self::push).
    pub(crate) fn passes_knot(&mut self) -> bool {
        let passes = self.elapsed >= KNOT;
        if passes {
            self.elapsed -= KNOT;
            self.speed_override = self.speed_override.take().and_then(SpeedOverride::after_knot);
        }
        passes
    }

    /// Goes to a share of the time from the second knot to the third.
    pub(crate) fn seek(&mut self, share: f64) {
        self.elapsed = KNOT * share;
    }

    /// Whether the support changes between any two of the four knots.
    pub(crate) fn is_near_support_change(&self) -> bool {
        let [before, .., after] = &self.knots;
        after.phase.floor() > before.phase
    }

    /// Share of the time from the second knot to the third at which the support changes, if it does.
    pub(crate) fn share_at_support_change(&self) -> Option<f64> {
        let [_, from, to, _] = &self.knots;
        let landing = to.phase.floor();
        (landing > from.phase).then(|| (landing - from.phase) / (to.phase - from.phase))
    }

    /// Time since the second knot (s).
    pub(crate) fn elapsed(&self) -> f64 {
        self.elapsed
    }

    /// Changes to another speed at once, from the present one.
    ///
    /// * `planned` – the speed at the newest knot
    /// * `target` – the commanded speed factor
    pub(crate) fn override_speed(&mut self, planned: &Speed, target: f64) {
        let now = self.speed_override.take().map_or_else(|| planned.rewound(self.lead()), |speed| speed.speed());
        self.speed_override = Some(SpeedOverride::begin(now, target));
    }

    /// Returns to the planned speed.
    pub(crate) fn cancel_speed_override(&mut self) {
        self.speed_override = None;
    }

    /// Lets the override end when the first knot of a plan that contains its speed is played.
    ///
    /// * `target` – the speed factor in force by that plan
    pub(crate) fn end_override_with_plan(&mut self, target: f64) {
        self.speed_override = self.speed_override.take().map(|speed| speed.planned(target));
    }

    /// The overriding speed as it will be at the newest knot.
    ///
    /// * `target` – the commanded speed factor
    pub(crate) fn overriding_speed_at_newest(&self, target: f64) -> Option<Speed> {
        self.speed_override.as_ref().map(|over| {
            let mut speed = over.speed();
            speed.request(target);
            speed.advance(self.lead());
            speed
        })
    }

    /// The present half-step.
    ///
    /// * `newest` – the half-step at the newest knot
    pub(crate) fn half_step(&self, newest: HalfStep) -> HalfStep {
        let [_, from, to, _] = &self.knots;
        let phase = (from.phase + (to.phase - from.phase) * self.share()).max(0.0);
        let index = phase.floor();
        let behind = newest.index.saturating_sub(index as u64);
        HalfStep {
            index: index as u64,
            support: if behind.is_multiple_of(2) { newest.support } else { newest.support.other() },
            progress: phase - index,
        }
    }

    /// The present speed factor.
    pub(crate) fn speed(&self) -> f64 {
        let overriding = self.speed_override.as_ref();
        overriding.map_or_else(|| self.planned_speed(self.elapsed), |over| over.speed().state().value)
    }

    /// The present share of the weight on the support foot.
    pub(crate) fn support_weight_share(&self) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.support_weight_share + (to.support_weight_share - from.support_weight_share) * self.share()
    }

    /// The present motion of the physical joints.
    pub(crate) fn physical_motion(&self) -> Motion {
        let [before, from, to, after] = &self.knots;
        let state = |before: &Knot, here: &Knot, after: &Knot| {
            Motion::between(&before.angles, &here.angles, &after.angles, KNOT)
        };
        interpolate(&state(before, from, to), &state(from, to, after), self.share(), KNOT)
    }

    /// The present lean of the vertical over the floor as planned, and its rate, in the walk frame (-, 1/s).
    pub(crate) fn vertical(&self) -> [Vector2<f64>; 2] {
        let [_, from, to, _] = &self.knots;
        let change = to.vertical - from.vertical;
        [from.vertical + change * self.share(), change / KNOT]
    }

    /// The knot next to the present whose support foot is the present one, on the side `support`.
    pub(crate) fn of_support(&self, support: Side) -> &Knot {
        let [_, from, to, _] = &self.knots;
        if support == from.footprint.side { from } else { to }
    }

    fn planned_speed(&self, elapsed: f64) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.speed + (to.speed - from.speed) * elapsed / KNOT
    }

    /// Share of the way from the second knot to the third.
    fn share(&self) -> f64 {
        self.elapsed / KNOT
    }

    /// Time until the newest knot (s).
    fn lead(&self) -> f64 {
        2.0 * KNOT - self.elapsed
    }
}
