//! The mass matrix of the robot standing on its right foot, by composite rigid bodies (Featherstone 2008, §6.2): an
//! oracle for tests, not used by the product.

use model::{Joint, PerJoint};
use nalgebra::SMatrix;

use crate::composite::Composite;
use crate::twist::Twist;
use crate::{Kinematics, Tree};

/// Joint torques per joint acceleration (kg·m²), in the order of [`Joint::ALL`].
pub type MassMatrix = SMatrix<f64, { Joint::COUNT }, { Joint::COUNT }>;

/// The mass matrix in a posture, given by its kinematics with the right sole at O. An oracle for tests.
pub fn mass_matrix(tree: &Tree, kinematics: &Kinematics) -> MassMatrix {
    let mut composite = PerJoint::from_fn(|joint| Composite::of_link(tree, kinematics, joint));
    let mut matrix = MassMatrix::zeros();

    for &joint in tree.order.all().iter().rev() {
        let body = composite[joint];
        if let Some(parent) = tree.nodes[joint].parent {
            composite[parent] = composite[parent] + body;
        }

        // Wrench that accelerates everything beyond the joint by a unit of its acceleration, then its torque at each
        // joint below.
        let angular = kinematics.axis[joint];
        let wrench = body.times(&Twist { angular, linear: kinematics.origin[joint].cross(&angular) });
        let mut below = Some(joint);
        while let Some(other) = below {
            let about_joint = wrench.moment - kinematics.origin[other].cross(&wrench.force);
            let entry = kinematics.axis[other].dot(&about_joint);
            matrix[(joint.index(), other.index())] = entry;
            matrix[(other.index(), joint.index())] = entry;
            below = tree.nodes[other].parent;
        }
    }
    matrix
}
