//! Forward kinematics: the poses of all links.

use std::ops::Range;

use model::{ComState, Joint, JointOrder, JointVector, Mechanism, PerJoint, Side};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::Tree;
use crate::sin_cos::SinCos;
use crate::twist::Twist;

/// Poses of all links, in world axes.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// Orientation of each link, a rotation matrix (-): maps link coordinates to world axes.
    pub rotation: PerJoint<Matrix3<f64>>,
    /// Position of each link's origin, on its joint (m).
    pub origin: PerJoint<Vector3<f64>>,
    /// Axis of each joint, a unit vector in world axes.
    pub axis: PerJoint<Vector3<f64>>,
}

impl Default for Kinematics {
    fn default() -> Self {
        Self {
            rotation: PerJoint([Matrix3::identity(); Joint::COUNT]),
            origin: PerJoint([Vector3::zeros(); Joint::COUNT]),
            axis: PerJoint([Vector3::zeros(); Joint::COUNT]),
        }
    }
}

impl Kinematics {
    /// The poses with the right sole at O; joints 1 and 2 tip the sole on the ground.
    pub fn fixed_base(tree: &Tree, angles: &JointVector) -> Self {
        let mut kinematics = Self::default();
        kinematics.compute_fixed_base(tree, angles);
        kinematics
    }

    /// As [`Kinematics::fixed_base`], up to the pelvis. The poses of the links beyond it are not computed.
    #[inline]
    pub fn fixed_base_up_to_pelvis(tree: &Tree, angles: &JointVector) -> Self {
        let mut kinematics = Self::default();
        kinematics.chain(tree, angles, 0..JointOrder::UP_TO_PELVIS);
        kinematics
    }

    /// As [`Kinematics::fixed_base`], over the pelvis to the left foot. The poses of waist and arms are not computed.
    #[inline]
    pub fn fixed_base_up_to_left_foot(tree: &Tree, angles: &JointVector) -> Self {
        let mut kinematics = Self::default();
        kinematics.chain(tree, angles, 0..JointOrder::UP_TO_LEFT_FOOT);
        kinematics
    }

    /// As [`Kinematics::fixed_base`], in place.
    #[inline]
    pub fn compute_fixed_base(&mut self, tree: &Tree, angles: &JointVector) {
        self.chain(tree, angles, 0..Joint::COUNT);
    }

    /// The poses of the floating robot; `right_sole` is the pose of its right sole, sole to world.
    #[inline]
    pub fn compute_floating_base(&mut self, tree: &Tree, right_sole: &Isometry3<f64>, angles: &JointVector) {
        self.place(Mechanism::RIGHT_FOOT, right_sole);
        self.chain(tree, angles, Joint::FIRST_POWERED.index()..Joint::COUNT);
    }

    /// Sets the pose of one link.
    #[inline(always)]
    pub(crate) fn place(&mut self, link: Joint, link_to_world: &Isometry3<f64>) {
        self.rotation[link] = link_to_world.rotation.to_rotation_matrix().into_inner();
        self.origin[link] = link_to_world.translation.vector;
    }

    /// Computes the poses of the links of `joints`, given by their places in the order, which are whole legs. Their
    /// parents must have poses already or be among them.
    #[inline(always)]
    pub(crate) fn chain(&mut self, tree: &Tree, angles: &JointVector, joints: Range<usize>) {
        let turned = SinCos::of(angles, joints.clone());
        for &joint in &tree.order.all()[joints] {
            let node = &tree.nodes[joint];
            let (parent_rotation, parent_origin) = match node.parent {
                Some(parent) => (self.rotation[parent], self.origin[parent]),
                None => (Matrix3::identity(), Vector3::zeros()),
            };
            let (rotation, axis) = node.axis.apply(&parent_rotation, turned.at(joint));
            self.rotation[joint] = rotation;
            self.axis[joint] = axis;
            self.origin[joint] = match node.origin {
                Some(origin) => parent_origin + parent_rotation * origin,
                None => parent_origin,
            };
        }
    }

    /// Pose of a link: maps link coordinates to world coordinates.
    pub fn link_to_world(&self, link: Joint) -> Isometry3<f64> {
        let rotation = Rotation3::from_matrix_unchecked(self.rotation[link]);
        Isometry3::from_parts(Translation3::from(self.origin[link]), UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// Pose of a sole: maps sole coordinates to world coordinates.
    pub fn sole_to_world(&self, mechanism: &Mechanism, side: Side) -> Isometry3<f64> {
        self.link_to_world(mechanism.foot(side)) * Translation3::from(mechanism.sole_in_foot(side))
    }

    /// Centre of mass of the whole robot (m).
    pub fn com(&self, tree: &Tree) -> Vector3<f64> {
        let mut moment = Vector3::zeros();
        for (link, node) in tree.nodes.iter() {
            if let Some(body) = &node.body {
                moment += body.mass * (self.origin[link] + self.rotation[link] * body.com);
            }
        }
        moment / tree.mass
    }

    /// The centre of mass of a motion whose support sole is flat and at rest, in support coordinates.
    pub fn com_state(&self, tree: &Tree, rates: &JointVector) -> ComState {
        ComState { position: self.com(tree), velocity: self.com_velocity(tree, rates).0 }
    }

    /// Velocity of the centre of mass (m/s) and the velocities of every link, the right sole at rest.
    pub fn com_velocity(&self, tree: &Tree, rates: &JointVector) -> (Vector3<f64>, PerJoint<Twist>) {
        // About the common origin each joint moves what it carries with `rate · (axis, origin × axis)`.
        let at_rest = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
        let mut twists = PerJoint([at_rest; Joint::COUNT]);
        let mut momentum = Vector3::zeros();
        for &link in tree.order.all() {
            let node = &tree.nodes[link];
            let spin = self.axis[link] * rates[link];
            let parent = node.parent.map_or(at_rest, |parent| twists[parent]);
            let twist =
                Twist { angular: parent.angular + spin, linear: parent.linear + self.origin[link].cross(&spin) };
            twists[link] = twist;
            if let Some(body) = &node.body {
                let com = self.origin[link] + self.rotation[link] * body.com;
                momentum += body.mass * twist.at(&com);
            }
        }
        (momentum / tree.mass, twists)
    }
}
