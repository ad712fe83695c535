//! Forward dynamics of the floating robot by articulated bodies (Featherstone 2008, chapter 7).
//!
//! Spatial vectors are (angular, linear), in world axes about the origin of the right sole at this instant, so that
//! articulated inertias are added without being transformed.

use model::{GRAVITY, Joint, JointVector, Mechanism, PerJoint, Wrench};
use nalgebra::{Isometry3, Matrix6, Vector3, Vector6};

use crate::held_body::HeldBody;
use crate::held_tree::HeldPoses;
use crate::spatial::{cross_motion, set_rigid_motion, spatial, split};
use crate::{Kinematics, Tree};

/// Forward dynamics and its intermediates. Filled in two stages, so that contact forces can be computed between them.
#[derive(Clone, Debug)]
pub struct ArticulatedBody {
    /// Acceleration of free fall in world axes (m/s²): downward by default.
    pub gravity: Vector3<f64>,
    /// Poses of all links, in world axes about the *right sole's origin*. Filled by [`ArticulatedBody::set_state`].
    pub kinematics: Kinematics,
    /// Spatial velocity of each link: angular (rad/s), then linear at the right sole's origin (m/s). Filled by
    /// [`ArticulatedBody::set_state`].
    pub velocity: PerJoint<Vector6<f64>>,
    subspace: PerJoint<Vector6<f64>>,
    bias_acceleration: PerJoint<Vector6<f64>>,
    rigid_inertia: PerJoint<Matrix6<f64>>,
    rigid_bias: PerJoint<Vector6<f64>>,
    pub(crate) inertia: PerJoint<Matrix6<f64>>,
    pub(crate) bias: PerJoint<Vector6<f64>>,
    inertia_by_subspace: PerJoint<Vector6<f64>>,
    resistance: JointVector,
    drive: JointVector,
    pub(crate) acceleration: PerJoint<Vector6<f64>>,
    pub(crate) held: Vec<HeldBody>,
    pub(crate) held_poses: Box<HeldPoses>,
}

/// An external load on a link.
#[derive(Clone, Copy, Debug)]
pub struct LinkLoad {
    /// The joint that carries the loaded link.
    pub link: Joint,
    /// Wrench of the load at zero acceleration, in world axes about the right sole's origin.
    pub wrench: Wrench,
    /// Decrease of the wrench per spatial acceleration of the link: zero for a given force, `h·D + h²·K` for a damper
    /// and spring that are integrated implicitly over a step `h`.
    pub added_inertia: Matrix6<f64>,
}

/// Accelerations of the floating robot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Accelerations {
    /// Angular acceleration of the right foot, in world axes (rad/s²).
    pub base_angular: Vector3<f64>,
    /// Acceleration of the right sole's origin, in world axes (m/s²).
    pub base_linear: Vector3<f64>,
    /// Joint accelerations (rad/s²); zero for the two unpowered joints.
    pub joints: JointVector,
}

impl Default for ArticulatedBody {
    fn default() -> Self {
        let vectors = PerJoint([Vector6::zeros(); Joint::COUNT]);
        let matrices = PerJoint([Matrix6::zeros(); Joint::COUNT]);
        Self {
            gravity: Vector3::new(0.0, 0.0, -GRAVITY),
            kinematics: Kinematics::default(),
            velocity: vectors,
            subspace: vectors,
            bias_acceleration: vectors,
            rigid_inertia: matrices,
            rigid_bias: vectors,
            inertia: matrices,
            bias: vectors,
            inertia_by_subspace: vectors,
            resistance: JointVector::ZERO,
            drive: JointVector::ZERO,
            acceleration: vectors,
            held: Vec::new(),
            held_poses: Box::default(),
        }
    }
}

const BASE: Joint = Mechanism::RIGHT_FOOT;

impl ArticulatedBody {
    /// The dynamics of a tree, with room for its held joints.
    pub fn new(tree: &Tree) -> Self {
        Self { held: vec![HeldBody::default(); tree.held_count()], ..Self::default() }
    }

    /// First stage: poses, velocities, and the inertia and bias wrench of each link by itself.
    ///
    /// * `orientation` – pose of the right sole, sole to world; its translation is ignored
    /// * `angular_rate`, `velocity` – angular rate and velocity of the right sole's origin, in world axes (rad/s, m/s)
    pub fn set_state(
        &mut self,
        tree: &Tree,
        orientation: &Isometry3<f64>,
        angular_rate: Vector3<f64>,
        velocity: Vector3<f64>,
        angles: &JointVector,
        rates: &JointVector,
    ) {
        let at_origin = Isometry3::from_parts(Vector3::zeros().into(), orientation.rotation);
        self.place_all(tree, &at_origin, angles);
        // Two instances: a robot without held joints pays nothing for them.
        match &tree.held {
            None => self.set_velocities::<false>(tree, angular_rate, velocity, rates),
            Some(_) => self.set_velocities::<true>(tree, angular_rate, velocity, rates),
        }
    }

    #[inline(always)]
    fn set_velocities<const HELD: bool>(
        &mut self,
        tree: &Tree,
        angular_rate: Vector3<f64>,
        velocity: Vector3<f64>,
        rates: &JointVector,
    ) {
        self.velocity[BASE] = spatial(angular_rate, velocity);
        self.set_rigid_body(tree, BASE);
        if HELD && let Some(held) = &tree.held {
            self.set_held_on(held, BASE);
        }

        for joint in tree.floating_joints() {
            let Some(parent) = tree.nodes[joint].parent else { continue };
            let axis = self.kinematics.axis[joint];
            let subspace = spatial(axis, self.kinematics.origin[joint].cross(&axis));
            let joint_velocity = subspace * rates[joint];
            let carrier = match tree.held_below(joint) {
                Some(below) if HELD => self.held[below].velocity,
                _ => self.velocity[parent],
            };
            let velocity = carrier + joint_velocity;
            self.subspace[joint] = subspace;
            self.velocity[joint] = velocity;
            self.bias_acceleration[joint] = cross_motion(&velocity, &joint_velocity);
            self.set_rigid_body(tree, joint);
            if HELD && let Some(held) = &tree.held {
                self.set_held_on(held, joint);
            }
        }
    }

