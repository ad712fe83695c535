//! Recursive Newton–Euler: the torques and the ground wrench that a motion needs (Luh, Walker and Paul 1980), in world
//! axes about one common origin.

use model::{GRAVITY, Joint, JointVector, Mechanism, Motion, PerJoint, Side, Wrench};
use nalgebra::{Isometry3, Vector3};

use crate::{Kinematics, Tree};

/// Inverse dynamics and its intermediates.
#[derive(Clone, Debug)]
pub struct NewtonEuler {
    /// Filled first: where every link is.
    pub kinematics: Kinematics,
    /// Filled by the outward pass: how every link moves.
    pub(crate) links: PerJoint<LinkMotion>,
    /// Wrench that each link with all beyond it needs from its parent, about the common origin.
    pub(crate) needs: PerJoint<Wrench>,
    /// Joint torques [N·m].
    pub torques: JointVector,
    /// Wrench of the ground on the robot: about O in support axes, or about the right sole for the floating robot.
    pub ground: Wrench,
}

/// How a link moves, told at its origin in world axes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LinkMotion {
    /// [rad/s]
    pub angular_rate: Vector3<f64>,
    /// [rad/s²]
    pub angular_acceleration: Vector3<f64>,
    /// Of the link's origin, less gravity [m/s²].
    pub acceleration: Vector3<f64>,
}

/// How the right sole of a floating robot moves, in world axes.
#[derive(Clone, Copy, Debug)]
pub struct BaseMotion {
    /// Maps sole coordinates to world coordinates.
    pub sole_to_world: Isometry3<f64>,
    /// [rad/s]
    pub angular_rate: Vector3<f64>,
    /// Of the sole's origin [m/s].
    pub velocity: Vector3<f64>,
    /// [rad/s²]
    pub angular_acceleration: Vector3<f64>,
    /// Of the sole's origin [m/s²].
    pub acceleration: Vector3<f64>,
}

impl Default for NewtonEuler {
    fn default() -> Self {
        Self {
            kinematics: Kinematics::default(),
            links: PerJoint([LinkMotion::default(); Joint::COUNT]),
            needs: PerJoint([Wrench::ZERO; Joint::COUNT]),
            torques: JointVector::ZERO,
            ground: Wrench::ZERO,
        }
    }
}

impl NewtonEuler {
    /// What a motion needs with the right sole held at O: fills `torques` and `ground`.
    ///
    /// The two unpowered joints' "torques" are the ground moment about O around their axes: zero when ZMP ≡ O.
    #[inline]
    pub fn stand(&mut self, tree: &Tree, motion: &Motion) {
        self.standing_under(tree, motion, GRAVITY);
    }

    /// As [`NewtonEuler::stand`] with another gravity [m/s²]; zero leaves the dynamic part alone.
    #[inline]
    pub fn standing_under(&mut self, tree: &Tree, motion: &Motion, gravity: f64) {
        self.kinematics.stand(tree, &motion.angles);
        let ground = LinkMotion { acceleration: Vector3::new(0.0, 0.0, gravity), ..LinkMotion::default() };
        self.outward(tree, motion, ground, Joint::ALL.into_iter());
        self.ground = self.inward(tree, Joint::ALL.into_iter());
    }

    /// The wrench of the ground alone, about O, that a motion needs with the right sole held at O: fills neither `torques`
    /// nor `ground`.
    #[inline]
    pub fn ground_wrench(&mut self, tree: &Tree, motion: &Motion) -> Wrench {
        self.kinematics.stand(tree, &motion.angles);
        let ground = LinkMotion { acceleration: Vector3::new(0.0, 0.0, GRAVITY), ..LinkMotion::default() };
        self.outward(tree, motion, ground, Joint::ALL.into_iter());
        self.needs.0.iter().fold(Wrench::ZERO, |sum, needs| sum + *needs)
    }

    /// What a motion of the floating robot needs: `ground` is the wrench about the right sole's origin that moves it so.
    pub fn float(&mut self, tree: &Tree, base: &BaseMotion, motion: &Motion) {
        let foot = Mechanism::foot(Side::Right);
        self.kinematics.float(tree, &base.sole_to_world, &motion.angles);
        self.links[foot] = LinkMotion {
            angular_rate: base.angular_rate,
            angular_acceleration: base.angular_acceleration,
            acceleration: base.acceleration + Vector3::new(0.0, 0.0, GRAVITY),
        };
        self.needs[foot] = self.body_needs(tree, foot);
        self.outward(tree, motion, LinkMotion::default(), Tree::floating_joints());
        self.inward(tree, Tree::floating_joints());
        self.torques[Joint::FootRoll] = 0.0;
        self.torques[Joint::FootPitch] = 0.0;
        self.ground = self.needs[foot].about(self.kinematics.origin[foot]);
    }

    /// From the base out: how each link moves, and what its own body needs for it.
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
            self.needs[joint] = self.body_needs(tree, joint);
        }
    }

    /// The wrench that a link's own body needs, about the common origin.
    #[inline(always)]
    fn body_needs(&self, tree: &Tree, joint: Joint) -> Wrench {
        let Some(body) = &tree.nodes[joint].body else { return Wrench::ZERO };
        let link = &self.links[joint];
        let rotation = &self.kinematics.rotation[joint];
        let arm = rotation * body.com;
        let com = self.kinematics.origin[joint] + arm;

        let com_acceleration = link.acceleration
            + link.angular_acceleration.cross(&arm)
            + link.angular_rate.cross(&link.angular_rate.cross(&arm));
        let force = body.mass * com_acceleration;

        let rate = rotation.tr_mul(&link.angular_rate);
        let acceleration = rotation.tr_mul(&link.angular_acceleration);
        let moment =
            rotation * (body.inertia.component_mul(&acceleration) + rate.cross(&body.inertia.component_mul(&rate)));
        Wrench { force, moment: moment + com.cross(&force) }
    }

    /// From the tips in: each joint bears what all beyond it needs. Gives what the last (the base) needs.
    #[inline(always)]
    fn inward(&mut self, tree: &Tree, joints: impl DoubleEndedIterator<Item = Joint>) -> Wrench {
        let mut ground = Wrench::ZERO;
        for joint in joints.rev() {
            let needs = self.needs[joint];
            let about_joint = needs.moment - self.kinematics.origin[joint].cross(&needs.force);
            self.torques[joint] = self.kinematics.axis[joint].dot(&about_joint);
            match tree.nodes[joint].parent {
                Some(parent) => self.needs[parent] = self.needs[parent] + needs,
                None => ground = ground + needs,
            }
        }
        ground
    }
}
