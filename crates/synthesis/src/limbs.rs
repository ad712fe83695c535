//! The prescribed part of the half-step: both legs and the arms.

use dynamics::{Leg, Tree};
use model::{Joint, Mechanism, Motion, Side};
use nalgebra::Vector3;

use crate::arms::swing_arms;
use crate::jet::Jet;
use crate::leg_motion::{LegEnd, first_guess, move_leg};
use crate::leg_path::{LegPath, hip_distance};
use crate::{SynthesisError, SynthesisParameters};

/// The motion of legs and arms at `points_per_interval` instants of each interval and at the end; the trunk straight
/// and at rest.
///
/// # Errors
/// A leg is too short, or inverse kinematics finds no angles.
pub(crate) fn move_limbs(
    mechanism: &Mechanism,
    tree: &Tree,
    path: &dyn LegPath,
    parameters: &SynthesisParameters,
    points_per_interval: usize,
) -> Result<Vec<(Jet, Motion)>, SynthesisError> {
    let to_left_hip = Vector3::y() * (hip_distance(mechanism) / 2.0);
    let to_ankle = -mechanism.sole_in_foot(Side::Left);
    let last_point = parameters.intervals * points_per_interval;
    let mut angles = first_guess(mechanism);
    let mut points = Vec::with_capacity(last_point + 1);
    for point in 0..=last_point {
        let progress =
            Jet { value: point as f64 / last_point as f64, rate: 1.0 / parameters.duration, acceleration: 0.0 };
        let (pelvis, sole) = (path.pelvis(progress), path.swing_sole(progress));
        let (right_hip, left_hip) = (pelvis.position - to_left_hip, pelvis.position + to_left_hip);
        let (right_ankle, left_ankle) = (to_ankle, sole.position + to_ankle);
        for (side, reach) in [(Side::Right, right_hip - right_ankle), (Side::Left, left_hip - left_ankle)] {
            let (distance, length) = (reach.norm(), leg_length(mechanism));
            if distance >= length {
                let (row, last) = (point / points_per_interval, parameters.intervals);
                return Err(SynthesisError::LegTooShort { row, last, side, distance, length });
            }
        }

        // Inverse kinematics starts from the angles of the instant before.
        let mut motion = Motion::at_rest(angles);
        let ends = [
            LegEnd { position: right_hip, velocity: pelvis.velocity, acceleration: pelvis.acceleration },
            LegEnd {
                position: left_ankle,
                velocity: sole.velocity - pelvis.velocity,
                acceleration: sole.acceleration - pelvis.acceleration,
            },
        ];
        for (side, end) in Side::BOTH.into_iter().zip(&ends) {
            move_leg(tree, Leg(side), end, &mut motion).map_err(|unreachable| SynthesisError::LegUnreachable {
                row: point / points_per_interval,
                last: parameters.intervals,
                side,
                residual: unreachable.residual,
            })?;
        }
        angles = motion.angles;
        swing_arms(mechanism, parameters, progress, &mut motion);
        points.push((progress, motion));
    }
    Ok(points)
}

/// Length of the stretched leg, hip to ankle (m).
fn leg_length(mechanism: &Mechanism) -> f64 {
    mechanism.links[Joint::LeftKnee].origin.norm() + mechanism.links[Joint::LeftAnklePitch].origin.norm()
}
