//! DC motors and their drives: a position servo that commands a voltage, and the torque of the motor at that voltage.

use interface::Setpoint;
use model::{Joint, JointVector, Mechanism, Motor, PerJoint, Servo};

use crate::ServoShares;

/// The drives of all joints.
#[derive(Clone, Debug)]
pub struct Drive {
    motors: PerJoint<Option<Motor>>,
    servo: PerJoint<Servo>,
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

impl Drive {
    /// The drives of a mechanism.
    ///
    /// * `shares` – what the plant's servos have of the mechanism's
    pub fn new(mechanism: &Mechanism, shares: ServoShares) -> Self {
        let motors = PerJoint::from_fn(|joint| mechanism.links[joint].motor);
        let rotors = PerJoint::from_fn(|joint| motors[joint].map_or(0.0, |motor| motor.reflected_inertia()));
        let servo = PerJoint::from_fn(|joint| shares.of(mechanism.servos.of(joint)));
        Self { motors, servo, rotors }
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
            dc.map_or(0.0, |motor| torques[joint] / motor.torque_per_ampere())
        })
    }
}

impl DriveTorque {
    /// The motor torques over the step (N·m), once the joint accelerations are known (rad/s²).
    pub fn resolve(&self, accelerations: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| self.torques[joint] - self.electrical[joint] * accelerations[joint])
    }
}
