//! Column j of the mass matrix is the torque that unit acceleration of joint j alone needs, at rest and without
//! gravity.

use dynamics::{Kinematics, NewtonEuler, Tree, mass_matrix};
use halfstep_tests::{mechanism, random, random_joints};
use model::{Joint, JointVector, Motion};

#[test]
fn mass_matrix_columns_are_torques_of_unit_accelerations() {
    let tree = Tree::new(&mechanism());
    let mut random = random(3);
    let mut inverse = NewtonEuler::default();
    for _ in 0..20 {
        let angles = random_joints(&mut random, 1.0);
        let matrix = mass_matrix(&tree, &Kinematics::fixed_base(&tree, &angles));
        for joint in Joint::ALL {
            let motion = Motion { angles, rates: JointVector::ZERO, accelerations: JointVector::unit(joint) };
            inverse.compute_with_gravity(&tree, &motion, 0.0);
            for (row, torque) in inverse.torques.iter() {
                let entry = matrix[(row.index(), joint.index())];
                assert!((entry - torque).abs() < 1e-10, "row {row:?}, column {joint:?}: {entry} against {torque}");
            }
        }
    }
}
