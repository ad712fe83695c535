//! Mechanical energy: an oracle for tests of the simulation, not used by the product.

use model::{GRAVITY, JointVector};
use nalgebra::Vector3;

use crate::{Kinematics, Tree};

/// Potential energy relative to the world's z = 0 (J). An oracle for tests.
pub fn potential_energy(tree: &Tree, kinematics: &Kinematics) -> f64 {
    tree.mass * GRAVITY * kinematics.com(tree).z
}

/// Kinetic energy of the links, without that of the rotors (J). An oracle for tests.
///
/// `angular_rate` (rad/s) and `velocity` (m/s) are those of the right sole, in world axes.
pub fn kinetic_energy(
    tree: &Tree,
    kinematics: &Kinematics,
    angular_rate: Vector3<f64>,
    velocity: Vector3<f64>,
    rates: &JointVector,
) -> f64 {
    let mut twists = [(angular_rate, velocity); model::Joint::COUNT];
    let mut energy = 0.0;
    for &joint in tree.order.all() {
        let node = &tree.nodes[joint];
        if joint.is_powered()
            && let Some(parent) = node.parent
        {
            let (parent_rate, parent_velocity) = twists[parent.index()];
            let arm = kinematics.origin[joint] - kinematics.origin[parent];
            twists[joint.index()] =
                (parent_rate + kinematics.axis[joint] * rates[joint], parent_velocity + parent_rate.cross(&arm));
        }
        if let Some(body) = &node.body {
            let (rate, velocity) = twists[joint.index()];
            let com_velocity = velocity + rate.cross(&(kinematics.rotation[joint] * body.com));
            let rate_in_link = body.principal_rotation(&kinematics.rotation[joint]).tr_mul(&rate);
            energy += 0.5 * body.mass * com_velocity.norm_squared()
                + 0.5 * rate_in_link.dot(&body.inertia.component_mul(&rate_in_link));
        }
    }
    energy
}
