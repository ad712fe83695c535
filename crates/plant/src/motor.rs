//! DC motors and their drives: a position servo that commands a voltage, and the torque of the motor at that voltage.

use config::Table;
use interface::Setpoint;
use model::{Joint, JointVector, Mechanism, Motor, PerJoint};

/// A drive's position servo, seen at the joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoParameters {
    /// Torque per deviation of the angle (N·m/rad).
    pub stiffness: f64,
    /// Torque per deviation of the rate (N·m·s/rad).
    pub damping: f64,
}

/// The drives of all joints.
#[derive(Clone, Debug)]
pub struct Drive {
    motors: PerJoint<Option<Motor>>,
    servo: PerJoint<ServoParameters>,
    /// Reflected inertias of the rotors at the joints (kg·m²).
    rotors: JointVector,
}

/// Torques of the drives at the end of an integration step, linear in the joint accelerations over the step.
#[derive(Clone, Copy, Debug, Default)]
pub struct DriveTorque {
    /// Joint torques at zero acceleration (N·m).
    pub torques: JointVector,
    /// Decrease of the joint torque per joint acceleration (kg·m²): by the rotor's inertia, and by the servo's or the
    /// back-EMF's response over the step.
    pub armature: JointVector,
    /// The part of `armature` that acts through the motor's current (kg·m²).
    pub electrical: JointVector,
}

impl ServoParameters {
    /// Reads a table of `[servo]`.
    pub(crate) fn read(table: &Table) -> Self {
        Self {
            stiffness: table.number("stiffness_n_m_per_rad").between(0.0, 1e6),
            damping: table.number("damping_n_m_s_per_rad").between(0.0, 1e5),
        }
    }
}

impl Drive {
    /// The drives of a mechanism.
    pub fn new(mechanism: &Mechanism, servo: &PerJoint<ServoParameters>) -> Self {
        let motors = PerJoint::from_fn(|joint| mechanism.links[joint].motor);
        let rotors = PerJoint::from_fn(|joint| motors[joint].map_or(0.0, |motor| motor.reflected_inertia()));
        Self { motors, servo: *servo, rotors }
    }

    /// The torques towards a setpoint that is to be reached `lead` seconds after the end of this step. Angles (rad) and
    /// rates (rad/s) are those at its beginning, `step` is its length (s).
    pub fn torques_at_step_end(
        &self,
        setpoint: &Setpoint,
        lead: f64,
        angles: &JointVector,
        rates: &JointVector,
        step: f64,
    ) -> DriveTorque {
        let mut drive = DriveTorque::default();
        for joint in Joint::ALL {
            let Some(motor) = &self.motors[joint] else { continue };
            let servo = &self.servo[joint];
            let target = setpoint.angles[joint] - lead * setpoint.rates[joint];
            let rate = rates[joint];
            let desired = servo.stiffness * (target - angles[joint] - step * rate)
                + servo.damping * (setpoint.rates[joint] - rate)
                + setpoint.feed_forward[joint];

            // The drive compensates the back-EMF as far as its voltage goes.
            let back_emf_torque = motor.back_emf_damping() * rate;
            let torque_max = motor.torque_max();
            let driven = desired + back_emf_torque;
            let (torque, electrical) = if driven.abs() <= torque_max {
                (desired, step * servo.damping + step * step * servo.stiffness)
            } else {
                (torque_max.copysign(driven) - back_emf_torque, step * motor.back_emf_damping())
            };
            drive.torques[joint] = torque;
            drive.electrical[joint] = electrical;
            drive.armature[joint] = self.rotors[joint] + electrical;
        }
        drive
    }

    /// Motor currents (A) that yield these motor torques at the joints (N·m).
    pub fn currents(&self, torques: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| {
            // The current of a mere source of torque is unknown.
            let dc = self.motors[joint].as_ref().and_then(Motor::dc);
            dc.map_or(0.0, |motor| torques[joint] / (motor.gear_ratio * motor.torque_constant))
        })
    }
}

impl DriveTorque {
    /// The motor torques over the step (N·m), once the joint accelerations are known (rad/s²).
    pub fn resolve(&self, accelerations: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| self.torques[joint] - self.electrical[joint] * accelerations[joint])
    }
}
