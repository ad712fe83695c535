//! Torques with which the legs carry forces of the ground.

use model::{JointVector, Side, Wrench};

use crate::{Kinematics, Tree};

/// Torques of the leg joints that carry wrenches of the ground on the feet, by virtual work (N·m); zero beyond the
/// legs. Inertia of the legs is left out: it is the same whatever the ground does.
///
/// * `kinematics` – with the support sole at O
/// * `feet` – wrenches on the support and on the swing foot, about O in support axes
pub fn ground_torques(tree: &Tree, kinematics: &Kinematics, feet: &[Wrench; 2]) -> JointVector {
    let mut torques = JointVector::ZERO;
    // A joint of the support leg hands on to the body what pushes its foot; one of the swing leg holds against it.
    for ((side, wrench), sign) in Side::BOTH.into_iter().zip(feet).zip([1.0, -1.0]) {
        for joint in tree.leg(side) {
            torques[joint] = sign * kinematics.axis[joint].dot(&wrench.about(kinematics.origin[joint]).moment);
        }
    }
    torques
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::{Joint, Mechanism, Mirror, Mirrored, Motion};

    use super::*;
    use crate::NewtonEuler;

    /// The oracle: inverse dynamics. A robot at rest carries its weight on one foot or on the other: what the torques
    /// differ by is what the ground makes of them.
    #[test]
    fn torques_on_one_foot_differ_from_those_on_the_other_by_what_the_ground_needs() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mechanism = Mechanism::load(file).unwrap();
        let (tree, mirror) = (Tree::new(&mechanism), Mirror::new(&mechanism).unwrap());
        let mut motion = Motion::default();
        (motion.angles[Joint::RightKnee], motion.angles[Joint::RightAnklePitch]) = (0.4, -0.2);
        (motion.angles[Joint::RightHipPitch], motion.angles[Joint::LeftKnee]) = (-0.2, 0.3);
        (motion.angles[Joint::LeftHipPitch], motion.angles[Joint::LeftAnklePitch]) = (-0.15, -0.15);
        let [mut on_support, mut on_swing] = [NewtonEuler::default(), NewtonEuler::default()];
        on_support.compute_fixed_base(&tree, &motion);
        on_swing.compute_fixed_base(&tree, &motion.mirrored(&mirror));
        let weight = on_support.ground;
        let torques = |feet| ground_torques(&tree, &on_support.kinematics, &feet);
        let differ = torques([weight, Wrench::ZERO]) - torques([Wrench::ZERO, weight]);
        let expected = on_support.torques - on_swing.torques.mirrored(&mirror);
        for joint in Side::BOTH.into_iter().flat_map(|side| tree.leg(side)) {
            let (differ, expected) = (differ[joint], expected[joint]);
            assert!((differ - expected).abs() < 1e-9 * weight.force.z, "{joint:?}: {differ} instead of {expected} N·m");
        }
    }
}
