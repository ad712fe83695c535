//! The drives of held joints: position servos that hold an angle, as strong as their effort.

use dynamics::HeldJointDrive;
use model::{Joint, Servo, TorqueSource, UnlumpedMechanism};

use crate::{HeldMotion, ServoShares};

/// The drives of all held joints.
#[derive(Clone, Debug)]
pub struct HeldDrives(Vec<HeldDrive>);

#[derive(Clone, Debug)]
struct HeldDrive {
    mount: Joint,
    servo: Servo,
    source: TorqueSource,
}

impl HeldDrives {
    /// The drives of a robot.
    ///
    /// * `shares` – what the plant's servos have of the mechanism's
    pub fn new(robot: &UnlumpedMechanism, shares: ServoShares) -> Self {
        let held = robot.held.iter().enumerate();
        let drives = held.map(|(index, link)| HeldDrive {
            mount: link.mount,
            servo: shares.of(robot.servo_of(index)),
            source: link.drive,
        });
        Self(drives.collect())
    }

    /// Motion and drive of each joint over a step (s), at the end of which each torque is to be that of its servo:
    /// linear in the joint's acceleration, and explicit where the effort bounds it.
    pub fn over_step(&self, motion: &HeldMotion, step: f64) -> impl ExactSizeIterator<Item = HeldJointDrive> {
        let at = |values: &[f64], index: usize| values.get(index).copied().unwrap_or(0.0);
        self.0.iter().enumerate().map(move |(index, HeldDrive { servo, source, .. })| {
            let (deflection, rate) = (at(&motion.deflections, index), at(&motion.rates, index));
            let desired = -servo.stiffness * (deflection + step * rate) - servo.damping * rate;
            let (torque, electrical) = if desired.abs() <= source.effort {
                (desired, step * servo.damping + step * step * servo.stiffness)
            } else {
                (source.effort.copysign(desired), 0.0)
            };
            HeldJointDrive { deflection, rate, torque, armature: source.armature + electrical }
        })
    }

    /// The joint on whose link a held one is.
    pub(crate) fn mount(&self, index: usize) -> Option<Joint> {
        self.0.get(index).map(|drive| drive.mount)
    }
}
