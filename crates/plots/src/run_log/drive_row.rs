//! What the drives were to do at a tick, and what they did.

use model::{Joint, JointVector, Mechanism, Motor, PerJoint};
use serde::Serialize;
use wire::{MeasurementMessage, SetpointMessage};

use super::{CsvRow, columns};

/// Setpoint and measurement of all joints at one tick; NaN where a value is missing, or absurd.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DriveRow {
    /// Time since the start of the run (s).
    pub time: f64,
    /// Angles that were to be reached by this tick: those of the setpoint before (rad).
    #[serde(serialize_with = "columns::known_joints")]
    pub asked_angles: JointVector,
    /// Torques that the motion was expected to need, likewise (N·m).
    #[serde(serialize_with = "columns::known_joints")]
    pub expected_torques: JointVector,
    /// Measured angles (rad).
    #[serde(serialize_with = "columns::known_joints")]
    pub angles: JointVector,
    /// Measured rates (rad/s).
    #[serde(serialize_with = "columns::known_joints")]
    pub rates: JointVector,
    /// Torques of the motors at the joints (N·m). Those of DC motors follow from the current; those of other drives are
    /// what their servos are made to yield, within their effort.
    #[serde(serialize_with = "columns::known_joints")]
    pub torques: JointVector,
    /// Measured currents of DC motors (A).
    #[serde(serialize_with = "columns::known_joints")]
    pub currents: JointVector,
}

/// No angle (rad), rate (rad/s), torque (N·m) or current (A) is larger.
const ABSURD: f64 = 1e6;

impl DriveRow {
    /// The row of a measurement at a time (s), and of the setpoint that it responds to.
    pub(super) fn new(
        time: f64,
        mechanism: &Mechanism,
        asked: &SetpointMessage,
        measured: &MeasurementMessage,
    ) -> Self {
        let sound = |values: &[f64; Joint::COUNT]| {
            PerJoint::from_fn(|joint| {
                let value = values[joint.index()];
                if mechanism.has(joint) && value.abs() <= ABSURD { value } else { f64::NAN }
            })
        };
        let (asked_angles, asked_rates) = (sound(&asked.angles), sound(&asked.rates));
        let (angles, rates) = (sound(&measured.angles), sound(&measured.rates));
        let (expected_torques, all_currents) = (sound(&asked.feed_forward), sound(&measured.motor_current));
        let servo_torque = |joint: Joint, effort: f64| {
            let servo = mechanism.servos.of(joint);
            let desired = servo.stiffness * (asked_angles[joint] - angles[joint])
                + servo.damping * (asked_rates[joint] - rates[joint])
                + expected_torques[joint];
            if desired.abs() > effort { effort.copysign(desired) } else { desired }
        };
        let torques = PerJoint::from_fn(|joint| match &mechanism.links[joint].motor {
            Some(Motor::Dc(motor)) => motor.torque_per_ampere() * all_currents[joint],
            Some(Motor::Torque(source)) => servo_torque(joint, source.effort),
            None => f64::NAN,
        });
        let currents = PerJoint::from_fn(|joint| {
            let is_dc = mechanism.links[joint].motor.is_some_and(|motor| motor.dc().is_some());
            if is_dc { all_currents[joint] } else { f64::NAN }
        });
        Self { time, asked_angles, expected_torques, angles, rates, torques, currents }
    }
}

impl CsvRow for DriveRow {
    const FILE: &str = "drives.csv";

    fn columns() -> Vec<String> {
        let quantities =
            ["asked_angle_rad", "expected_torque_n_m", "angle_rad", "rate_rad_s", "torque_n_m", "current_a"];
        let of_joints = |quantity| Joint::ALL.map(|joint| format!("joint_{:02}_{quantity}", joint.number()));
        std::iter::once("t_s".to_owned()).chain(quantities.into_iter().flat_map(of_joints)).collect()
    }
}

#[cfg(test)]
mod tests {
    use model::TorqueSource;

    use super::super::synthetic::{drives_at, mechanism};
    use super::*;

    #[test]
    fn torque_of_a_dc_motor_follows_from_its_current() {
        let row = drives_at(0.5, &mechanism(), |_| 2.0);
        // 0.0934 N·m/A and a gear of 50 in the legs, 0.0603 and 60 in the arms.
        assert!((row.torques[Joint::RightKnee] - 9.34).abs() < 1e-9 && row.currents[Joint::RightKnee] == 2.0);
        assert!((row.torques[Joint::LeftElbow] - 7.236).abs() < 1e-9);
        assert!(row.torques[Joint::FootRoll].is_nan(), "it has no motor");
    }

    #[test]
    fn torque_of_another_drive_is_that_of_its_servo_within_its_effort() {
        let mut mechanism = mechanism();
        for (effort, expected) in [(300.0, 61.0), (40.0, 40.0)] {
            mechanism.links[Joint::RightKnee].motor = Some(Motor::Torque(TorqueSource { effort, armature: 0.1 }));
            // 0.01 rad of 5000 N·m/rad, 0.1 rad/s of 150 N·m·s/rad the other way, 26 N·m expected.
            let mut asked = SetpointMessage::new(1, 0, &interface::Setpoint::default());
            asked.angles[Joint::RightKnee.index()] = 0.01;
            asked.feed_forward[Joint::RightKnee.index()] = 26.0;
            let mut measured = super::super::synthetic::measurement(2.0);
            measured.rates[Joint::RightKnee.index()] = 0.1;
            let row = DriveRow::new(0.0, &mechanism, &asked, &measured);
            assert!((row.torques[Joint::RightKnee] - expected).abs() < 1e-9, "{}", row.torques[Joint::RightKnee]);
            assert!(row.currents[Joint::RightKnee].is_nan(), "nobody knows it");
        }
    }
}
