//! The mechanism: a tree of links, one per joint, standing on its right foot.
//!
//! At zero angles the robot stands straight and every link frame is parallel to the world's. A link's frame has its
//! origin on the joint that carries the link.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use crate::{Joint, PerJoint, Side, Sole};

/// The kinematic tree of the robot with its masses, limits and motors. Read-only once loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Name of the robot, for people.
    pub name: String,
    /// Each joint with the link that it carries; parents come before children.
    pub links: PerJoint<Link>,
    /// The soles, alike on both feet.
    pub sole: Sole,
    /// A number that differs when anything physical about the mechanism differs; controller and plant compare it.
    pub fingerprint: u64,
}

/// A joint and the link that it carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The joint that carries the parent link; `None` for the ground.
    pub parent: Option<Joint>,
    /// Axis of rotation, a unit vector, the same in the link's and in the parent's frame; rotation is right-handed.
    pub axis: Unit<Vector3<f64>>,
    /// Position of the joint in the parent's frame (m).
    pub origin: Vector3<f64>,
    /// Mass and inertia of the link; zero mass between joints that meet in one point.
    pub body: Body,
    /// Range and rate limit of the joint; `None` for the unpowered joints.
    pub limits: Option<JointLimits>,
    /// The motor of the joint; `None` for the unpowered joints.
    pub motor: Option<Motor>,
}

/// Mass and inertia of a rigid body, in the link's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass of the body (kg).
    pub mass: f64,
    /// Centre of mass in the link's frame (m).
    pub com: Vector3<f64>,
    /// Principal moments of inertia about the centre of mass, along the link's axes (kg·m²).
    pub inertia: Vector3<f64>,
}

impl Body {
    /// The body of a massless link.
    pub const NONE: Body = Body { mass: 0.0, com: Vector3::new(0.0, 0.0, 0.0), inertia: Vector3::new(0.0, 0.0, 0.0) };
}

/// Range and rate limit of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// Smallest angle (rad).
    pub angle_min: f64,
    /// Largest angle (rad).
    pub angle_max: f64,
    /// Largest rate, either way (rad/s).
    pub rate_max: f64,
}

/// A brushed or brushless DC motor with its gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Armature resistance `R` (Ω).
    pub resistance: f64,
    /// Torque constant `k_t` (N·m/A), equal to the back-EMF constant (V·s/rad).
    pub torque_constant: f64,
    /// Gear ratio: revolutions of the motor per revolution of the joint (-).
    pub gear_ratio: f64,
    /// Rotor inertia, on the motor's side of the gear (kg·m²).
    pub rotor_inertia: f64,
    /// Largest supply voltage, either way (V).
    pub voltage_max: f64,
}

impl Motor {
    /// Reflected rotor inertia, on the joint's side of the gear (kg·m²).
    pub fn reflected_inertia(&self) -> f64 {
        self.rotor_inertia * self.gear_ratio * self.gear_ratio
    }

    /// Torque at the joint for a voltage at standstill (N·m/V).
    pub fn torque_per_volt(&self) -> f64 {
        self.gear_ratio * self.torque_constant / self.resistance
    }

    /// Joint torque lost to back-EMF per joint rate at constant voltage (N·m·s/rad).
    pub fn back_emf_damping(&self) -> f64 {
        self.torque_per_volt() * self.torque_constant * self.gear_ratio
    }
}

impl Mechanism {
    /// The joint whose link is the trunk: it carries the inertial measurement unit.
    pub const TRUNK: Joint = Joint::WaistRoll;

    /// Mass of the whole robot (kg).
    pub fn mass(&self) -> f64 {
        self.links.0.iter().map(|link| link.body.mass).sum()
    }

    /// The link whose bottom is the sole on `side`.
    pub const fn foot(side: Side) -> Joint {
        match side {
            Side::Right => Joint::FootPitch,
            Side::Left => Joint::LeftAnkleRoll,
        }
    }

    /// Position of the sole frame's origin (on the sole, under the ankle) in the frame of the foot link on `side` (m).
    pub fn sole_in_foot(&self, side: Side) -> Vector3<f64> {
        match side {
            Side::Right => Vector3::zeros(),
            Side::Left => Vector3::new(0.0, 0.0, -self.sole.ankle_height),
        }
    }
}

impl Link {
    /// Rotation of the link against its parent at a joint angle (rad): maps link coordinates to parent coordinates.
    pub fn rotation(&self, angle: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&self.axis, angle)
    }

    /// Inertia about the centre of mass as a matrix, in the link's frame (kg·m²).
    pub fn inertia(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal(&self.body.inertia)
    }
}
