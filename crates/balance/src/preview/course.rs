//! The course: which half-steps are to come and where they put the feet.

use dynamics::Kinematics;
use gait::{Admission, Command, Request, Verdict, Walk};
use model::{Joint, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

use crate::preview::footprint::turned_about_z;
use crate::preview::{Biped, Footprint, Gate, Goal, SolePose, Stance};

/// The walk at a knot with its feet.
#[derive(Clone, Debug)]
pub struct Course {
    /// The walk that is asked for.
    pub walk: Walk,
    /// Whether it goes on.
    pub gate: Gate,
    /// Where the feet are.
    pub feet: Feet,
    /// What is to be in force when the walk goes on; before a stand the walk is calmer.
    asked: Command,
}

/// What happens at a knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Nothing of the kind.
    None,
    /// The foot that landed bears now.
    Swap,
    /// The first half-step after a stand begins: the weight is on the foot that bears.
    LiftOff,
}

/// Where the feet are in a half-step.
#[derive(Clone, Copy, Debug)]
pub struct Feet {
    /// The bearing one.
    pub footprint: Footprint,
    /// Where the other one stands before it swings, in support coordinates.
    pub standing: SolePose,
    /// Where it lands.
    pub landing: SolePose,
}

impl Course {
    /// At the very beginning of a walk.
    pub fn new(biped: &Biped, walk: Walk) -> Self {
        let kinematics = Kinematics::standing(&biped.tree, &walk.motion().angles);
        let standing = SolePose::swinging(&biped.mechanism, &kinematics);
        let footprint = Footprint::first(walk.half_step().support);
        let asked = walk.command();
        let feet = Feet { footprint, standing, landing: standing };
        let mut course = Self { walk, gate: Gate::Open, feet, asked };
        course.feet.landing = course.landing(biped);
        course
    }

    /// At a stand with the feet side by side, about to walk when asked to.
    pub fn standing(biped: &Biped, walk: Walk) -> Self {
        let parallel = side_by_side(biped, 0.0);
        let footprint = Footprint::first(walk.half_step().support);
        let feet = Feet { footprint, standing: parallel, landing: parallel };
        let mut course = Self { asked: walk.command(), walk, gate: Gate::Closed(Stance::Parallel), feet };
        course.walk.force(&Command::NOMINAL);
        course.feet.landing = course.landing(biped);
        course
    }

    /// What is in force, or will be when the walk goes on.
    pub fn command(&self) -> Command {
        self.asked
    }

    /// Takes what is granted of a request. See [`Walk::admit`].
    pub fn admit(&mut self, request: &Request) -> Admission {
        let mut admission = self.walk.grant(request, self.asked);
        if admission.verdict != Verdict::Refused {
            self.asked = admission.granted;
            if let Some(effect_half_step) = self.obey() {
                admission.effect_half_step = effect_half_step;
            }
        }
        admission
    }

    /// Walks, steps in place or comes to a stand.
    pub fn aim(&mut self, goal: Goal) {
        self.gate.aim(goal);
        if matches!(self.gate, Gate::Closing { .. }) {
            let Command { speed, extension, .. } = self.walk.command();
            self.walk.force(&Command { turn: 0.0, speed: speed.min(1.0), extension: extension.min(0.0) });
        } else {
            self.obey();
        }
    }

    /// Walks by what is asked, if it walks; in place no faster than the nominal. See [`Walk::force`].
    fn obey(&mut self) -> Option<u64> {
        let Command { turn, speed, .. } = self.asked;
        match self.gate {
            Gate::Open => Some(self.walk.force(&self.asked)),
            Gate::InPlace { .. } => Some(self.walk.force(&Command { turn, speed: speed.min(1.0), extension: 0.0 })),
            Gate::Closing { .. } | Gate::Closed(_) | Gate::Opening { .. } => None,
        }
    }

    /// Moves on by a knot.
    pub fn advance(&mut self, biped: &Biped) -> Event {
        let was_standing = self.gate.is_standing();
        let begins = self.gate.advance(&mut self.walk);
        if begins {
            self.feet.standing = self.feet.landing.seen_from_landed();
            self.feet.footprint = self.feet.footprint.next(&self.feet.landing);
            self.feet.landing = self.landing(biped);
            Event::Swap
        } else if was_standing && !self.gate.is_standing() {
            self.obey();
            self.feet.landing = self.landing(biped);
            Event::LiftOff
        } else {
            Event::None
        }
    }

    /// What the outlook takes the pendulum to leave out of the ZMP, in support coordinates [m].
    pub fn beyond_pendulum(&self, biped: &Biped) -> Vector2<f64> {
        if self.gate.is_standing() {
            return Vector2::zeros();
        }
        biped.sway.beyond_pendulum(self.walk.half_step().progress, self.walk.speed().state().value)
    }

    /// Where the swinging sole of the present half-step is to land.
    fn landing(&self, biped: &Biped) -> SolePose {
        let mut landing = self.swinging_sole(biped, 1.0);
        landing.position.z = 0.0;
        match self.gate {
            Gate::Closing { swaps: 1, stance: Stance::Parallel, .. } => side_by_side(biped, 0.0),
            Gate::InPlace { swaps: 0 } => side_by_side(biped, landing.yaw),
            _ => landing,
        }
    }

    /// The swinging sole of the modified half-step at a progress.
    pub fn swinging_sole(&self, biped: &Biped, progress: f64) -> SolePose {
        let angles = self.walk.angles_at(progress);
        let kinematics = Kinematics::standing_up_to(&biped.tree, &angles, Mechanism::foot(Side::Left));
        SolePose::swinging(&biped.mechanism, &kinematics)
    }
}

/// The other sole beside the bearing one, either turned from the hips' heading by half the yaw.
fn side_by_side(biped: &Biped, yaw: f64) -> SolePose {
    let width = biped.mechanism.links[Joint::LeftHipRoll].origin.y;
    SolePose { position: turned_about_z(yaw / 2.0) * Vector3::new(0.0, width, 0.0), yaw }
}
