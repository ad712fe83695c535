//! The state of the floating robot.

use dynamics::{Accelerations, FloatingRates, HeldPose, HeldPoses, Kinematics, Tree};
use model::{Joint, JointVector, Mechanism, Motion, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::HeldMotion;

/// Pose and velocity of the floating robot. The base is the right sole.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotState {
    /// Pose of the right sole: maps sole coordinates to world coordinates.
    pub sole_to_world: Isometry3<f64>,
    /// Angular rate of the right foot, in world axes (rad/s).
    pub angular_rate: Vector3<f64>,
    /// Velocity of the right sole's origin, in world axes (m/s).
    pub velocity: Vector3<f64>,
    /// Joint angles (rad); those of the two unpowered joints stay zero, since the base pose takes their place.
    pub angles: JointVector,
    /// Joint rates (rad/s); those of the two unpowered joints stay zero.
    pub rates: JointVector,
    /// Motion of the held joints, in the order of the tree's; what is missing is at rest where it is held.
    pub held: HeldMotion,
}

impl RobotState {
    /// The state of a motion with the right sole flat and at rest, at a height over O (m).
    pub fn on_right_foot(motion: &Motion, height: f64) -> Self {
        Self {
            sole_to_world: Isometry3::translation(0.0, 0.0, height),
            angular_rate: Vector3::zeros(),
            velocity: Vector3::zeros(),
            angles: motion.angles,
            rates: motion.rates,
            held: HeldMotion::default(),
        }
    }

    /// The same pose at rest.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        let (angular_rate, velocity) = (Vector3::zeros(), Vector3::zeros());
        let held = self.held.at_rest();
        Self { angular_rate, velocity, rates: JointVector::ZERO, held, ..self.clone() }
    }

    /// Advances all but the held joints by `step` (s): rates first, then angles with the new rates (semi-implicit
    /// Euler).
    pub fn integrate(&mut self, accelerations: &Accelerations, step: f64) {
        self.rates += accelerations.joints * step;
        self.angles += self.rates * step;
        self.angular_rate += accelerations.base_angular * step;
        self.velocity += accelerations.base_linear * step;
        let rotation = UnitQuaternion::from_scaled_axis(self.angular_rate * step);
        self.sole_to_world = Isometry3::from_parts(
            Translation3::from(self.sole_to_world.translation.vector + self.velocity * step),
            UnitQuaternion::new_normalize((rotation * self.sole_to_world.rotation).into_inner()),
        );
    }

    /// The poses of all links in the world.
    pub fn kinematics(&self, tree: &Tree) -> Kinematics {
        let mut kinematics = Kinematics::default();
        if tree.held_count() == 0 {
            kinematics.compute_floating_base(tree, &self.sole_to_world, &self.angles);
        } else {
            self.place_with_held(tree, &mut kinematics);
        }
        kinematics
    }

    /// Pose of a sole: maps sole coordinates to world coordinates.
    pub fn sole(&self, tree: &Tree, mechanism: &Mechanism, side: Side) -> Isometry3<f64> {
        self.kinematics(tree).sole_to_world(mechanism, side)
    }

    /// Angular rate of a link (rad/s), and velocity of a point that moves with it and is now at
    /// `point` of the world (m/s), in world axes; `kinematics` are those of this state.
    pub fn link_velocity(
        &self,
        tree: &Tree,
        mechanism: &Mechanism,
        kinematics: &Kinematics,
        link: Joint,
        point: Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        if tree.held_count() == 0 {
            self.velocity_given(tree, mechanism, kinematics, &[], (link, point))
        } else {
            self.velocity_with_held(tree, mechanism, kinematics, (link, point))
        }
    }

    fn velocity_given(
        &self,
        tree: &Tree,
        mechanism: &Mechanism,
        kinematics: &Kinematics,
        poses: &[HeldPose],
        (link, point): (Joint, Vector3<f64>),
    ) -> (Vector3<f64>, Vector3<f64>) {
        let mut rate = self.angular_rate;
        let mut velocity = self.velocity + rate.cross(&(point - self.sole_to_world.translation.vector));
        let mut spin_about = |axis: &Vector3<f64>, origin: &Vector3<f64>, joint_rate: f64| {
            let spin = axis * joint_rate;
            rate += spin;
            velocity += spin.cross(&(point - origin));
        };
        let mut carried_by = Some(link);
        while let Some(joint) = carried_by.filter(|joint| joint.is_powered()) {
            spin_about(&kinematics.axis[joint], &kinematics.origin[joint], self.rates[joint]);
            let mut held = tree.held_below(joint);
            while let Some(index) = held {
                spin_about(&poses[index].axis, &poses[index].origin, self.held.rate(index));
                held = tree.held_below_held(index);
            }
            carried_by = mechanism.links[joint].parent;
        }
        (rate, velocity)
    }

    /// Centre of mass of the links in the world (m) and its velocity (m/s); `kinematics` are those of this state.
    pub fn com(&self, tree: &Tree, kinematics: &Kinematics) -> (Vector3<f64>, Vector3<f64>) {
        if tree.held_count() > 0 {
            return self.com_with_held(tree, kinematics);
        }
        let com = kinematics.com(tree);
        let (against_sole, _) = kinematics.com_velocity(tree, &self.rates);
        let arm = com - self.sole_to_world.translation.vector;
        (com, self.velocity + self.angular_rate.cross(&arm) + against_sole)
    }

    // Poses of held links take room on the stack, which only robots that have some need.

    #[inline(never)]
    fn place_with_held(&self, tree: &Tree, kinematics: &mut Kinematics) {
        let (sole, deflections) = (&self.sole_to_world, &self.held.deflections);
        kinematics.compute_with_held(tree, sole, &self.angles, deflections, &mut HeldPoses::new());
    }

    #[inline(never)]
    fn velocity_with_held(
        &self,
        tree: &Tree,
        mechanism: &Mechanism,
        kinematics: &Kinematics,
        at: (Joint, Vector3<f64>),
    ) -> (Vector3<f64>, Vector3<f64>) {
        let mut poses = HeldPoses::new();
        kinematics.held_poses(tree, &self.held.deflections, &mut poses);
        self.velocity_given(tree, mechanism, kinematics, &poses, at)
    }

    #[inline(never)]
    fn com_with_held(&self, tree: &Tree, kinematics: &Kinematics) -> (Vector3<f64>, Vector3<f64>) {
        let (angular_rate, velocity, joints) = (self.angular_rate, self.velocity, &self.rates);
        let rates = FloatingRates { angular_rate, velocity, joints, held: &self.held.rates };
        let mut poses = HeldPoses::new();
        kinematics.held_poses(tree, &self.held.deflections, &mut poses);
        kinematics.com_with_held(tree, &poses, &rates)
    }

    /// Whether every number of the state is finite.
    pub fn is_finite(&self) -> bool {
        let base = self.sole_to_world.translation.vector + self.angular_rate + self.velocity;
        base.iter().all(|value| value.is_finite())
            && self.angles.is_finite()
            && self.rates.is_finite()
            && self.held.is_finite()
    }
}
