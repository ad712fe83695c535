//! The twenty joints by name. Numbers 1 to 20 are the paper's and appear in text only.

use serde::{Deserialize, Serialize};

/// One degree of freedom, named for what it does under the agreed axes (`config/mechanism.toml`).
///
/// The tree stands on its **right** foot: each joint carries the link that follows it on the way from the ground up the
/// right leg, through the pelvis, and out along the left leg, the trunk and the arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[repr(u8)]
#[allow(missing_docs)]
pub enum Joint {
    /// Unpowered: the support sole tipping sideways on the ground.
    FootRoll,
    /// Unpowered: the support sole tipping over heel or toe. Carries the right foot.
    FootPitch,
    RightAnkleRoll,
    /// Carries the right shank.
    RightAnklePitch,
    /// Carries the right thigh.
    RightKnee,
    RightHipPitch,
    RightHipYaw,
    /// Carries the pelvis.
    RightHipRoll,
    LeftHipRoll,
    LeftHipYaw,
    /// Carries the left thigh.
    LeftHipPitch,
    /// Carries the left shank.
    LeftKnee,
    LeftAnklePitch,
    /// Carries the left foot.
    LeftAnkleRoll,
    WaistPitch,
    /// Carries the trunk and head.
    WaistRoll,
    /// Carries the right upper arm.
    RightShoulder,
    /// Carries the right forearm and hand.
    RightElbow,
    /// Carries the left upper arm.
    LeftShoulder,
    /// Carries the left forearm and hand.
    LeftElbow,
}

impl Joint {
    /// Number of joints.
    pub const COUNT: usize = 20;

    /// All joints in the paper's order; parents come before their children.
    pub const ALL: [Joint; Joint::COUNT] = {
        use Joint::*;
        [
            FootRoll,
            FootPitch,
            RightAnkleRoll,
            RightAnklePitch,
            RightKnee,
            RightHipPitch,
            RightHipYaw,
            RightHipRoll,
            LeftHipRoll,
            LeftHipYaw,
            LeftHipPitch,
            LeftKnee,
            LeftAnklePitch,
            LeftAnkleRoll,
            WaistPitch,
            WaistRoll,
            RightShoulder,
            RightElbow,
            LeftShoulder,
            LeftElbow,
        ]
    };

    /// The first joint with a motor; the two before it are the contact of foot and ground.
    pub const FIRST_POWERED: Joint = Joint::RightAnkleRoll;

    /// The paper's number, 1 to 20. For people: logs, plots, CSV headers.
    pub const fn number(self) -> u8 {
        self as u8 + 1
    }

    /// The joint with the paper's number, 1 to 20.
    pub fn from_number(number: u8) -> Option<Joint> {
        Joint::ALL.get(usize::from(number).checked_sub(1)?).copied()
    }

    /// The position in a [`PerJoint`](crate::PerJoint), 0 to 19. For arrays only.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The joint's name as it is written in files: `right_ankle_roll`.
    pub const fn name(self) -> &'static str {
        use Joint::*;
        match self {
            FootRoll => "foot_roll",
            FootPitch => "foot_pitch",
            RightAnkleRoll => "right_ankle_roll",
            RightAnklePitch => "right_ankle_pitch",
            RightKnee => "right_knee",
            RightHipPitch => "right_hip_pitch",
            RightHipYaw => "right_hip_yaw",
            RightHipRoll => "right_hip_roll",
            LeftHipRoll => "left_hip_roll",
            LeftHipYaw => "left_hip_yaw",
            LeftHipPitch => "left_hip_pitch",
            LeftKnee => "left_knee",
            LeftAnklePitch => "left_ankle_pitch",
            LeftAnkleRoll => "left_ankle_roll",
            WaistPitch => "waist_pitch",
            WaistRoll => "waist_roll",
            RightShoulder => "right_shoulder",
            RightElbow => "right_elbow",
            LeftShoulder => "left_shoulder",
            LeftElbow => "left_elbow",
        }
    }

    /// The name of the link that the joint carries: `right_shank`. `None` where joints meet in one point, with nothing
    /// but the next joint between them.
    pub const fn link_name(self) -> Option<&'static str> {
        use Joint::*;
        Some(match self {
            FootPitch => "right_foot",
            RightAnklePitch => "right_shank",
            RightKnee => "right_thigh",
            RightHipRoll => "pelvis",
            LeftHipPitch => "left_thigh",
            LeftKnee => "left_shank",
            LeftAnkleRoll => "left_foot",
            WaistRoll => "trunk",
            RightShoulder => "right_upper_arm",
            RightElbow => "right_forearm",
            LeftShoulder => "left_upper_arm",
            LeftElbow => "left_forearm",
            _ => return None,
        })
    }

    /// The joint named `name` in files.
    pub fn from_name(name: &str) -> Option<Joint> {
        Joint::ALL.into_iter().find(|joint| joint.name() == name)
    }

    /// Whether a motor drives the joint.
    pub const fn is_powered(self) -> bool {
        self as u8 >= Joint::FIRST_POWERED as u8
    }

    /// Whether it moves a part of an arm.
    pub const fn is_in_arm(self) -> bool {
        use Joint::*;
        matches!(self, RightShoulder | RightElbow | LeftShoulder | LeftElbow)
    }

    /// Whether the joint belongs to the chain from one foot over the pelvis to the other, whose order the mirror
    /// reverses.
    pub const fn is_in_leg(self) -> bool {
        self as u8 >= Joint::RightAnkleRoll as u8 && self as u8 <= Joint::LeftAnkleRoll as u8
    }
}

const _: () = assert!(Joint::RightHipYaw.number() == 7);
const _: () = assert!(Joint::LeftElbow.number() == 20);
