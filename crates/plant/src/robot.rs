//! The state of the floating robot.

use dynamics::{Accelerations, Kinematics, Tree};
use model::{Joint, JointVector, Mechanism, Motion, Side};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

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
        }
    }

    /// The same pose at rest.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        let (angular_rate, velocity) = (Vector3::zeros(), Vector3::zeros());
        Self { angular_rate, velocity, rates: JointVector::ZERO, ..self.clone() }
    }

    /// Advances by `step` (s): rates first, then angles with the new rates (semi-implicit Euler).
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
        kinematics.compute_floating_base(tree, &self.sole_to_world, &self.angles);
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
        mechanism: &Mechanism,
        kinematics: &Kinematics,
        link: Joint,
        point: Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let mut rate = self.angular_rate;
        let mut velocity = self.velocity + rate.cross(&(point - self.sole_to_world.translation.vector));
        let mut carried_by = Some(link);
        while let Some(joint) = carried_by.filter(|joint| joint.is_powered()) {
            let spin = kinematics.axis[joint] * self.rates[joint];
            rate += spin;
            velocity += spin.cross(&(point - kinematics.origin[joint]));
            carried_by = mechanism.links[joint].parent;
        }
        (rate, velocity)
    }

    /// Centre of mass of the links in the world (m) and its velocity (m/s); `kinematics` are those of this state.
    pub fn com(&self, tree: &Tree, kinematics: &Kinematics) -> (Vector3<f64>, Vector3<f64>) {
        let com = kinematics.com(tree);
        let (against_sole, _) = kinematics.com_velocity(tree, &self.rates);
        let arm = com - self.sole_to_world.translation.vector;
        (com, self.velocity + self.angular_rate.cross(&arm) + against_sole)
    }

    /// Whether every number of the state is finite.
    pub fn is_finite(&self) -> bool {
        let base = self.sole_to_world.translation.vector + self.angular_rate + self.velocity;
        base.iter().all(|value| value.is_finite()) && self.angles.is_finite() && self.rates.is_finite()
    }
}
