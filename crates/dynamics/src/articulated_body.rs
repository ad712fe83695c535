//! Forward dynamics of the floating robot by articulated bodies (Featherstone 2008, chapter 7).
//!
//! Spatial vectors are (angular, linear), in world axes about the origin of the right sole at this instant, so that
//! articulated inertias are added without being transformed.

use model::{GRAVITY, Joint, JointVector, Mechanism, PerJoint, Wrench};
use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3, Vector6};

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
    inertia: PerJoint<Matrix6<f64>>,
    bias: PerJoint<Vector6<f64>>,
    inertia_by_subspace: PerJoint<Vector6<f64>>,
    resistance: JointVector,
    drive: JointVector,
    acceleration: PerJoint<Vector6<f64>>,
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
        }
    }
}

const BASE: Joint = Mechanism::RIGHT_FOOT;

impl ArticulatedBody {
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
        self.kinematics.compute_floating_base(tree, &at_origin, angles);
        self.velocity[BASE] = spatial(angular_rate, velocity);
        self.set_rigid_body(tree, BASE);

        for joint in tree.floating_joints() {
            let Some(parent) = tree.nodes[joint].parent else { continue };
            let axis = self.kinematics.axis[joint];
            let subspace = spatial(axis, self.kinematics.origin[joint].cross(&axis));
            let joint_velocity = subspace * rates[joint];
            let velocity = self.velocity[parent] + joint_velocity;
            self.subspace[joint] = subspace;
            self.velocity[joint] = velocity;
            self.bias_acceleration[joint] = cross_motion(&velocity, &joint_velocity);
            self.set_rigid_body(tree, joint);
        }
    }

    /// The link's own inertia, and the wrench that its velocity needs at zero acceleration.
    #[inline]
    fn set_rigid_body(&mut self, tree: &Tree, joint: Joint) {
        let Some(body) = &tree.nodes[joint].body else {
            self.rigid_inertia[joint] = Matrix6::zeros();
            self.rigid_bias[joint] = Vector6::zeros();
            return;
        };
        let rotation = &self.kinematics.rotation[joint];
        let com = self.kinematics.origin[joint] + rotation * body.com;
        let principal = body.principal_rotation(rotation);
        let scaled = Matrix3::from_columns(&[
            principal.column(0) * body.inertia.x,
            principal.column(1) * body.inertia.y,
            principal.column(2) * body.inertia.z,
        ]);
        let first = (com * body.mass).cross_matrix();
        let second = scaled * principal.transpose() - first * com.cross_matrix();

        let inertia = &mut self.rigid_inertia[joint];
        inertia.fixed_view_mut::<3, 3>(0, 0).copy_from(&second);
        inertia.fixed_view_mut::<3, 3>(0, 3).copy_from(&first);
        inertia.fixed_view_mut::<3, 3>(3, 0).copy_from(&-first);
        inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&Matrix3::from_diagonal_element(body.mass));

        let velocity = self.velocity[joint];
        self.rigid_bias[joint] = cross_force(&velocity, &(*inertia * velocity));
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
        self.inertia = self.rigid_inertia;
        self.bias = self.rigid_bias;
        for load in loads {
            // The load decreases with the true acceleration; those computed here contain gravity's upward one.
            let at_rest = load.added_inertia.fixed_columns::<3>(3) * -self.gravity;
            self.inertia[load.link] += load.added_inertia;
            self.bias[load.link] -= spatial(load.wrench.moment, load.wrench.force) + at_rest;
        }

        for joint in tree.floating_joints().rev() {
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
            self.inertia[parent] += inertia;
            self.bias[parent] += bias;
        }

        // Gravity as an upward acceleration of everything.
        let base = self.inertia[BASE].cholesky().map_or_else(Vector6::zeros, |factor| factor.solve(&-self.bias[BASE]));
        self.acceleration[BASE] = base;
        let mut joints = JointVector::ZERO;
        for joint in tree.floating_joints() {
            let Some(parent) = tree.nodes[joint].parent else { continue };
            let carried = self.acceleration[parent] + self.bias_acceleration[joint];
            let acceleration =
                self.resistance[joint] * (self.drive[joint] - self.inertia_by_subspace[joint].dot(&carried));
            self.acceleration[joint] = carried + self.subspace[joint] * acceleration;
            joints[joint] = acceleration;
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

#[inline(always)]
fn spatial(angular: Vector3<f64>, linear: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

#[inline(always)]
fn split(vector: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(vector[0], vector[1], vector[2]), Vector3::new(vector[3], vector[4], vector[5]))
}

/// `v × m` for motions.
#[inline(always)]
fn cross_motion(velocity: &Vector6<f64>, motion: &Vector6<f64>) -> Vector6<f64> {
    let (angular, linear) = split(velocity);
    let (rotation, translation) = split(motion);
    spatial(angular.cross(&rotation), angular.cross(&translation) + linear.cross(&rotation))
}

/// `v ×* f` for wrenches.
#[inline(always)]
fn cross_force(velocity: &Vector6<f64>, wrench: &Vector6<f64>) -> Vector6<f64> {
    let (angular, linear) = split(velocity);
    let (moment, force) = split(wrench);
    spatial(angular.cross(&moment) + linear.cross(&force), angular.cross(&force))
}
