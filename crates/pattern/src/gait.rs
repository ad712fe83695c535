//! The trait of gaits: what a controller plays, tick by tick.

use ::gait::{Admission, Walk};
use interface::{Command, GaitChange, HalfStep};
use model::Motion;
use nalgebra::Vector2;

use crate::{GaitPhase, GaitState, Goal, PatternGenerator, Stance, UncompensatedGait};

/// A gait that a controller plays. All motions, vectors and rotations are expressed in support coordinates: as if the
/// support foot were the right one.
pub trait Gait {
    /// Puts in force what the configured range admits of a change of gait parameters.
    fn admit(&mut self, change: &GaitChange) -> Admission;

    /// Moves on by `dt` (s) and returns whether the support changed: a new half-step began.
    fn advance(&mut self, dt: f64) -> bool;

    /// The commanded motion.
    fn motion(&self) -> Motion;

    /// The present half-step.
    fn half_step(&self) -> HalfStep;

    /// The speed factor at this instant.
    fn speed(&self) -> f64;

    /// The gait parameters in force, or those that will be when the robot walks on.
    fn command(&self) -> Command;

    /// What the gait does at this instant.
    fn phase(&self) -> GaitPhase;

    /// The modified half-step, at the newest knot where the gait is planned.
    fn walk(&self) -> &Walk;

    /// Stops without being asked to by a request: the controller's own decision.
    fn stop(&mut self, stance: Stance);

    /// Whether the robot can walk again after a stop.
    fn can_restart(&self) -> bool;

    /// Whether the motion is that of the walk: feedback and step adjustment apply.
    fn follows_walk(&self) -> bool;

    /// Whether both feet are to bear weight.
    fn in_double_support(&self) -> bool;

    /// Whether the plan needed a foot out of a leg's reach, so that the posture before was kept.
    fn is_leg_out_of_reach(&self) -> bool;

    /// Lean of the vertical over the floor as last measured: x and y of the unit vector.
    fn sensed_vertical(&self) -> Vector2<f64>;

    /// Absorbs the lean of the vertical over the support sole, `dt` (s) after the last one.
    fn update_ground_slope(&mut self, lean: Vector2<f64>, dt: f64);

    /// Absorbs the rotation of the body beyond the plan, about x and y (rad).
    fn set_tilt(&mut self, tilt: Vector2<f64>);

    /// Growth of an error of the divergent component until touchdown; `None` if the landing cannot be adjusted now.
    fn growth_until_touchdown(&self) -> Option<f64>;

    /// Shifts the landing of the swing foot by the error of the divergent component at touchdown that feedback cannot
    /// correct (m).
    fn adjust_step(&mut self, error: Vector2<f64>);
}

impl Gait for PatternGenerator {
    fn admit(&mut self, change: &GaitChange) -> Admission {
        self.admit(change)
    }

    fn advance(&mut self, dt: f64) -> bool {
        self.advance(dt)
    }

    fn motion(&self) -> Motion {
        self.motion()
    }

    fn half_step(&self) -> HalfStep {
        self.half_step()
    }

    fn speed(&self) -> f64 {
        self.speed()
    }

    fn command(&self) -> Command {
        self.command()
    }

    /// What is planned for the newest knot, as far as it has begun.
    fn phase(&self) -> GaitPhase {
        match (self.gait_state(), self.in_double_support()) {
            (GaitState::Standing(stance), true) => GaitPhase::Standing(stance),
            (GaitState::Standing(_) | GaitState::Stopping { .. }, _) => GaitPhase::Stopping,
            (_, true) => GaitPhase::Starting,
            (GaitState::Walking | GaitState::Starting { .. }, false) => GaitPhase::Walking,
            (GaitState::InPlace { .. }, false) => GaitPhase::InPlace,
        }
    }

    fn walk(&self) -> &Walk {
        self.walk()
    }

    fn stop(&mut self, stance: Stance) {
        self.set_goal_soon(Goal::Stand(stance));
    }

    fn can_restart(&self) -> bool {
        true
    }

    fn follows_walk(&self) -> bool {
        true
    }

    fn in_double_support(&self) -> bool {
        self.in_double_support()
    }

    fn is_leg_out_of_reach(&self) -> bool {
        self.is_leg_out_of_reach()
    }

    fn sensed_vertical(&self) -> Vector2<f64> {
        self.sensed_vertical()
    }

    fn update_ground_slope(&mut self, lean: Vector2<f64>, dt: f64) {
        self.update_ground_slope(lean, dt);
    }

    fn set_tilt(&mut self, tilt: Vector2<f64>) {
        self.set_tilt(tilt);
    }

    fn growth_until_touchdown(&self) -> Option<f64> {
        self.growth_until_touchdown()
    }

    fn adjust_step(&mut self, error: Vector2<f64>) {
        self.adjust_step(error);
    }
}

/// It knows level floors only, and adjusts no step.
impl Gait for UncompensatedGait {
    fn admit(&mut self, change: &GaitChange) -> Admission {
        self.admit(change)
    }

    fn advance(&mut self, dt: f64) -> bool {
        self.advance(dt)
    }

    fn motion(&self) -> Motion {
        self.motion()
    }

    fn half_step(&self) -> HalfStep {
        self.walk().half_step()
    }

    fn speed(&self) -> f64 {
        self.walk().speed().state().value
    }

    fn command(&self) -> Command {
        self.walk().command()
    }

    fn phase(&self) -> GaitPhase {
        self.phase()
    }

    fn walk(&self) -> &Walk {
        self.walk()
    }

    fn stop(&mut self, stance: Stance) {
        self.set_goal(Goal::Stand(stance));
    }

    fn can_restart(&self) -> bool {
        !self.has_stopped()
    }

    fn follows_walk(&self) -> bool {
        !self.has_stopped()
    }

    fn in_double_support(&self) -> bool {
        false
    }

    fn is_leg_out_of_reach(&self) -> bool {
        false
    }

    fn sensed_vertical(&self) -> Vector2<f64> {
        Vector2::zeros()
    }

    fn update_ground_slope(&mut self, _: Vector2<f64>, _: f64) {}

    fn set_tilt(&mut self, _: Vector2<f64>) {}

    fn growth_until_touchdown(&self) -> Option<f64> {
        None
    }

    fn adjust_step(&mut self, _: Vector2<f64>) {}
}
