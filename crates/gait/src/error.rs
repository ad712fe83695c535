//! Why a walk cannot begin.

use model::{Joint, Side};
use nalgebra::Vector3;

use crate::{Quantity, TableError};

/// Why a walk cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WalkError {
    /// The table is not a half-step.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The table was made for another robot.
    #[error("the nominal half-step was made for mechanism {table:016x}, but the mechanism is {mechanism:016x}")]
    OtherMechanism {
        /// Fingerprint of the mechanism for which the table was made.
        table: u64,
        /// Fingerprint of the mechanism.
        mechanism: u64,
    },
    /// The mechanism is not left–right symmetric.
    #[error("the mechanism is not left–right symmetric: each joint's axis must be along or across y as its partner's")]
    NoMirror,
    /// A hip yaw joint does not rotate about z, as turning needs.
    #[error(
        "joint {} ({}) turns about {:?}: it must be z, since turning is a yaw of the hips",
        joint.number(), joint.name(), axis.as_slice()
    )]
    HipYawNotVertical {
        /// The joint that should rotate about z.
        joint: Joint,
        /// Axis of that joint.
        axis: Vector3<f64>,
    },
    /// A hip pitch joint does not rotate about y, as step extension needs.
    #[error(
        "joint {} ({}) turns about {:?}: it must be y, since step extension is a pitch of the hips",
        joint.number(), joint.name(), axis.as_slice()
    )]
    HipPitchNotLateral {
        /// The joint that should rotate about y.
        joint: Joint,
        /// Axis of that joint.
        axis: Vector3<f64>,
    },
    /// Neither joint of an ankle rotates about y, as step extension needs.
    #[error(
        "neither joint {} nor joint {} of the {side:?} ankle turns about y: step extension cannot keep the sole level",
        ankle[0].number(), ankle[1].number()
    )]
    NoAnklePitch {
        /// Side of the ankle.
        side: Side,
        /// The two joints of the ankle.
        ankle: [Joint; 2],
    },
    /// A hip roll joint does not rotate about x, as sidestepping needs.
    #[error(
        "joint {} ({}) turns about {:?}: it must be x, since sidestepping is a roll of the hips",
        joint.number(), joint.name(), axis.as_slice()
    )]
    HipRollNotForward {
        /// The joint that should rotate about x.
        joint: Joint,
        /// Axis of that joint.
        axis: Vector3<f64>,
    },
    /// Neither joint of an ankle rotates about x, as sidestepping needs.
    #[error(
        "neither joint {} nor joint {} of the {side:?} ankle turns about x: sidestepping cannot keep the sole level",
        ankle[0].number(), ankle[1].number()
    )]
    NoAnkleRoll {
        /// Side of the ankle.
        side: Side,
        /// The two joints of the ankle.
        ankle: [Joint; 2],
    },
    /// The range of granted commands does not include the nominal walk.
    #[error(
        "the limits of {quantity} are {min} to {max}: they must be finite and include the nominal walk's \
         {nominal}, and speed must stay above 0"
    )]
    LimitsWithoutNominal {
        /// The gait parameter whose range is wrong.
        quantity: Quantity,
        /// Least granted value (rad, -).
        min: f64,
        /// Greatest granted value (rad, -).
        max: f64,
        /// Value of the nominal walk (rad, -).
        nominal: f64,
    },
    /// The first command is outside the limits.
    #[error("the walk cannot begin with {quantity} {value}: it must be at most {max} and at least {min}")]
    StartOutsideLimits {
        /// The gait parameter that is outside its range.
        quantity: Quantity,
        /// Value to begin with (rad, -).
        value: f64,
        /// Least possible value (rad, -).
        min: f64,
        /// Greatest possible value (rad, -).
        max: f64,
    },
}
