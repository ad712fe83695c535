//! DC motors and their drives: a position servo that commands a voltage, and what the motor makes of it.

use model::{Joint, JointVector, Mechanism, Motor, PerJoint};

use crate::{ServoParameters, Setpoint};

/// All drives.
#[derive(Clone, Debug)]
pub struct Drive {
    motors: PerJoint<Option<Motor>>,
    servo: PerJoint<ServoParameters>,
    /// Rotors as the joints feel them [kg·m²].
    rotors: JointVector,
}

/// What the drives do over the coming integration step.
#[derive(Clone, Copy, Debug, Default)]
pub struct DriveTorque {
    /// Joint torques if nothing accelerated [N·m].
    pub torques: JointVector,
    /// How much a torque lessens per joint acceleration: rotor, and the servo's or the back-EMF's answer over the step
    /// [kg·m²].
    pub armature: JointVector,
    /// Which part of `armature` acts through the motor's current [kg·m²].
    pub electrical: JointVector,
}

impl Drive {
    /// The drives of a mechanism.
    pub fn new(mechanism: &Mechanism, servo: &PerJoint<ServoParameters>) -> Self {
        let motors = PerJoint::from_fn(|joint| mechanism.links[joint].motor);
        let rotors = PerJoint::from_fn(|joint| motors[joint].map_or(0.0, |motor| motor.reflected_inertia()));
        Self { motors, servo: *servo, rotors }
    }

    /// The torques towards a setpoint that is to be reached at `lead` seconds from the end of this step.
    pub fn press(
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
            let wanted = servo.stiffness * (target - angles[joint] - step * rate)
                + servo.damping * (setpoint.rates[joint] - rate)
                + setpoint.feed_forward[joint];

            // The drive compensates the back-EMF as far as its voltage goes.
            let back_emf_torque = motor.back_emf_damping() * rate;
            let torque_max = motor.torque_per_volt() * motor.voltage_max;
            let driven = wanted + back_emf_torque;
            let (torque, electrical) = if driven.abs() <= torque_max {
                (wanted, step * servo.damping + step * step * servo.stiffness)
            } else {
                (torque_max.copysign(driven) - back_emf_torque, step * motor.back_emf_damping())
            };
            drive.torques[joint] = torque;
            drive.electrical[joint] = electrical;
            drive.armature[joint] = self.rotors[joint] + electrical;
        }
        drive
    }

    /// Currents [A] of the torques that acted [N·m].
    pub fn currents(&self, torques: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| {
            self.motors[joint].map_or(0.0, |motor| torques[joint] / (motor.gear_ratio * motor.torque_constant))
        })
    }
}

impl DriveTorque {
    /// The motor torques that acted over the step, now that the accelerations are known [N·m].
    pub fn acted(&self, accelerations: &JointVector) -> JointVector {
        PerJoint::from_fn(|joint| self.torques[joint] - self.electrical[joint] * accelerations[joint])
    }
}
