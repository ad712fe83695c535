//! The course: which half-steps are to come and where they put the feet.

use dynamics::Kinematics;
use gait::{Admission, Command, Request, Verdict, Walk};
use model::{Joint, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

use crate::preview::{Biped, Footprint, Gate, SolePose, Stance};

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
        let parallel = parallel(biped);
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
            if self.gate == Gate::Open {
                admission.effect_half_step = self.walk.force(&self.asked);
            }
        }
        admission
    }

    /// Comes to a stand: straight on, no longer and no faster than the nominal.
    pub fn stop(&mut self, stance: Stance) {
        self.gate.close(stance);
        let Command { speed, extension, .. } = self.walk.command();
        self.walk.force(&Command { turn: 0.0, speed: speed.min(1.0), extension: extension.min(0.0) });
    }

    /// Walks on.
    pub fn start(&mut self) {
        self.gate.open();
        if self.gate == Gate::Open {
            self.walk.force(&self.asked);
        }
    }

    /// Moves on by a knot and says whether a half-step began.
    pub fn advance(&mut self, biped: &Biped) -> bool {
        let was_standing = self.gate.is_standing();
        let begins = self.gate.advance(&mut self.walk);
        if was_standing && self.gate == Gate::Open {
            self.walk.force(&self.asked);
        }
        if begins {
            self.feet.standing = self.feet.landing.seen_from_landed();
            self.feet.footprint = self.feet.footprint.next(&self.feet.landing);
            self.feet.landing = self.landing(biped);
        }
        begins
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
        if self.gate.lands_parallel() {
            return parallel(biped);
        }
        let mut landing = self.swinging_sole(biped, 1.0);
        landing.position.z = 0.0;
        landing
    }

    /// The swinging sole of the modified half-step at a progress.
    pub fn swinging_sole(&self, biped: &Biped, progress: f64) -> SolePose {
        let angles = self.walk.angles_at(progress);
        let kinematics = Kinematics::standing_up_to(&biped.tree, &angles, Mechanism::foot(Side::Left));
        SolePose::swinging(&biped.mechanism, &kinematics)
    }
}

/// The other sole beside the bearing one.
fn parallel(biped: &Biped) -> SolePose {
    let width = biped.mechanism.links[Joint::LeftHipRoll].origin.y;
    SolePose { position: Vector3::new(0.0, width, 0.0), yaw: 0.0 }
}
