//! Recursive Newton–Euler: the torques and the ground wrench that a motion needs (Luh, Walker and Paul 1980), in world
//! axes about one common origin.

use model::{GRAVITY, Joint, JointVector, Mechanism, Motion, PerJoint, Wrench};
use nalgebra::{Isometry3, Vector3};

use crate::{Kinematics, Tree};

/// Inverse dynamics and its intermediates.
#[derive(Clone, Debug)]
pub struct NewtonEuler {
    /// Poses of all links. Filled first.
    pub kinematics: Kinematics,
    /// Motion of every link. Filled by the outward pass.
    pub(crate) links: PerJoint<LinkMotion>,
    /// Wrench that each link, with all links beyond it, needs from its parent, about the common origin.
    pub(crate) wrench: PerJoint<Wrench>,
    /// Joint torques (N·m).
    pub torques: JointVector,
    /// Wrench of the ground on the robot: about O in support axes, or about the right sole for the floating robot.
    pub ground: Wrench,
}

/// Motion of a link, at its origin in world axes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LinkMotion {
    /// Angular rate of the link (rad/s).
    pub angular_rate: Vector3<f64>,
    /// Angular acceleration of the link (rad/s²).
    pub angular_acceleration: Vector3<f64>,
    /// Acceleration of the link's origin, minus that of free fall (m/s²).
    pub acceleration: Vector3<f64>,
}

/// Pose and motion of the right sole of a floating robot, in world axes.
#[derive(Clone, Copy, Debug)]
pub struct BaseMotion {
    /// Pose of the sole: maps sole coordinates to world coordinates.
    pub sole_to_world: Isometry3<f64>,
    /// Angular rate of the sole (rad/s).
    pub angular_rate: Vector3<f64>,
    /// Velocity of the sole's origin (m/s).
    pub velocity: Vector3<f64>,
    /// Angular acceleration of the sole (rad/s²).
    pub angular_acceleration: Vector3<f64>,
    /// Acceleration of the sole's origin (m/s²).
    pub acceleration: Vector3<f64>,
}

impl Default for NewtonEuler {
    fn default() -> Self {
        Self {
            kinematics: Kinematics::default(),
            links: PerJoint([LinkMotion::default(); Joint::COUNT]),
            wrench: PerJoint([Wrench::ZERO; Joint::COUNT]),
            torques: JointVector::ZERO,
            ground: Wrench::ZERO,
        }
    }
}

impl NewtonEuler {
    /// Inverse dynamics of a motion with the right sole fixed at O: fills `torques` and `ground`.
    ///
    /// The two unpowered joints' "torques" are the ground moment about O around their axes: zero when ZMP ≡ O.
    #[inline]
    pub fn compute_fixed_base(&mut self, tree: &Tree, motion: &Motion) {
        self.compute_with_gravity(tree, motion, GRAVITY);
    }

    /// As [`NewtonEuler::compute_fixed_base`] with another gravity (m/s²); with zero the result is the dynamic part
    /// alone.
    #[inline]
    pub fn compute_with_gravity(&mut self, tree: &Tree, motion: &Motion, gravity: f64) {
        self.kinematics.compute_fixed_base(tree, &motion.angles);
        let ground = LinkMotion { acceleration: Vector3::new(0.0, 0.0, gravity), ..LinkMotion::default() };
        self.outward(tree, motion, ground, tree.order.all().iter().copied());
        self.ground = self.inward(tree, tree.order.all().iter().copied());
    }

    /// Wrench of the ground about O that a motion needs with the right sole fixed at O. Fills neither `torques` nor
    /// `ground`.
    #[inline]
    pub fn ground_wrench(&mut self, tree: &Tree, motion: &Motion) -> Wrench {
        self.kinematics.compute_fixed_base(tree, &motion.angles);
        let ground = LinkMotion { acceleration: Vector3::new(0.0, 0.0, GRAVITY), ..LinkMotion::default() };
        self.outward(tree, motion, ground, tree.order.all().iter().copied());
        self.wrench.0.iter().fold(Wrench::ZERO, |sum, wrench| sum + *wrench)
    }

