//! Derivatives of the zero-moment point by each joint's angle, rate and acceleration, in closed form.
//!
//! A mass point x beyond a joint moves with the joint's angle by `∂x/∂q = S(x) = axis × (x − origin)`. Derivatives by
//! time and by angle commute, so
//!
//! ```text
//! ∂ẍ/∂q̈ = S(x)        ∂ẍ/∂q̇ = 2·d/dt S(x) = 2·(Ṡ(x) + axis × ẋ)
//!                     ∂ẍ/∂q = d²/dt² S(x) = S̈(x) + 2·axis′ × ẋ + axis × ẍ
//! ```
//!
//! where Ṡ and S̈ follow from the motion of the parent. Summed over the mass points beyond the joint, the terms are
//!
//! * a rigid field of accelerations: needs their mass and its moments ([`Composite`]),
//! * a rotation of their velocities: needs their momentum `Σ mẋ` and `Σ mẋxᵀ` ([`Subtree`]),
//! * a rotation of their accelerations; since the angle also moves the points at which forces act, this rotates the
//!   wrench that they need.
//!
//! Everything is expressed about one common origin, so one pass from the tips inward yields the three columns of every
//! joint. In spatial algebra: Carpentier and Mansard, "Analytical derivatives of rigid body dynamics algorithms", RSS
//! 2018, for the wrench of the base alone.

use model::{GRAVITY, Joint, Motion, PerJoint, Wrench};
use nalgebra::{Matrix3, Vector2, Vector3};

use crate::composite::Composite;
use crate::newton_euler::LinkMotion;
use crate::twist::Twist;
use crate::{NewtonEuler, Tree, zmp};

/// The derivatives of the zero-moment point, with intermediates. Multiplied by the joints' rates, accelerations and
/// jerks they add up to the velocity of the point.
#[derive(Clone, Debug)]
pub struct ZmpJacobian {
    /// Inverse dynamics of the motion. Filled first.
    pub newton_euler: NewtonEuler,
    /// Velocity of each joint's origin (m/s). Filled by the outward pass.
    velocity: PerJoint<Vector3<f64>>,
    /// Inertia and momentum of each link, and after the inward pass of all links beyond it too.
    subtrees: PerJoint<Subtree>,
    /// Derivative by each joint's angle (m/rad).
    pub by_angle: PerJoint<Vector2<f64>>,
    /// Derivative by each joint's rate (m·s/rad).
    pub by_rate: PerJoint<Vector2<f64>>,
    /// Derivative by each joint's acceleration (m·s²/rad).
    pub by_acceleration: PerJoint<Vector2<f64>>,
}

/// Inertia and momentum of some links together, about the common origin.
#[derive(Clone, Copy, Debug)]
struct Subtree {
    /// Mass and its moments.
    composite: Composite,
    /// `Σ mẋ` (kg·m/s).
    momentum: Vector3<f64>,
    /// `tr(Σ mẋxᵀ) − Σ mẋxᵀ`: maps a to `Σ m·x × (a × ẋ)` (kg·m²/s).
    sweep: Matrix3<f64>,
}

/// Maps the change of a wrench to that of its zero-moment point: horizontal moment about the point per vertical force.
struct Shift {
    zmp: Vector2<f64>,
    per_force: f64,
}

impl Default for ZmpJacobian {
    fn default() -> Self {
        let none = PerJoint([Vector2::zeros(); Joint::COUNT]);
        Self {
            newton_euler: NewtonEuler::default(),
            velocity: PerJoint([Vector3::zeros(); Joint::COUNT]),
            subtrees: PerJoint([Subtree::NONE; Joint::COUNT]),
            by_angle: none,
            by_rate: none,
            by_acceleration: none,
        }
    }
}

impl ZmpJacobian {
    /// Computes the derivatives for a motion with the right sole fixed at O, and returns the zero-moment point itself
    /// (m).
    ///
    /// `None` when the ground does not push ([`zmp()`]): the derivatives are then those of an earlier motion.
    pub fn compute_fixed_base(&mut self, tree: &Tree, motion: &Motion) -> Option<Vector2<f64>> {
        self.newton_euler.compute_fixed_base(tree, motion);
        let ground = self.newton_euler.ground;
        let zmp = zmp(&ground)?;
        self.differentiate(tree, &Shift { zmp, per_force: 1.0 / ground.force.z });
        Some(zmp)
    }

    /// As [`ZmpJacobian::compute_fixed_base`], for the ground's moment about O per weight of the robot, (−My, Mx)/(M·g)
    /// (m): zero where the zero-moment point is O, linear in the wrench, and defined for any motion. Returns this
    /// quotient.
    pub fn moment_per_weight(&mut self, tree: &Tree, motion: &Motion) -> Vector2<f64> {
        self.newton_euler.compute_fixed_base(tree, motion);
        let shift = Shift { zmp: Vector2::zeros(), per_force: 1.0 / (tree.mass * GRAVITY) };
        self.differentiate(tree, &shift);
        shift.of(&self.newton_euler.ground)
    }

