//! Foresight: the whole body is played ahead over the pendulum's plan, to see by how much its ZMP will miss (the second
//! preview of Kajita et al. 2003).

use dynamics::{Batch, LANES, NewtonEuler, zmp};
use model::{JointVector, Motion, Side, Wrench};
use nalgebra::Vector2;

use crate::preview::biped::KNOTS_FORESEEN;
use crate::preview::{Biped, CartState, Course, Footprint, Footwork, KNOT, Outlook, Wanted, WholeBody};

/// The coming knots as the pendulum alone would have them. Played anew when a request changes what is to come; else one
/// knot is added as one is used.
#[derive(Clone, Debug)]
pub struct Foresight {
    /// At the farthest knot.
    footwork: Footwork,
    outlook: Outlook,
    body: WholeBody,
    inverse: NewtonEuler,
    batch: Batch,
    /// A ring: the knot before the present one, the present one, the coming ones.
    knots: [Foreseen; KNOTS_FORESEEN + 2],
    /// What the pendulum leaves out of the ZMP at each of them and the outlook does not expect, in the walk frame [m].
    unexpected: [Vector2<f64>; KNOTS_FORESEEN + 2],
    /// Where in it the present knot is.
    present: usize,
    /// How many knots after the present one are known.
    ahead: usize,
    /// What the correction is to do about all of them, along both axes of the walk frame.
    weighed: Vector2<f64>,
    /// What is to be done next about the farthest one.
    stage: Stage,
}

/// A knot more is seen in parts, so that no tick does all of it.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// How far half-step and pendulum are.
    Pendulum,
    /// Where the feet are then; with the foot that bore at the knot before.
    Feet(Footprint),
    /// The posture that does it.
    Posture(Footprint),
    /// What the pendulum leaves out of the ZMP of the knot before: only then it has a neighbour on either side.
    Zmp(Footprint),
    /// What is to be done about all of it.
    Correction,
}

/// One knot to come.
#[derive(Clone, Copy, Debug)]
struct Foreseen {
    /// The pendulum along x and y of the walk frame.
    com: [CartState; 2],
    /// What the half-steps ask of the posture, with the centre of mass where the pendulum is.
    wanted: Wanted,
    /// The posture that does it, in physical joints.
    angles: JointVector,
    /// What the outlook takes the pendulum to leave out of the ZMP, in the walk frame [m].
    expected: Vector2<f64>,
}

impl Foresight {
    /// Looks ahead from a walk's very beginning.
    pub fn new(biped: &Biped, footwork: &Footwork, com: [CartState; 2], motion: &Motion) -> Self {
        let angles = footwork.physical(biped, &motion.angles);
        let wanted = footwork.wanted(biped, place(&com));
        let now = Foreseen { com, wanted, angles, expected: Vector2::zeros() };
        let before = Foreseen { angles: footwork.physical(biped, &(motion.angles - motion.rates * KNOT)), ..now };
        let mut knots = [before; KNOTS_FORESEEN + 2];
        knots[0] = now;
        let mut foresight = Self {
            outlook: Outlook::new(biped, &footwork.course),
            footwork: footwork.clone(),
            body: WholeBody::new(biped, &motion.angles),
            inverse: NewtonEuler::default(),
            batch: Batch::default(),
            knots,
            unexpected: [Vector2::zeros(); KNOTS_FORESEEN + 2],
            present: 0,
            ahead: 0,
            weighed: Vector2::zeros(),
            stage: Stage::Pendulum,
        };
        foresight.begin(biped, footwork);
        foresight
    }

    /// Looks ahead anew from where the walk is at the present knot.
    pub fn begin(&mut self, biped: &Biped, footwork: &Footwork) {
        self.restart(biped, footwork);
        self.complete(biped);
    }

    /// Forgets what was foreseen: the walk goes on from the present knot by other footwork.
    pub fn restart(&mut self, biped: &Biped, footwork: &Footwork) {
        self.footwork.clone_from(footwork);
        self.outlook.begin(biped, &footwork.course);
        (self.ahead, self.stage) = (0, Stage::Pendulum);
        let [before, now] =
            [self.slot(0) + self.knots.len() - 1, self.slot(0)].map(|slot| self.knots[slot % self.knots.len()].angles);
        self.body = WholeBody::new(biped, &footwork.physical(biped, &now));
        self.body.expect(&footwork.physical(biped, &(now - before)));
    }

    /// Sees all that is to be seen.
    pub fn complete(&mut self, biped: &Biped) {
        while self.missing() >= LANES && matches!(self.stage, Stage::Pendulum) {
            self.extend_by_batch(biped);
        }
        while self.missing() > 0 {
            self.extend(biped);
        }
    }

    /// How many knots are still to be seen.
    pub fn missing(&self) -> usize {
        KNOTS_FORESEEN - self.ahead
    }

    /// Sees a knot more, or what is left of one.
    pub fn extend(&mut self, biped: &Biped) {
        let ahead = self.ahead;
        while self.ahead == ahead {
            self.work(biped);
        }
    }