    /// Inverse dynamics of a motion of the floating robot: fills `torques`, and `ground` with the external wrench about
    /// the right sole's origin that the motion needs.
    pub fn compute_floating_base(&mut self, tree: &Tree, base: &BaseMotion, motion: &Motion) {
        let foot = Mechanism::RIGHT_FOOT;
        self.kinematics.compute_floating_base(tree, &base.sole_to_world, &motion.angles);
        self.links[foot] = LinkMotion {
            angular_rate: base.angular_rate,
            angular_acceleration: base.angular_acceleration,
            acceleration: base.acceleration + Vector3::new(0.0, 0.0, GRAVITY),
        };
        self.wrench[foot] = self.body_wrench(tree, foot);
        self.outward(tree, motion, LinkMotion::default(), tree.floating_joints());
        self.inward(tree, tree.floating_joints());
        self.torques[Joint::FootRoll] = 0.0;
        self.torques[Joint::FootPitch] = 0.0;
        self.ground = self.wrench[foot].about(self.kinematics.origin[foot]);
    }

    /// From the base outward: the motion of each link, and the wrench that its own body needs.
    #[inline(always)]
    fn outward(&mut self, tree: &Tree, motion: &Motion, ground: LinkMotion, joints: impl Iterator<Item = Joint>) {
        for joint in joints {
            let node = &tree.nodes[joint];
            let parent = node.parent.map_or(ground, |parent| self.links[parent]);
            let axis = self.kinematics.axis[joint];
            let spin = axis * motion.rates[joint];

            let mut link = LinkMotion {
                angular_rate: parent.angular_rate + spin,
                angular_acceleration: parent.angular_acceleration
                    + axis * motion.accelerations[joint]
                    + parent.angular_rate.cross(&spin),
                acceleration: parent.acceleration,
            };
            if node.origin.is_some() {
                let parent_origin = node.parent.map_or_else(Vector3::zeros, |parent| self.kinematics.origin[parent]);
                let arm = self.kinematics.origin[joint] - parent_origin;
                link.acceleration += parent.angular_acceleration.cross(&arm)
                    + parent.angular_rate.cross(&parent.angular_rate.cross(&arm));
            }
            self.links[joint] = link;
            self.wrench[joint] = self.body_wrench(tree, joint);
        }
    }

    /// The wrench that a link's own body needs, about the common origin.
    #[inline(always)]
    fn body_wrench(&self, tree: &Tree, joint: Joint) -> Wrench {
        let Some(body) = &tree.nodes[joint].body else { return Wrench::ZERO };
        let link = &self.links[joint];
        let rotation = &self.kinematics.rotation[joint];
        let arm = rotation * body.com;
        let com = self.kinematics.origin[joint] + arm;

        let com_acceleration = link.acceleration
            + link.angular_acceleration.cross(&arm)
            + link.angular_rate.cross(&link.angular_rate.cross(&arm));
        let force = body.mass * com_acceleration;

        let principal = body.principal_rotation(rotation);
        let rate = principal.tr_mul(&link.angular_rate);
        let acceleration = principal.tr_mul(&link.angular_acceleration);
        let moment =
            principal * (body.inertia.component_mul(&acceleration) + rate.cross(&body.inertia.component_mul(&rate)));
        Wrench { force, moment: moment + com.cross(&force) }
    }

    /// From the tips inward: each joint transmits the wrench that all links beyond it need. Returns that of the base.
    #[inline(always)]
    fn inward(&mut self, tree: &Tree, joints: impl DoubleEndedIterator<Item = Joint>) -> Wrench {
        let mut ground = Wrench::ZERO;
        for joint in joints.rev() {
            let wrench = self.wrench[joint];
            let about_joint = wrench.moment - self.kinematics.origin[joint].cross(&wrench.force);
            self.torques[joint] = self.kinematics.axis[joint].dot(&about_joint);
            match tree.nodes[joint].parent {
                Some(parent) => self.wrench[parent] = self.wrench[parent] + wrench,
                None => ground = ground + wrench,
            }
        }
        ground
    }
}
