//! Foresight: the whole body is played ahead over the pendulum's plan, to see by how much its ZMP will miss (the second
//! preview of Kajita et al. 2003).

use dynamics::{NewtonEuler, zmp};
use model::{JointVector, Motion, Side};
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
    /// A ring: the knot before the present one, the present one, the coming ones.
    knots: [Foreseen; KNOTS_FORESEEN + 2],
    /// Where in it the present knot is.
    present: usize,
    /// How many knots after the present one are known.
    ahead: usize,
    /// What is to be done next about the farthest one.
    stage: Stage,
}

/// A knot more is seen in parts, so that no tick does all of it.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Where the feet are and the pendulum is.
    Pendulum,
    /// The posture that does it; with the foot that bore at the knot before.
    Posture(Footprint),
    /// What the pendulum leaves out of the ZMP of the knot before: only then it has a neighbour on either side.
    Zmp(Footprint),
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
    /// What it leaves out besides [m].
    unexpected: Vector2<f64>,
}

impl Foresight {
    /// Looks ahead from a walk's very beginning.
    pub fn new(biped: &Biped, footwork: &Footwork, com: [CartState; 2], motion: &Motion) -> Self {
        let angles = footwork.physical(biped, &motion.angles);
        let wanted = footwork.wanted(biped, place(&com));
        let now = Foreseen { com, wanted, angles, expected: Vector2::zeros(), unexpected: Vector2::zeros() };
        let before = Foreseen { angles: footwork.physical(biped, &(motion.angles - motion.rates * KNOT)), ..now };
        let mut knots = [before; KNOTS_FORESEEN + 2];
        knots[0] = now;
        let mut foresight = Self {
            outlook: Outlook::new(biped, &footwork.course),
            footwork: footwork.clone(),
            body: WholeBody::new(biped, &motion.angles),
            inverse: NewtonEuler::default(),
            knots,
            present: 0,
            ahead: 0,
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

    /// The next knot becomes the present one; to be seen completely before the next time.
    pub fn advance(&mut self) {
        self.present = self.slot(1);
        self.ahead -= 1;
    }

    /// Sees as much of the knot that is missing as is due when a share of the time to the next knot has passed.
    pub fn keep_up(&mut self, biped: &Biped, share: f64) {
        let done = |stage| match stage {
            Stage::Pendulum => 0.25,
            Stage::Posture(_) => 0.5,
            Stage::Zmp(_) => 0.75,
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

    /// What the correction is to do about the coming knots, each times its gain, along both axes of the walk frame.
    pub fn weighed(&self, biped: &Biped) -> Vector2<f64> {
        let (early, late) = self.knots.split_at(self.present);
        let coming = late[1..].iter().chain(early).take(KNOTS_FORESEEN);
        let sum: Vector2<f64> = coming.zip(biped.correction.gains()).map(|(knot, gain)| knot.unexpected * *gain).sum();
        -sum
    }

    fn slot(&self, ahead: usize) -> usize {
        (self.present + ahead) % self.knots.len()
    }

    fn work(&mut self, biped: &Biped) {
        let [before, last, new] =
            [self.ahead + self.knots.len() - 1, self.ahead, self.ahead + 1].map(|ahead| self.slot(ahead));
        let footprint = self.footwork.course.feet.footprint;
        self.stage = match self.stage {
            Stage::Pendulum => {
                let sum = self.outlook.weighed(&biped.pendulum);
                let com = self.knots[last].com;
                let com = [0, 1].map(|axis| biped.pendulum.advance(&com[axis], sum[axis]));
                self.outlook.advance(biped);
                if self.footwork.advance(biped) {
                    self.body.swap(biped);
                }
                let Course { feet, .. } = &self.footwork.course;
                self.knots[new].com = com;
                self.knots[new].wanted = self.footwork.wanted(biped, place(&com));
                self.knots[new].expected =
                    feet.footprint.direction_to_walk(self.footwork.course.beyond_pendulum(biped));
                Stage::Posture(footprint)
            }
            Stage::Posture(before) => {
                let reached = self.body.reach(biped, &self.knots[new].wanted);
                self.knots[new].angles =
                    reached.map_or(self.knots[last].angles, |angles| self.footwork.physical(biped, &angles));
                Stage::Zmp(before)
            }
            Stage::Zmp(footprint) => {
                let missed = self.missed(biped, footprint, [before, last, new]);
                let missed = missed.unwrap_or(self.knots[last].unexpected);
                self.knots[last].unexpected = missed;
                self.knots[new].unexpected = missed;
                self.ahead += 1;
                Stage::Pendulum
            }
        };
    }

    /// What the pendulum leaves out of the ZMP and nobody expected at the middle one of three knots, in the walk frame [m].
    fn missed(&mut self, biped: &Biped, footprint: Footprint, slots: [usize; 3]) -> Option<Vector2<f64>> {
        let [before, here, after] = slots.map(|slot| &self.knots[slot].angles);
        let motion = Motion::between(before, here, after, KNOT);
        let ground = match footprint.side {
            Side::Right => self.inverse.ground_wrench(&biped.tree, &motion),
            Side::Left => self.inverse.ground_wrench(&biped.tree, &motion.mirrored(&biped.mirror)),
        };
        let whole = footprint.point_to_walk(zmp(&ground)?);
        let knot = &self.knots[slots[1]];
        let pendulum = Vector2::from([0, 1].map(|axis| {
            let [position, _, acceleration] = knot.com[axis].into();
            position - biped.sway.height_over_gravity * acceleration
        }));
        Some(whole - pendulum - knot.expected)
    }
}

/// Where the pendulum is, in the walk frame [m].
fn place([x, y]: &[CartState; 2]) -> Vector2<f64> {
    Vector2::new(x.x, y.x)
}
