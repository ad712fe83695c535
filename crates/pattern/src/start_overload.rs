//! Whether a drive can carry out a start from a stand, or lacks torque for so long that its joint falls behind.
//!
//! A torque limit that is exceeded for a moment, as when a foot leaves the ground, delays a joint by little. A hip that
//! cannot hold the pelvis while the weight shifts and the first foot swings lets it sink until the robot falls.

use model::{Joint, JointVector, Mechanism, PerJoint};

use crate::limit::{ANKLES, Limit, LimitViolation};

/// Share of a torque limit beyond which a joint falls behind (-). Robots walk in stride with 103 %.
const SHARE_MAX: f64 = 1.1;
/// Knots in a row for which it does no harm: 0.1 s. With 115 % a joint is then off by about 0.02 rad, and soon by more.
const KNOTS_MAX: u32 = 10;

/// The drives in the starts of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StartOverload {
    /// The half-step that follows the last stand.
    first_half_step: Option<u64>,
    /// Knots in a row for which a drive has been overloaded.
    knots: PerJoint<u32>,
    /// The first drive that is overloaded for too long, with its largest torque.
    violation: Option<LimitViolation>,
}

impl StartOverload {
    /// Absorbs a knot.
    ///
    /// * `half_step` – in which it is, counted from 0
    /// * `torques` – of physical joints (N·m)
    pub(crate) fn note(
        &mut self,
        mechanism: &Mechanism,
        half_step: u64,
        in_double_support: bool,
        torques: &JointVector,
    ) {
        if in_double_support {
            self.first_half_step = Some(half_step);
        }
        for joint in Joint::ALL {
            let Some(motor) = &mechanism.links[joint].motor else { continue };
            // What the ankles bear of a weight on both feet is up to them: it may as well be nothing.
            let counts = self.first_half_step == Some(half_step) && !(in_double_support && ANKLES.contains(&joint));
            let (torque, max) = (torques[joint], motor.torque_max());
            if !counts || torque.abs() <= SHARE_MAX * max {
                self.knots[joint] = 0;
                continue;
            }
            self.knots[joint] += 1;
            let limit = Limit::Torque(joint);
            let largest = self.violation.map_or(0.0, |violation| violation.value.abs());
            let is_it = self.violation.is_none_or(|violation| violation.limit == limit && torque.abs() > largest);
            if self.knots[joint] > KNOTS_MAX && is_it {
                self.violation = Some(LimitViolation { limit, value: torque, bound: max.copysign(torque) });
            }
        }
    }

    /// The torque that a drive lacks for too long.
    pub(crate) fn violation(&self) -> Option<LimitViolation> {
        self.violation
    }
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    const HIP: Joint = Joint::RightHipRoll;

    fn built_in_robot() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    /// What is found of a stand of some knots and the half-steps after it, with a joint at a share of its torque.
    fn found(joint: Joint, stand: u32, share: impl Fn(u32) -> f64) -> Option<LimitViolation> {
        let mechanism = built_in_robot();
        let max = mechanism.links[joint].motor.unwrap().torque_max();
        let mut overload = StartOverload::default();
        for knot in 0..200 {
            let torques = PerJoint::from_fn(|other| if other == joint { -max * share(knot) } else { 0.0 });
            overload.note(&mechanism, u64::from(knot.saturating_sub(stand) / 60), knot < stand, &torques);
        }
        overload.violation()
    }

    #[test]
    fn a_hip_that_lacks_torque_while_the_first_foot_swings_is_named_with_its_largest_torque() {
        let violation =
            found(HIP, 50, |knot| if (50..70).contains(&knot) { 1.1 + f64::from(knot) * 1e-3 } else { 0.5 });
        let LimitViolation { limit, value, bound } = violation.unwrap();
        assert_eq!(limit, Limit::Torque(HIP));
        assert!((value / bound - 1.169).abs() < 1e-9 && bound < 0.0, "{value} {bound}");
    }

    #[test]
    fn a_moment_a_little_and_what_comes_later_are_borne() {
        assert_eq!(found(HIP, 50, |knot| if (50..60).contains(&knot) { 3.0 } else { 0.5 }), None);
        assert_eq!(found(HIP, 50, |_| 1.09), None);
        assert_eq!(found(HIP, 50, |knot| if knot >= 110 { 1.5 } else { 0.5 }), None, "the second half-step");
        assert_eq!(found(HIP, 0, |_| 1.5), None, "a walk in stride");
    }

    #[test]
    fn ankles_of_a_robot_on_both_feet_need_nothing() {
        assert_eq!(found(Joint::RightAnkleRoll, 50, |knot| if knot < 50 { 1.5 } else { 0.5 }), None);
        assert!(found(Joint::RightAnkleRoll, 50, |_| 1.5).is_some());
    }
}