    #[inline(always)]
    fn differentiate(&mut self, tree: &Tree, shift: &Shift) {
        self.outward(tree);
        self.inward(tree, shift);
    }

    /// From the ground outward: inertia and momentum of each link by itself.
    #[inline(always)]
    fn outward(&mut self, tree: &Tree) {
        let NewtonEuler { kinematics, links, .. } = &self.newton_euler;
        for &joint in tree.order.all() {
            let node = &tree.nodes[joint];
            self.velocity[joint] = match (node.parent, node.origin) {
                (Some(parent), Some(_)) => {
                    let arm = kinematics.origin[joint] - kinematics.origin[parent];
                    self.velocity[parent] + links[parent].angular_rate.cross(&arm)
                }
                (Some(parent), None) => self.velocity[parent],
                (None, _) => Vector3::zeros(),
            };
            self.subtrees[joint] = if node.body.is_some() {
                let angular = links[joint].angular_rate;
                let linear = self.velocity[joint] - angular.cross(&kinematics.origin[joint]);
                Subtree::new(Composite::of_link(tree, kinematics, joint), &Twist { angular, linear })
            } else {
                Subtree::NONE
            };
        }
    }

    /// From the tips inward: the derivatives by each joint's angle, rate and acceleration.
    #[inline(always)]
    fn inward(&mut self, tree: &Tree, shift: &Shift) {
        let NewtonEuler { kinematics, links, wrench, .. } = &self.newton_euler;
        for &joint in tree.order.all().iter().rev() {
            let subtree = self.subtrees[joint];
            let parent = tree.nodes[joint].parent;
            let carried = match parent {
                Some(parent) => {
                    self.subtrees[parent] = self.subtrees[parent] + subtree;
                    links[parent]
                }
                None => LinkMotion::default(),
            };

            // The joint's field S, and its first and second derivative by the motion of the parent.
            let (origin, axis) = (kinematics.origin[joint], kinematics.axis[joint]);
            let (velocity, acceleration) = (self.velocity[joint], links[joint].acceleration);
            let axis_rate = carried.angular_rate.cross(&axis);
            let axis_acceleration = carried.angular_acceleration.cross(&axis) + carried.angular_rate.cross(&axis_rate);
            let field = Twist { angular: axis, linear: origin.cross(&axis) };
            let field_rate = Twist { angular: axis_rate, linear: velocity.cross(&axis) + origin.cross(&axis_rate) };
            let field_acceleration = Twist {
                angular: axis_acceleration,
                linear: acceleration.cross(&axis) + 2.0 * velocity.cross(&axis_rate) + origin.cross(&axis_acceleration),
            };

            let Subtree { composite, .. } = &subtree;
            let by_rate = composite.times(&field_rate) + subtree.swept(&axis);
            let by_angle =
                composite.times(&field_acceleration) + subtree.swept(&axis_rate) * 2.0 + field.rate_of(&wrench[joint]);
            self.by_acceleration[joint] = shift.of(&composite.times(&field));
            self.by_rate[joint] = shift.of(&by_rate) * 2.0;
            self.by_angle[joint] = shift.of(&by_angle);
        }
    }
}

impl Subtree {
    const NONE: Subtree = Subtree {
        composite: Composite::ZERO,
        momentum: Vector3::new(0.0, 0.0, 0.0),
        sweep: Matrix3::new(0., 0., 0., 0., 0., 0., 0., 0., 0.),
    };

    /// One body: with `ẋ = linear + angular × x` the sum of `mẋxᵀ` is `linear·firstᵀ + [angular]·Σ mxxᵀ`.
    #[inline(always)]
    fn new(composite: Composite, velocity: &Twist) -> Self {
        let Twist { angular, linear } = velocity;
        let Composite { mass, first, second } = &composite;
        let spread = Matrix3::from_diagonal_element(0.5 * second.trace()) - second;
        let moved = linear * first.transpose() + angular.cross_matrix() * spread;
        Self {
            momentum: *mass * linear + angular.cross(first),
            sweep: Matrix3::from_diagonal_element(linear.dot(first)) - moved,
            composite,
        }
    }

    /// The wrench that accelerates each point by `turning × ẋ`.
    #[inline(always)]
    fn swept(&self, turning: &Vector3<f64>) -> Wrench {
        Wrench { force: turning.cross(&self.momentum), moment: self.sweep * turning }
    }
}

impl std::ops::Add for Subtree {
    type Output = Subtree;

    #[inline(always)]
    fn add(self, other: Subtree) -> Subtree {
        Subtree {
            composite: self.composite + other.composite,
            momentum: self.momentum + other.momentum,
            sweep: self.sweep + other.sweep,
        }
    }
}

impl Shift {
    #[inline(always)]
    fn of(&self, change: &Wrench) -> Vector2<f64> {
        let Wrench { force, moment } = change;
        Vector2::new(-moment.y - self.zmp.x * force.z, moment.x - self.zmp.y * force.z) * self.per_force
    }
}