    /// The link's own inertia, and the wrench that its velocity needs at zero acceleration.
    #[inline]
    fn set_rigid_body(&mut self, tree: &Tree, joint: Joint) {
        let (rotation, origin) = (&self.kinematics.rotation[joint], &self.kinematics.origin[joint]);
        let (inertia, bias) = (&mut self.rigid_inertia[joint], &mut self.rigid_bias[joint]);
        set_rigid_motion(tree.nodes[joint].body.as_ref(), rotation, origin, &self.velocity[joint], inertia, bias);
    }

    /// Second stage: the accelerations under joint torques, external loads and gravity.
    ///
    /// * `torques` – joint torques (N·m); those of the two unpowered joints are ignored
    /// * `armature` – inertia added to each joint's rotation, by rotors and implicitly integrated servos (kg·m²)
    pub fn accelerations(
        &mut self,
        tree: &Tree,
        torques: &JointVector,
        armature: &JointVector,
        loads: &[LinkLoad],
    ) -> Accelerations {
        match &tree.held {
            None => self.solve::<false>(tree, torques, armature, loads),
            Some(_) => self.solve::<true>(tree, torques, armature, loads),
        }
    }

    #[inline(always)]
    fn solve<const HELD: bool>(
        &mut self,
        tree: &Tree,
        torques: &JointVector,
        armature: &JointVector,
        loads: &[LinkLoad],
    ) -> Accelerations {
        self.inertia = self.rigid_inertia;
        self.bias = self.rigid_bias;
        for load in loads {
            // The load decreases with the true acceleration; those computed here contain gravity's upward one.
            let at_rest = load.added_inertia.fixed_columns::<3>(3) * -self.gravity;
            self.inertia[load.link] += load.added_inertia;
            self.bias[load.link] -= spatial(load.wrench.moment, load.wrench.force) + at_rest;
        }

        if HELD {
            self.begin_held();
        }

        for joint in tree.floating_joints().rev() {
            if HELD && let Some(held) = &tree.held {
                self.fold_held_on(held, joint);
            }
            let Some(parent) = tree.nodes[joint].parent else { continue };
            let subspace = self.subspace[joint];
            let inertia_by_subspace = self.inertia[joint] * subspace;
            // A joint that the robot does not have resists whatever turns it.
            let is_rigid = tree.nodes[joint].is_rigid;
            let resistance = if is_rigid { 0.0 } else { 1.0 / (subspace.dot(&inertia_by_subspace) + armature[joint]) };
            let drive = torques[joint] - subspace.dot(&self.bias[joint]);
            self.inertia_by_subspace[joint] = inertia_by_subspace;
            self.resistance[joint] = resistance;
            self.drive[joint] = drive;

            let bias_acceleration = self.bias_acceleration[joint];
            let share = resistance * (drive - inertia_by_subspace.dot(&bias_acceleration));
            let bias = self.bias[joint] + self.inertia[joint] * bias_acceleration + inertia_by_subspace * share;
            let projected = inertia_by_subspace * (inertia_by_subspace * resistance).transpose();
            let inertia = self.inertia[joint] - projected;
            if HELD && let Some(below) = tree.held_below(joint) {
                self.held[below].inertia += inertia;
                self.held[below].bias += bias;
            } else {
                self.inertia[parent] += inertia;
                self.bias[parent] += bias;
            }
        }
        if HELD && let Some(held) = &tree.held {
            self.fold_held_on(held, BASE);
        }

        // Gravity as an upward acceleration of everything.
        let base = self.inertia[BASE].cholesky().map_or_else(Vector6::zeros, |factor| factor.solve(&-self.bias[BASE]));
        self.acceleration[BASE] = base;
        if HELD && let Some(held) = &tree.held {
            self.accelerate_held_on(held, BASE);
        }
        let mut joints = JointVector::ZERO;
        for joint in tree.floating_joints() {
            let Some(parent) = tree.nodes[joint].parent else { continue };
            let carrier = match tree.held_below(joint) {
                Some(below) if HELD => self.held[below].acceleration,
                _ => self.acceleration[parent],
            };
            let carried = carrier + self.bias_acceleration[joint];
            let acceleration =
                self.resistance[joint] * (self.drive[joint] - self.inertia_by_subspace[joint].dot(&carried));
            self.acceleration[joint] = carried + self.subspace[joint] * acceleration;
            joints[joint] = acceleration;
            if HELD && let Some(held) = &tree.held {
                self.accelerate_held_on(held, joint);
            }
        }

        let angular = base.fixed_rows::<3>(0).into_owned();
        let linear = base.fixed_rows::<3>(3).into_owned();
        let (rate, velocity) = split(&self.velocity[BASE]);
        Accelerations { base_angular: angular, base_linear: linear + rate.cross(&velocity) + self.gravity, joints }
    }

    /// Spatial acceleration of a link, free fall included. Valid after [`ArticulatedBody::accelerations`].
    pub fn link_acceleration(&self, link: Joint) -> Vector6<f64> {
        self.acceleration[link] + spatial(Vector3::zeros(), self.gravity)
    }
}
