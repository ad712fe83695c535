//! The part of [`ArticulatedBody`] that is about held joints: the same recursions, for links between and beyond those
//! of the mechanism.

use model::Joint;
use nalgebra::Isometry3;

use crate::held_body::HeldBody;
use crate::held_tree::HeldTree;
use crate::spatial::{cross_motion, set_rigid_motion, spatial};
use crate::{ArticulatedBody, HeldJointDrive, Tree};

impl ArticulatedBody {
    /// Before the first stage: motions and drives of the held joints, in the order of the tree's.
    ///
    /// Allocates only for a tree with another number of held joints than the one before, or than that of
    /// [`ArticulatedBody::new`].
    pub fn set_held(&mut self, drives: impl ExactSizeIterator<Item = HeldJointDrive>) {
        self.held.resize(drives.len(), HeldBody::default());
        self.held.iter_mut().zip(drives).for_each(|(body, drive)| body.drive = drive);
    }

    /// Accelerations of the held joints (rad/s²). Valid after [`ArticulatedBody::accelerations`].
    pub fn held_accelerations(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.held.iter().map(|body| body.joint_acceleration)
    }

    /// Poses of all links, held ones too.
    pub(crate) fn place_all(&mut self, tree: &Tree, at_origin: &Isometry3<f64>, angles: &model::JointVector) {
        if tree.held.is_none() {
            self.kinematics.compute_floating_base(tree, at_origin, angles);
            return;
        }
        self.held.resize(tree.held_count(), HeldBody::default());
        let mut deflections = [0.0; model::HeldLink::COUNT_MAX];
        deflections.iter_mut().zip(&self.held).for_each(|(angle, body)| *angle = body.drive.deflection);
        self.kinematics.compute_with_held(tree, at_origin, angles, &deflections, &mut self.held_poses);
    }

    /// Velocities, inertias and bias wrenches of the held links on a link whose velocity is known.
    pub(crate) fn set_held_on(&mut self, held: &HeldTree, link: Joint) {
        for index in held.on(link) {
            let (node, pose) = (&held.nodes[index], &self.held_poses[index]);
            let carrier = node.below.map_or(self.velocity[link], |below| self.held[below].velocity);
            let body = &mut self.held[index];
            body.subspace = spatial(pose.axis, pose.origin.cross(&pose.axis));
            let joint_velocity = body.subspace * body.drive.rate;
            body.velocity = carrier + joint_velocity;
            body.bias_acceleration = cross_motion(&body.velocity, &joint_velocity);
            let (inertia, bias) = (&mut body.rigid_inertia, &mut body.rigid_bias);
            set_rigid_motion(node.body.as_ref(), &pose.rotation, &pose.origin, &body.velocity, inertia, bias);
        }
    }

    /// Resets inertias and bias wrenches of the held links to their own.
    pub(crate) fn begin_held(&mut self) {
        for body in &mut self.held {
            (body.inertia, body.bias) = (body.rigid_inertia, body.rigid_bias);
        }
    }

    /// Adds the held links on a link to it, from the outermost inward. Everything that they carry has been added to
    /// them.
    pub(crate) fn fold_held_on(&mut self, held: &HeldTree, link: Joint) {
        for index in held.on(link).rev() {
            let body = &mut self.held[index];
            let inertia_by_subspace = body.inertia * body.subspace;
            body.resistance = 1.0 / (body.subspace.dot(&inertia_by_subspace) + body.drive.armature);
            body.effort = body.drive.torque - body.subspace.dot(&body.bias);
            body.inertia_by_subspace = inertia_by_subspace;
            let share = body.resistance * (body.effort - inertia_by_subspace.dot(&body.bias_acceleration));
            let bias = body.bias + body.inertia * body.bias_acceleration + inertia_by_subspace * share;
            let inertia = body.inertia - inertia_by_subspace * (inertia_by_subspace * body.resistance).transpose();
            match held.nodes[index].below {
                Some(below) => {
                    self.held[below].inertia += inertia;
                    self.held[below].bias += bias;
                }
                None => {
                    self.inertia[link] += inertia;
                    self.bias[link] += bias;
                }
            }
        }
    }

    /// Accelerations of the held links on a link whose acceleration is known.
    pub(crate) fn accelerate_held_on(&mut self, held: &HeldTree, link: Joint) {
        for index in held.on(link) {
            let below = held.nodes[index].below;
            let carrier = below.map_or(self.acceleration[link], |below| self.held[below].acceleration);
            let body = &mut self.held[index];
            let carried = carrier + body.bias_acceleration;
            let acceleration = body.resistance * (body.effort - body.inertia_by_subspace.dot(&carried));
            body.acceleration = carried + body.subspace * acceleration;
            body.joint_acceleration = acceleration;
        }
    }
}
