//! Kinematics of a floating robot whose held joints turn.

use model::{HeldLink, Joint, JointVector, Mechanism, PerJoint};
use nalgebra::{Isometry3, Vector3};

use crate::held_tree::{HeldPose, HeldPoses, HeldTree};
use crate::sin_cos::{SinCos, sin_cos};
use crate::twist::Twist;
use crate::{Kinematics, Tree};

/// Rates of a floating robot.
#[derive(Clone, Copy, Debug)]
pub struct FloatingRates<'r> {
    /// Angular rate of the right foot, in world axes (rad/s).
    pub angular_rate: Vector3<f64>,
    /// Velocity of the right sole's origin, in world axes (m/s).
    pub velocity: Vector3<f64>,
    /// Joint rates (rad/s).
    pub joints: &'r JointVector,
    /// Rates of the held joints (rad/s).
    pub held: &'r [f64],
}

impl Kinematics {
    /// The poses of the floating robot, and those of its held links, which are none for a tree without held joints.
    ///
    /// * `right_sole` – pose of the right sole, sole to world
    /// * `deflections` – angles of the held joints against those at which they are held (rad)
    /// * `poses` – receives the poses of the held links
    pub fn compute_with_held(
        &mut self,
        tree: &Tree,
        right_sole: &Isometry3<f64>,
        angles: &JointVector,
        deflections: &[f64],
        poses: &mut HeldPoses,
    ) {
        poses.clear();
        let Some(held) = &tree.held else { return self.compute_floating_base(tree, right_sole, angles) };
        self.place(Mechanism::RIGHT_FOOT, right_sole);
        self.place_held_on(held, Mechanism::RIGHT_FOOT, deflections, poses);
        let turned = SinCos::of(angles, Joint::FIRST_POWERED.index()..Joint::COUNT);
        for joint in tree.floating_joints() {
            let node = &tree.nodes[joint];
            let Some(parent) = node.parent else { continue };
            let (parent_rotation, parent_origin, origin) = match held.below[joint] {
                Some((below, origin)) => (poses[below].rotation, poses[below].origin, origin),
                None => (self.rotation[parent], self.origin[parent], node.origin.unwrap_or_default()),
            };
            (self.rotation[joint], self.axis[joint]) = node.axis.apply(&parent_rotation, turned.at(joint));
            self.origin[joint] = parent_origin + parent_rotation * origin;
            self.place_held_on(held, joint, deflections, poses);
        }
    }

    /// The poses of the held links into `poses`, once those of all others are known.
    pub fn held_poses(&self, tree: &Tree, deflections: &[f64], poses: &mut HeldPoses) {
        poses.clear();
        if let Some(held) = &tree.held {
            self.place_held_on(held, Mechanism::RIGHT_FOOT, deflections, poses);
            tree.floating_joints().for_each(|joint| self.place_held_on(held, joint, deflections, poses));
        }
    }

    /// Adds the poses of the held links on a link whose own pose is known.
    fn place_held_on(&self, held: &HeldTree, link: Joint, deflections: &[f64], poses: &mut HeldPoses) {
        for index in held.on(link) {
            let node = &held.nodes[index];
            let (parent_rotation, parent_origin) = match node.below {
                Some(below) => (poses[below].rotation, poses[below].origin),
                None => (self.rotation[link], self.origin[link]),
            };
            let deflection = deflections.get(index).copied().unwrap_or(0.0);
            let (rotation, axis) = node.axis.apply(&parent_rotation, sin_cos(deflection));
            // As many places as held links.
            let _ = poses.push(HeldPose { rotation, origin: parent_origin + parent_rotation * node.origin, axis });
        }
    }

    /// Centre of mass of the floating robot with its held links (m), and its velocity (m/s).
    pub fn com_with_held(&self, tree: &Tree, poses: &HeldPoses, rates: &FloatingRates) -> (Vector3<f64>, Vector3<f64>) {
        let base = Twist {
            angular: rates.angular_rate,
            linear: rates.velocity - rates.angular_rate.cross(&self.origin[Mechanism::RIGHT_FOOT]),
        };
        let mut links = PerJoint([base; Joint::COUNT]);
        let mut of_held = heapless::Vec::<Twist, { HeldLink::COUNT_MAX }>::new();
        let (mut moment, mut momentum) = (Vector3::zeros(), Vector3::zeros());
        let mut add = |mass: f64, com: Vector3<f64>, twist: &Twist| {
            moment += mass * com;
            momentum += mass * (twist.linear + twist.angular.cross(&com));
        };
        for joint in std::iter::once(Mechanism::RIGHT_FOOT).chain(tree.floating_joints()) {
            let node = &tree.nodes[joint];
            if joint != Mechanism::RIGHT_FOOT
                && let Some(parent) = node.parent
            {
                let carrier = tree.held_below(joint).map_or(links[parent], |below| of_held[below]);
                links[joint] = spun(&carrier, &self.axis[joint], &self.origin[joint], rates.joints[joint]);
            }
            if let Some(body) = &node.body {
                add(body.mass, self.origin[joint] + self.rotation[joint] * body.com, &links[joint]);
            }
            let Some(held) = &tree.held else { continue };
            for index in held.on(joint) {
                let (node, pose) = (&held.nodes[index], &poses[index]);
                let carrier = node.below.map_or(links[joint], |below| of_held[below]);
                let rate = rates.held.get(index).copied().unwrap_or(0.0);
                let twist = spun(&carrier, &pose.axis, &pose.origin, rate);
                // As many places as held links.
                let _ = of_held.push(twist);
                if let Some(body) = &node.body {
                    add(body.mass, pose.origin + pose.rotation * body.com, &twist);
                }
            }
        }
        (moment / tree.mass, momentum / tree.mass)
    }
}

/// The twist of a link that turns about an axis through `origin` at a rate, against one that moves by itself.
fn spun(carrier: &Twist, axis: &Vector3<f64>, origin: &Vector3<f64>, rate: f64) -> Twist {
    let spin = axis * rate;
    Twist { angular: carrier.angular + spin, linear: carrier.linear + origin.cross(&spin) }
}
