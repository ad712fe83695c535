//! The mechanism: a tree of links, one per joint, standing on its right foot.
//!
//! At zero angles the robot stands straight and every link frame is parallel to the world's. A link's frame has its
//! origin on the joint that carries the link.

use nalgebra::{Rotation3, Unit, Vector3};

use crate::{Body, Joint, JointOrder, Motor, PerJoint, Servos, Side, Sole, UrdfSource};

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
