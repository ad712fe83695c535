//! The mass matrix of the robot standing on its right foot, by composite rigid bodies (Featherstone 2008, §6.2).

use model::{Joint, PerJoint};
use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::{Kinematics, Tree};

/// Joint torques per joint acceleration [kg·m²], in the order of [`Joint::ALL`].
pub type MassMatrix = SMatrix<f64, { Joint::COUNT }, { Joint::COUNT }>;

/// A rigid body about the common origin: mass, first moment, second moment.
#[derive(Clone, Copy, Debug)]
struct Composite {
    mass: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

/// The mass matrix in a posture.
pub fn mass_matrix(tree: &Tree, kinematics: &Kinematics) -> MassMatrix {
    let mut composite = PerJoint::from_fn(|joint| Composite::of_link(tree, kinematics, joint));
    let mut matrix = MassMatrix::zeros();

    for joint in Joint::ALL.into_iter().rev() {
        let body = composite[joint];
        if let Some(parent) = tree.nodes[joint].parent {
            composite[parent] = composite[parent] + body;
        }

        // Wrench that turns everything beyond the joint at unit acceleration, then its torque at each joint below.
        let axis = kinematics.axis[joint];
        let linear = kinematics.origin[joint].cross(&axis);
        let force = body.mass * linear + axis.cross(&body.first);
        let moment = body.second * axis + body.first.cross(&linear);
        let mut below = Some(joint);
        while let Some(other) = below {
            let about_joint = moment - kinematics.origin[other].cross(&force);
            let entry = kinematics.axis[other].dot(&about_joint);
            matrix[(joint.index(), other.index())] = entry;
            matrix[(other.index(), joint.index())] = entry;
            below = tree.nodes[other].parent;
        }
    }
    matrix
}

impl Composite {
    fn of_link(tree: &Tree, kinematics: &Kinematics, joint: Joint) -> Self {
        let Some(body) = &tree.nodes[joint].body else {
            return Self { mass: 0.0, first: Vector3::zeros(), second: Matrix3::zeros() };
        };
        let rotation = &kinematics.rotation[joint];
        let com = kinematics.origin[joint] + rotation * body.com;
        let about_com = rotation * Matrix3::from_diagonal(&body.inertia) * rotation.transpose();
        let cross = com.cross_matrix();
        Self { mass: body.mass, first: body.mass * com, second: about_com - body.mass * cross * cross }
    }
}

impl std::ops::Add for Composite {
    type Output = Composite;

    fn add(self, other: Composite) -> Composite {
        Composite { mass: self.mass + other.mass, first: self.first + other.first, second: self.second + other.second }
    }
}
