//! The trait of gaits: what a controller plays, tick by tick.

use ::gait::{RangeCheck, Walk};
use dynamics::PlannedContact;
use interface::{Command, GaitChange, HalfStep, WalkPose};
use model::Motion;
use nalgebra::Vector2;

use crate::{BodyTilt, GaitPhase, MeasuredBalance, Stance, StepChoice};

/// Progress before and after a support change in which the weight may move from foot to foot, at nominal speed: 0.03 s
/// of the paper's robot.
const SUPPORT_CHANGE: f64 = 0.05;
/// Progress before and after a support change in which the planned ZMP may be outside the support sole, so that the
/// other foot carries a share.
const OUTSIDE_SOLE: f64 = 0.1;
/// Least speed factor by which [`SUPPORT_CHANGE`] is measured.
const SPEED_MIN: f64 = 0.1;

/// A gait that a controller plays. All motions, vectors and rotations are expressed in support coordinates: as if the
/// support foot were the right one.
pub trait Gait {
    /// Puts in force what the configured range admits of a change of gait parameters, and plans it at once. See
    /// [`Walk::admit`].
    fn admit(&mut self, change: &GaitChange) -> RangeCheck;

    /// Advances by `dt` (s), at most a nominal half-step. Returns whether the support changed: a new half-step began.
    fn advance(&mut self, dt: f64) -> bool;

    /// The commanded motion. The joints `FootRoll` and `FootPitch` are the slope of the sole.
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

    /// Stops. Planning is spread over the ticks of the next two knots, so that the stop takes effect within 20 ms.
    /// Returns the number of half-steps that begin until the robot stands; the stand itself counts as one.
    fn stop(&mut self, stance: Stance) -> u64;

    /// Whether the robot can walk again after a stop.
    fn can_restart(&self) -> bool;

    /// Whether the motion is that of the walk: feedback and step adjustment apply.
    fn follows_walk(&self) -> bool;

    /// Whether both feet are to bear weight: in a stand, and until the weight has shifted onto the first support foot.
    /// At a support change the weight is taken to change feet at once.
    fn in_double_support(&self) -> bool;

    /// Whether the weight moves from foot to foot just now, as planned.
    fn is_changing_support(&self) -> bool {
        let progress = self.half_step().progress;
        progress.min(1.0 - progress) < SUPPORT_CHANGE * self.speed().max(SPEED_MIN)
    }

    /// Where the swing foot lands next, and the support foot after it, in the frame of the support sole. Nothing is
    /// mirrored.
    fn landings(&self) -> [WalkPose; 2];

    /// Which feet are on the ground as planned.
    fn contact(&self) -> PlannedContact {
        let progress = self.half_step().progress;
        if self.in_double_support() {
            PlannedContact::BothFeet
        } else if progress.min(1.0 - progress) < OUTSIDE_SOLE {
            PlannedContact::SupportChange
        } else {
            PlannedContact::SupportFoot
        }
    }

    /// Whether the plan needed a foot out of a leg's reach, so that the posture before was kept.
    fn is_leg_out_of_reach(&self) -> bool;

    /// Lean of the vertical over the floor as last measured: x and y of the unit vector (-). The plan follows slowly.
    fn sensed_vertical(&self) -> Vector2<f64>;

    /// Absorbs a measurement of the ground's slope.
    ///
    /// * `lean` – of the vertical over the support sole: x and y of the unit vector (-)
    /// * `dt` – time since the last measurement (s)
    fn update_ground_slope(&mut self, lean: Vector2<f64>, dt: f64);

    /// Absorbs the tilt of the body beyond the plan.
    fn set_tilt(&mut self, tilt: BodyTilt);

    /// Where and when the swing foot should land, if that is worth another plan. `None` also if the landing cannot be
    /// adjusted: soon after the last adjustment, late in a half-step, and in a stand.
    fn choose_step(&self, measured: &MeasuredBalance) -> Option<StepChoice>;

    /// The error of the divergent component that the best step leaves at touchdown, beyond what the next ankle
    /// corrects, in support coordinates (m). `None` late in a half-step, and in a stand.
    fn shortfall(&self, measured: &MeasuredBalance) -> Option<Vector2<f64>>;

    /// Adjusts place and time of the landing of the swing foot.
    fn adjust_step(&mut self, choice: StepChoice);
}