    /// Sees [`LANES`] knots more, their dynamics at once.
    fn extend_by_batch(&mut self, biped: &Biped) {
        let first = self.ahead;
        let mut footprints = [self.footwork.course.feet.footprint; LANES];
        for (lane, footprint) in footprints.iter_mut().enumerate() {
            self.ahead = first + lane;
            while !matches!(self.stage, Stage::Zmp(_)) {
                self.work(biped);
            }
            if let Stage::Zmp(before) = std::mem::replace(&mut self.stage, Stage::Pendulum) {
                *footprint = before;
                self.batch.set(lane, &self.motion_over(biped, before));
            }
        }
        self.batch.compute(&biped.tree);
        for (lane, footprint) in footprints.into_iter().enumerate() {
            self.ahead = first + lane;
            self.note_missed(biped, footprint, &self.batch.ground(lane));
            self.stage = Stage::Correction;
            self.work(biped);
        }
    }

    /// The next knot becomes the present one; to be seen completely before the next time.
    pub fn advance(&mut self) {
        self.present = self.slot(1);
        self.ahead -= 1;
    }

    /// Sees as much of the knot that is missing as is due when a share of the time to the next knot has passed.
    pub fn keep_up(&mut self, biped: &Biped, share: f64) {
        let done = |stage| match stage {
            Stage::Pendulum => 0.15,
            Stage::Feet(_) => 0.3,
            Stage::Posture(_) => 0.45,
            Stage::Zmp(_) => 0.6,
            Stage::Correction => 0.75,
        };
        while self.missing() > 0 && done(self.stage) <= share {
            self.work(biped);
        }
    }

    /// What the present knot asks of the posture, with the centre of mass off the pendulum by `correction`; both in the walk
    /// frame [m].
    pub fn wanted(&self, footprint: &Footprint, correction: Vector2<f64>) -> Wanted {
        let Foreseen { com, wanted, .. } = &self.knots[self.present];
        Wanted { com: footprint.point_to_support(place(com) + correction), ..*wanted }
    }

    /// What the correction is to do about the coming knots, once all are seen: each times its gain, along both axes of the
    /// walk frame.
    pub fn weighed(&self) -> Vector2<f64> {
        self.weighed
    }

    fn slot(&self, ahead: usize) -> usize {
        (self.present + ahead) % self.knots.len()
    }

    /// The farthest knot, which is being seen, and the two before it; that first.
    fn last_three(&self) -> [usize; 3] {
        [self.ahead + self.knots.len() - 1, self.ahead, self.ahead + 1].map(|ahead| self.slot(ahead))
    }

    fn work(&mut self, biped: &Biped) {
        let [_, last, new] = self.last_three();
        self.stage = match self.stage {
            Stage::Pendulum => {
                let sum = self.outlook.weighed(&biped.pendulum);
                let com = self.knots[last].com;
                self.knots[new].com = [0, 1].map(|axis| biped.pendulum.advance(&com[axis], sum[axis]));
                self.outlook.advance(biped);
                let before = self.footwork.course.feet.footprint;
                if self.footwork.advance(biped) {
                    self.body.swap(biped);
                }
                let Course { feet, .. } = &self.footwork.course;
                self.knots[new].expected =
                    feet.footprint.direction_to_walk(self.footwork.course.beyond_pendulum(biped));
                Stage::Feet(before)
            }
            Stage::Feet(before) => {
                self.knots[new].wanted = self.footwork.wanted(biped, place(&self.knots[new].com));
                Stage::Posture(before)
            }
            Stage::Posture(before) => {
                let reached = self.body.reach(biped, &self.knots[new].wanted);
                self.knots[new].angles =
                    reached.map_or(self.knots[last].angles, |angles| self.footwork.physical(biped, &angles));
                Stage::Zmp(before)
            }
            Stage::Zmp(footprint) => {
                let motion = self.motion_over(biped, footprint);
                let ground = self.inverse.ground_wrench(&biped.tree, &motion);
                self.note_missed(biped, footprint, &ground);
                Stage::Correction
            }
            Stage::Correction => {
                self.ahead += 1;
                if self.missing() == 0 {
                    self.weighed = -biped.correction.weigh(&self.unexpected, self.slot(1));
                }
                Stage::Pendulum
            }
        };
    }

    /// The motion at the farthest knot but one, over the foot that bears there.
    fn motion_over(&self, biped: &Biped, footprint: Footprint) -> Motion {
        let [before, here, after] = self.last_three().map(|slot| &self.knots[slot].angles);
        let motion = Motion::between(before, here, after, KNOT);
        match footprint.side {
            Side::Right => motion,
            Side::Left => motion.mirrored(&biped.mirror),
        }
    }

    /// Notes what the pendulum leaves out of that motion's ZMP and nobody expected; the farthest knot is taken to be alike.
    ///
    /// * `ground` – what the motion needs
    fn note_missed(&mut self, biped: &Biped, footprint: Footprint, ground: &Wrench) {
        let [_, here, new] = self.last_three();
        if let Some(point) = zmp(ground) {
            let knot = &self.knots[here];
            let pendulum = Vector2::from([0, 1].map(|axis| {
                let [position, _, acceleration] = knot.com[axis].into();
                position - biped.sway.height_over_gravity * acceleration
            }));
            self.unexpected[here] = footprint.point_to_walk(point) - pendulum - knot.expected;
        }
        self.unexpected[new] = self.unexpected[here];
    }
}

/// Where the pendulum is, in the walk frame [m].
fn place([x, y]: &[CartState; 2]) -> Vector2<f64> {
    Vector2::new(x.x, y.x)
}
