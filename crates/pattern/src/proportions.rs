//! Lengths and times that suit the size of the robot, all in one place.
//!
//! Those of the legs and soles follow from the mechanism. The others were found for the paper's robot, with legs of
//! 0.86 m from hip to ankle and hips 0.19 m apart; for another robot they are scaled by its legs.

use model::{LegReach, Mechanism};
use nalgebra::Vector2;

/// Lengths and times that suit the size of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PatternProportions {
    /// Longest distance of hip joint and ankle joint that the hip height is planned for (m).
    pub planned_leg_length_max: f64,
    /// Longest distance of hip joint and ankle joint that inverse kinematics uses (m).
    pub leg_length_max: f64,
    /// Range of lengths over which the limit of the leg length sets in (m).
    pub leg_limit_rounding: f64,
    /// Largest horizontal offset of the hips from where the hip height expects them (m).
    pub hip_offset_max: f64,
    /// Farthest adjusted landing ahead of the support foot (m).
    pub step_ahead_max: f64,
    /// Farthest adjusted landing behind it (m).
    pub step_back_max: f64,
    /// Farthest adjusted landing beside it (m).
    pub step_aside_max: f64,
    /// Smallest change of an adjustment that is worth another plan (m).
    pub step_adjustment_change_min: f64,
    /// Error of the divergent component at touchdown that is left to the next ankle, ahead and aside (m).
    pub dcm_error_left_to_next_ankle: Vector2<f64>,
    /// Largest speed of the swing foot beyond the planned one (m/s).
    pub swing_speed_added_max: f64,
    /// How large an offset of a landing costs as much as another time of it (m/s).
    pub offset_per_time: f64,
    /// Smallest lateral distance of the ankles after an adjustment (m).
    pub sole_spacing_min: f64,
    /// Largest unexpected ZMP that the dynamics filter corrects after a push (m).
    pub unexpected_zmp_max: f64,
    /// Smallest height of the swing sole over the ground in mid-swing (m).
    pub swing_height_min: f64,
    /// Largest additional clearance of the swing sole over a body that tilts (m).
    pub swing_clearance_max: f64,
    /// Time constant of that clearance (s).
    pub swing_clearance_time_constant: f64,
    /// The same while the robot recovers from a push (s).
    pub swing_clearance_time_constant_in_recovery: f64,
    /// Time constant of the low-pass filter of the sensed vertical (s).
    pub sensed_vertical_time_constant: f64,
    /// Time constant with which the plan follows the slope of the ground (s).
    pub slope_time_constant: f64,
}

/// Share of a straight leg's length that the hip height is planned for: the knee keeps a bend of 19°. That leaves 6 mm
/// to [`LEG_SHARE_MAX`], since the posture deviates from what the hip height expects.
const PLANNED_LEG_SHARE_MAX: f64 = 0.987;
/// Share of a straight leg's length that inverse kinematics uses: the knee keeps a bend of 13°. The rate of
/// a straighter knee would grow without bound.
const LEG_SHARE_MAX: f64 = 0.994;
/// 2 % of the leg length: the limit sets in so gently that the knee's acceleration stays continuous (m).
const LEG_LIMIT_ROUNDING: f64 = 0.015;
/// A fifth of the hip width: the path of the hips in a steady walk is a rough estimate of the planned one (m).
const HIP_OFFSET_MAX: f64 = 0.04;
/// Half of the leg length ahead, less back and outward, where the legs spread (m).
const STEP_AHEAD_MAX: f64 = 0.45;
const STEP_BACK_MAX: f64 = 0.3;
const STEP_ASIDE_MAX: f64 = 0.2;
/// 1 % of the leg length: what is less is not worth the time to plan it (m).
const STEP_ADJUSTMENT_CHANGE_MIN: f64 = 0.008;
/// Less than half of the room that the next support sole offers ahead, and most of it aside: the next ankle corrects
/// this much (m).
const DCM_ERROR_LEFT_TO_NEXT_ANKLE: Vector2<f64> = Vector2::new(0.05, 0.03);
/// As fast again as the swing foot goes in the middle of a nominal step (m/s).
const SWING_SPEED_ADDED_MAX: f64 = 1.5;
/// A landing 2 cm off costs as much as one that is a tenth of a second early (m/s).
const OFFSET_PER_TIME: f64 = 0.2;
/// Gap between the edges of soles side by side (m).
const SOLE_GAP_MIN: f64 = 0.02;
/// Several times that of a steady walk (m).
const UNEXPECTED_ZMP_MAX: f64 = 0.08;
/// 1 % of the leg length: a sole that is lower in mid-swing scuffs (m).
const SWING_HEIGHT_MIN: f64 = 0.01;
/// As far as the landing compliance reaches for the ground, 3 % of the leg length (m).
const SWING_CLEARANCE_MAX: f64 = 0.03;
/// A seventh of a nominal half-step: fast enough to act before the swing foot lands (s).
const SWING_CLEARANCE_TIME_CONSTANT: f64 = 0.08;
/// A strong push tilts the body by 5° within a tenth of a second; the noise that follows from it is small then (s).
const SWING_CLEARANCE_TIME_CONSTANT_IN_RECOVERY: f64 = 0.016;
/// Longer than the noise of the sensors, shorter than a half-step (s).
const SENSED_VERTICAL_TIME_CONSTANT: f64 = 0.05;
/// About the time constant of the pendulum, 0.31 s: the centre of mass moves uphill within a step, without haste (s).
const SLOPE_TIME_CONSTANT: f64 = 0.375;

impl PatternProportions {
    /// The proportions of a robot.
    pub(crate) fn of(mechanism: &Mechanism) -> Self {
        let reach = LegReach::of(mechanism);
        let (leg, scale) = (reach.length(), reach.scale());
        let slower = scale.sqrt();
        Self {
            planned_leg_length_max: PLANNED_LEG_SHARE_MAX * leg,
            leg_length_max: LEG_SHARE_MAX * leg,
            leg_limit_rounding: LEG_LIMIT_ROUNDING * scale,
            hip_offset_max: HIP_OFFSET_MAX * scale,
            step_ahead_max: STEP_AHEAD_MAX * scale,
            step_back_max: STEP_BACK_MAX * scale,
            step_aside_max: mechanism.foot_distance() + STEP_ASIDE_MAX * scale,
            step_adjustment_change_min: STEP_ADJUSTMENT_CHANGE_MIN * scale,
            dcm_error_left_to_next_ankle: DCM_ERROR_LEFT_TO_NEXT_ANKLE * scale,
            swing_speed_added_max: SWING_SPEED_ADDED_MAX * slower,
            offset_per_time: OFFSET_PER_TIME * slower,
            sole_spacing_min: 2.0 * mechanism.sole.inside + SOLE_GAP_MIN * scale,
            unexpected_zmp_max: UNEXPECTED_ZMP_MAX * scale,
            swing_height_min: SWING_HEIGHT_MIN * scale,
            swing_clearance_max: SWING_CLEARANCE_MAX * scale,
            swing_clearance_time_constant: SWING_CLEARANCE_TIME_CONSTANT * slower,
            swing_clearance_time_constant_in_recovery: SWING_CLEARANCE_TIME_CONSTANT_IN_RECOVERY * slower,
            sensed_vertical_time_constant: SENSED_VERTICAL_TIME_CONSTANT,
            slope_time_constant: SLOPE_TIME_CONSTANT * slower,
        }
    }

    /// The proportions of the built-in robot.
    #[cfg(test)]
    pub(crate) fn of_built_in_robot() -> Self {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        Self::of(&<Mechanism as config::Config>::load(file).unwrap())
    }
}
