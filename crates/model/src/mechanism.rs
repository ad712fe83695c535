//! The mechanism: a tree of links, one per joint, standing on its right foot.
//!
//! At zero angles the robot stands straight and every link frame is parallel to the world's. A link's frame has its
//! origin on the joint that carries the link.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use crate::{Joint, JointOrder, PerJoint, Servos, Side, Sole, UrdfSource};

/// The kinematic tree of the robot with its masses, limits and motors. Read-only once loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// Name of the robot, for people.
    pub name: String,
    /// Each joint with the link that it carries.
    pub links: PerJoint<Link>,
    /// All joints, parents before their children: the foot, the right leg from the ankle up, the left leg from the hip
    /// down, the waist, the arms.
    pub order: JointOrder,
    /// The soles, alike on both feet.
    pub sole: Sole,
    /// The position servos of its drives.
    pub servos: Servos,
    /// The URDF that it was imported from, if it was.
    pub source: Option<UrdfSource>,
    /// A number that differs when anything physical about the mechanism differs; controller and plant compare it.
    pub fingerprint: u64,
    /// The same without the servos: what a nominal half-step depends on. No gain of a servo changes the planned motion.
    pub body_fingerprint: u64,
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
    /// Range and rate limit of the joint; `None` for the unpowered joints, and for those that the robot does not have.
    pub limits: Option<JointLimits>,
    /// The motor of the joint; `None` for the unpowered joints, and for those that the robot does not have.
    pub motor: Option<Motor>,
}

/// Mass and inertia of a rigid body, in the link's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Mass of the body (kg).
    pub mass: f64,
    /// Centre of mass in the link's frame (m).
    pub com: Vector3<f64>,
    /// Principal moments of inertia about the centre of mass (kg·m²).
    pub inertia: Vector3<f64>,
    /// Orientation of the principal axes: maps their coordinates to the link's. `None` where they are the link's axes.
    pub principal_axes: Option<Rotation3<f64>>,
}

impl Body {
    /// The body of a massless link.
    pub const NONE: Body = Body {
        mass: 0.0,
        com: Vector3::new(0.0, 0.0, 0.0),
        inertia: Vector3::new(0.0, 0.0, 0.0),
        principal_axes: None,
    };

    /// Inertia about the centre of mass as a matrix, in the link's frame (kg·m²).
    pub fn inertia_matrix(&self) -> Matrix3<f64> {
        let principal = Matrix3::from_diagonal(&self.inertia);
        self.principal_axes.map_or(principal, |axes| axes.matrix() * principal * axes.matrix().transpose())
    }

    /// Rotation of the principal axes, given that of the link: both map to the same frame.
    #[inline(always)]
    pub fn principal_rotation(&self, link: &Matrix3<f64>) -> Matrix3<f64> {
        match &self.principal_axes {
            None => *link,
            Some(axes) => link * axes.matrix(),
        }
    }
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

/// What drives a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motor {
    /// A DC motor, whose torque is bounded by its voltage.
    Dc(DcMotor),
    /// A source of torque of which only the limit is known.
    Torque(TorqueSource),
}

/// A brushed or brushless DC motor with its gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DcMotor {
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

/// A source of torque of which only the limit is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueSource {
    /// Largest torque at the joint, either way (N·m).
    pub effort: f64,
    /// Inertia of the rotor, seen at the joint (kg·m²).
    pub armature: f64,
}

impl Motor {
    /// Reflected rotor inertia, on the joint's side of the gear (kg·m²).
    pub fn reflected_inertia(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.rotor_inertia * motor.gear_ratio * motor.gear_ratio,
            Motor::Torque(source) => source.armature,
        }
    }

    /// Largest torque at the joint at standstill, either way (N·m).
    pub fn torque_max(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.torque_per_volt() * motor.voltage_max,
            Motor::Torque(source) => source.effort,
        }
    }

    /// Joint torque lost to back-EMF per joint rate at constant voltage (N·m·s/rad).
    pub fn back_emf_damping(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.torque_per_volt() * motor.torque_constant * motor.gear_ratio,
            Motor::Torque(_) => 0.0,
        }
    }

    /// The DC motor, if it is one.
    pub fn dc(&self) -> Option<&DcMotor> {
        match self {
            Motor::Dc(motor) => Some(motor),
            Motor::Torque(_) => None,
        }
    }
}

impl DcMotor {
    /// Speed of the joint without load, at which the back-EMF takes all of the voltage (rad/s).
    pub fn no_load_speed(&self) -> f64 {
        self.voltage_max / (self.torque_constant * self.gear_ratio)
    }

    /// Torque at the joint for a voltage at standstill (N·m/V).
    pub fn torque_per_volt(&self) -> f64 {
        self.gear_ratio * self.torque_constant / self.resistance
    }
}

impl Mechanism {
    /// The joint whose link is the trunk: it carries the inertial measurement unit.
    pub const TRUNK: Joint = Joint::WaistRoll;

    /// Mass of the whole robot (kg).
    pub fn mass(&self) -> f64 {
        self.links.0.iter().map(|link| link.body.mass).sum()
    }

    /// The link whose bottom is the right sole.
    pub const RIGHT_FOOT: Joint = Joint::FootPitch;

    /// The link whose bottom is the sole on `side`.
    pub const fn foot(&self, side: Side) -> Joint {
        self.order.foot(side)
    }

    /// The six joints of a leg: from the ankle up for the right one, from the hip down for the left one.
    pub fn leg(&self, side: Side) -> [Joint; 6] {
        self.order.leg(side)
    }

    /// The joint whose link is the pelvis.
    pub const fn pelvis(&self) -> Joint {
        self.order.pelvis()
    }

    /// Whether a motor drives the joint: the robot has it.
    pub fn has(&self, joint: Joint) -> bool {
        self.links[joint].motor.is_some()
    }

    /// Position of the sole frame's origin (on the sole, under the ankle) in the frame of the foot link on `side` (m).
    pub fn sole_in_foot(&self, side: Side) -> Vector3<f64> {
        match side {
            Side::Right => Vector3::zeros(),
            // The left foot's frame is at its ankle joint, which is the mirror image of the right one.
            Side::Left => {
                let ankle = self.links[self.leg(Side::Right)[0]].origin;
                Vector3::new(0.0 - ankle.x, ankle.y, -ankle.z)
            }
        }
    }

    /// Distance between the middles of the feet of the robot standing straight (m).
    pub fn foot_distance(&self) -> f64 {
        let chain = Side::BOTH.into_iter().flat_map(|side| self.leg(side));
        chain.map(|joint| self.links[joint].origin.y).sum::<f64>() + self.sole_in_foot(Side::Left).y
    }
}

impl Link {
    /// Rotation of the link against its parent at a joint angle (rad): maps link coordinates to parent coordinates.
    pub fn rotation(&self, angle: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&self.axis, angle)
    }
}
