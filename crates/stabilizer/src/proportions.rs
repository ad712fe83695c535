//! Lengths and forces that suit the size of the robot, all in one place.
//!
//! Those of the soles and the weight follow from the mechanism. The others were found for the paper's robot, with legs
//! of 0.86 m from hip to ankle and soles of 0.28 m × 0.08 m; for another robot they are scaled by its legs.

use model::{GRAVITY, LegReach, Mechanism, Side};
use nalgebra::Vector2;

/// Lengths and forces that suit the size of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StabilizerProportions {
    /// Weight of the robot (N).
    pub weight: f64,
    /// Half of the sole's length and width (m).
    pub sole_half_size: Vector2<f64>,
    /// Centre of the support sole, from the point under the ankle (m).
    pub sole_centre: Vector2<f64>,
    /// Largest shift of the ZMP in double support (m).
    pub double_support_zmp_shift_max: f64,
    /// Error of the divergent component that steps answer (m).
    pub dcm_error_of_push: f64,
    /// Error of the divergent component beyond what uneven ground causes (m).
    pub dcm_error_large: f64,
    /// Largest error of the divergent component that counts (m).
    pub dcm_error_max: f64,
    /// Largest offset of the centre of mass that is believed (m).
    pub com_offset_max: f64,
    /// Largest ZMP shift of foot damping control (m).
    pub foot_damping_zmp_shift_max: f64,
    /// Largest change of a foot's height at touchdown (m).
    pub landing_lift_max: f64,
    /// Error of the divergent component that the best step leaves and that is mostly not survived (m).
    pub shortfall_lost: f64,
    /// The same of a stand, in which the robot does not step (m).
    pub shortfall_lost_in_stand: f64,
    /// Standard deviation of the ground's height from footprint to footprint (m).
    pub unevenness: f64,
}

/// A sixth of the distance of the feet: the ankles of both feet push, and the weight sways as the robot comes to rest
/// (m).
const DOUBLE_SUPPORT_ZMP_SHIFT_MAX: f64 = 0.03;
/// Most of the room that the sole offers aside (m).
const DCM_ERROR_OF_PUSH: f64 = 0.03;
/// Errors on uneven ground mostly stay below it; a strong push exceeds it (m).
const DCM_ERROR_LARGE: f64 = 0.03;
/// A third of the leg length: more is a glitch of a sensor, or no step can correct it (m).
const DCM_ERROR_MAX: f64 = 0.3;
/// An inertial measurement unit askew by 2°, or an eighth of the robot's weight on its back (m).
const COM_OFFSET_MAX: f64 = 0.03;
/// Far outside the sole: with the stiffness of the ankle a tilt of the sole by 5° shifts the ZMP by as much (m).
const FOOT_DAMPING_ZMP_SHIFT_MAX: f64 = 0.6;
/// 3 % of the leg length: bumps and holes up to this size (m).
const LANDING_LIFT_MAX: f64 = 0.03;
/// A third of the leg length: of 480 pushes around the limit 88 in 100 are told apart within the first tenth of a
/// second after touchdown, and with a third more or less 87 (m).
const SHORTFALL_LOST: f64 = 0.3;
/// Beyond the edge of the feet, to which the noise of the measurement does not reach (m).
const SHORTFALL_LOST_IN_STAND: f64 = 0.03;
/// Tiles between 12 mm below the mean and 12 mm above it: with less, stones are taken for slopes; with more, slopes are
/// seen late (m).
const UNEVENNESS: f64 = 0.007;

impl StabilizerProportions {
    /// The proportions of a robot.
    pub(crate) fn of(mechanism: &Mechanism) -> Self {
        let sole = &mechanism.sole;
        let scale = LegReach::of(mechanism).scale();
        Self {
            weight: mechanism.mass() * GRAVITY,
            sole_half_size: sole.half_size(),
            sole_centre: sole.centre(Side::Right),
            double_support_zmp_shift_max: DOUBLE_SUPPORT_ZMP_SHIFT_MAX * scale,
            dcm_error_of_push: DCM_ERROR_OF_PUSH * scale,
            dcm_error_large: DCM_ERROR_LARGE * scale,
            dcm_error_max: DCM_ERROR_MAX * scale,
            com_offset_max: COM_OFFSET_MAX * scale,
            foot_damping_zmp_shift_max: FOOT_DAMPING_ZMP_SHIFT_MAX * scale,
            landing_lift_max: LANDING_LIFT_MAX * scale,
            shortfall_lost: SHORTFALL_LOST * scale,
            shortfall_lost_in_stand: SHORTFALL_LOST_IN_STAND * scale,
            unevenness: UNEVENNESS * scale,
        }
    }
}
