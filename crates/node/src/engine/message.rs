//! What this process and an engine exchange in each control period: rows of little-endian doubles.

use interface::Setpoint;
use model::{Joint, JointVector, PerJoint, Wrench};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use plant::{EngineState, HeldMotion, RobotState};

/// Version of the protocol between this program and engines.
pub(super) const PROTOCOL: u32 = 5;
/// Numbers in a setpoint: angles (rad), rates (rad/s) and feed-forward torques (N·m) of the 20 joints, the number of
/// control periods since the plant's start, and the number of bytes of a change of the world, as JSON, that follows; 0
/// for none.
pub(super) const SETPOINT_LEN: usize = 3 * Joint::COUNT + 2;
/// Numbers in a state: of the right sole position, quaternion w x y z, angular rate, velocity; of the joints angles and
/// rates; of the ground force and moment on the right and on the left foot, about the right sole's origin; motor
/// torques. All but the joints' in world axes, in SI units.
pub(super) const STATE_LEN: usize = 3 + 4 + 3 + 3 + 2 * Joint::COUNT + 2 * 6 + Joint::COUNT;

const SIZE: usize = size_of::<f64>();

/// Encodes a setpoint for the period after `periods` others, and the number of bytes of a change that follows it.
pub(super) fn encode_setpoint(setpoint: &Setpoint, periods: u64, change_bytes: usize) -> [u8; SETPOINT_LEN * SIZE] {
    let mut bytes = [0; SETPOINT_LEN * SIZE];
    let values = [&setpoint.angles, &setpoint.rates, &setpoint.feed_forward];
    let values = values.into_iter().flat_map(|joints| joints.0).chain([periods as f64, change_bytes as f64]);
    for (place, value) in bytes.chunks_exact_mut(SIZE).zip(values) {
        place.copy_from_slice(&value.to_le_bytes());
    }
    bytes
}

/// Decodes a state; `None` if a number in it is not finite or its quaternion is no rotation.
pub(super) fn decode_state(bytes: &[u8; STATE_LEN * SIZE]) -> Option<EngineState> {
    let mut values = bytes.as_chunks::<SIZE>().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
    if values.clone().any(|value| !value.is_finite()) {
        return None;
    }
    let mut next = || values.next().unwrap_or_default();
    let mut vector = || Vector3::from_fn(|_, _| next());
    let place = vector();
    let (w, axis) = (next(), Vector3::from_fn(|_, _| next()));
    let orientation = UnitQuaternion::try_new(Quaternion::from_parts(w, axis), 0.5)?;
    let (angular_rate, velocity) = (Vector3::from_fn(|_, _| next()), Vector3::from_fn(|_, _| next()));
    let mut joints = || PerJoint::from_fn(|_| next());
    let (angles, rates): (JointVector, JointVector) = (joints(), joints());
    let mut wrench = || Wrench { force: Vector3::from_fn(|_, _| next()), moment: Vector3::from_fn(|_, _| next()) };
    let ground = [wrench(), wrench()];
    let motor_torques = PerJoint::from_fn(|_| next());
    let sole_to_world = Isometry3::from_parts(Translation3::from(place), orientation);
    Some(EngineState {
        robot: RobotState { sole_to_world, angular_rate, velocity, angles, rates, held: HeldMotion::default() },
        ground,
        motor_torques,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(values: &[f64; STATE_LEN]) -> [u8; STATE_LEN * SIZE] {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        bytes.try_into().expect("the size of a state")
    }

    #[test]
    fn state_of_an_engine_is_decoded_number_by_number() {
        let mut values: [f64; STATE_LEN] = std::array::from_fn(|index| index as f64);
        values[3..7].copy_from_slice(&[0.0, 1.0, 0.0, 0.0]);
        let state = decode_state(&bytes(&values)).expect("finite");
        let robot = state.robot;
        assert_eq!(robot.sole_to_world.translation.vector, Vector3::new(0.0, 1.0, 2.0));
        assert_eq!(robot.sole_to_world.rotation.i, 1.0);
        assert_eq!((robot.angular_rate.x, robot.velocity.x), (7.0, 10.0));
        assert_eq!((robot.angles[Joint::FootRoll], robot.rates[Joint::LeftElbow]), (13.0, 52.0));
        assert_eq!((state.ground[0].force.x, state.ground[0].moment.x), (53.0, 56.0));
        assert_eq!((state.ground[1].force.x, state.ground[1].moment.z), (59.0, 64.0));
        assert_eq!((state.motor_torques[Joint::FootRoll], state.motor_torques[Joint::LeftElbow]), (65.0, 84.0));
    }

    #[test]
    fn state_of_an_engine_that_is_not_finite_or_no_rotation_is_refused() {
        let mut values = [0.0; STATE_LEN];
        assert_eq!(decode_state(&bytes(&values)), None, "no rotation");
        values[3] = 1.0;
        assert!(decode_state(&bytes(&values)).is_some());
        values[84] = f64::NAN;
        assert_eq!(decode_state(&bytes(&values)), None, "not finite");
    }

    #[test]
    fn setpoint_for_an_engine_is_encoded_as_angles_rates_and_torques() {
        let setpoint = Setpoint {
            angles: JointVector::unit(Joint::FootRoll),
            rates: JointVector::unit(Joint::FootRoll) * 2.0,
            feed_forward: JointVector::unit(Joint::LeftElbow) * 3.0,
        };
        let sent = encode_setpoint(&setpoint, 17, 4000);
        let value = |index: usize| f64::from_le_bytes(sent.as_chunks::<SIZE>().0[index]);
        assert_eq!([value(0), value(20), value(59), value(60), value(61)], [1.0, 2.0, 3.0, 17.0, 4000.0]);
    }
}
