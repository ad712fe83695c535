//! By how much the drives of the legs yield to forces of the ground that are not planned.

use model::{JointVector, Mechanism, PerJoint, Servo};

/// Deflections of the drives: a servo is a spring with a damper, and yields with a lag.
#[derive(Clone, Debug)]
pub(crate) struct DriveDeflection {
    servos: PerJoint<Servo>,
    /// Measured angles beyond the setpoints, as expected (rad).
    angles: JointVector,
}

impl DriveDeflection {
    /// Drives at their setpoints.
    pub(crate) fn new(mechanism: &Mechanism) -> Self {
        Self { servos: PerJoint::from_fn(|joint| *mechanism.servos.of(joint)), angles: JointVector::ZERO }
    }

    /// Lets `dt` (s) pass under torques beyond the planned ones (N·m).
    pub(crate) fn update(&mut self, torques: &JointVector, dt: f64) {
        self.angles = JointVector::from_fn(|joint| {
            let Servo { stiffness, damping } = self.servos[joint];
            let (angle, lag) = (self.angles[joint], damping / stiffness);
            angle + (-torques[joint] / stiffness - angle) * dt / (lag + dt)
        });
    }

    /// Measured angles beyond the setpoints, as expected (rad).
    pub(crate) fn angles(&self) -> &JointVector {
        &self.angles
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::Joint;

    use super::*;

    /// The oracle: a spring beside a damper under a constant torque, `−τ/k·(1 − e^(−k·t/d))`.
    #[test]
    fn a_drive_yields_as_a_spring_beside_a_damper() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mechanism = Mechanism::load(file).unwrap();
        let Servo { stiffness, damping } = *mechanism.servos.of(Joint::LeftKnee);
        let mut deflection = DriveDeflection::new(&mechanism);
        let torques = JointVector::unit(Joint::LeftKnee) * 80.0;
        for tick in 1..=2000 {
            deflection.update(&torques, 1e-4);
            let time = f64::from(tick) * 1e-4;
            let expected = -80.0 / stiffness * (1.0 - (-stiffness * time / damping).exp());
            let angle = deflection.angles()[Joint::LeftKnee];
            assert!((angle - expected).abs() < 0.01 * 80.0 / stiffness, "{time} s: {angle} instead of {expected}");
        }
        assert_eq!(deflection.angles()[Joint::RightKnee], 0.0);
    }
}
