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
    /// Largest adjustment of a landing, ahead or back, and outward (m).
    pub step_adjustment_max: Vector2<f64>,
    /// Smallest change of an adjustment that is worth another plan (m).
    pub step_adjustment_change_min: f64,
    /// Smallest lateral distance of the ankles after an adjustment (m).
    pub sole_spacing_min: f64,
    /// Smallest height of the swing sole over the ground in mid-swing (m).
    pub swing_height_min: f64,
    /// Largest additional clearance of the swing sole over a body that tilts (m).
    pub swing_clearance_max: f64,
    /// Time constant of that clearance (s).
    pub swing_clearance_time_constant: f64,
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
/// A quarter of the leg length ahead or back, less outward, where the legs spread (m).
const STEP_ADJUSTMENT_MAX: Vector2<f64> = Vector2::new(0.2, 0.15);
/// 1 % of the leg length: what is less is not worth the time to plan it (m).
const STEP_ADJUSTMENT_CHANGE_MIN: f64 = 0.008;
/// Gap between the edges of soles side by side: 2 cm, and as much again for turned feet (m).
const SOLE_GAP_MIN: f64 = 0.04;
/// 1 % of the leg length: a sole that is lower in mid-swing scuffs (m).
const SWING_HEIGHT_MIN: f64 = 0.01;
/// As far as the landing compliance reaches for the ground, 3 % of the leg length (m).
const SWING_CLEARANCE_MAX: f64 = 0.03;
/// A seventh of a nominal half-step: fast enough to act before the swing foot lands (s).
const SWING_CLEARANCE_TIME_CONSTANT: f64 = 0.08;
/// Longer than the noise of the sensors, shorter than a half-step (s).
const SENSED_VERTICAL_TIME_CONSTANT: f64 = 0.05;
/// About the time constant of the pendulum, 0.31 s: drives and soles yield within a step, a slope stays (s).
const SLOPE_TIME_CONSTANT: f64 = 0.25;

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
            step_adjustment_max: STEP_ADJUSTMENT_MAX * scale,
            step_adjustment_change_min: STEP_ADJUSTMENT_CHANGE_MIN * scale,
            sole_spacing_min: 2.0 * mechanism.sole.inside + SOLE_GAP_MIN * scale,
            swing_height_min: SWING_HEIGHT_MIN * scale,
            swing_clearance_max: SWING_CLEARANCE_MAX * scale,
            swing_clearance_time_constant: SWING_CLEARANCE_TIME_CONSTANT * slower,
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
