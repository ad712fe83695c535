//! What the robot is: joints, links, mechanism, mirror, frames, sole, limits.
//!
//! Facts only, no motion generation. Angles are in radians, lengths in metres; degrees and joint numbers exist in text
//! only.

mod body;
mod com_state;
pub mod frame;
mod held_joint;
mod joint;
mod joint_order;
mod leg_reach;
mod mechanism;
mod mechanism_file;
mod mirror;
mod motion;
mod motor;
mod per_joint;
mod servo;
mod side;
mod sole;
mod unlumped;
mod urdf_source;

pub use body::Body;
pub use com_state::ComState;
pub use frame::{GRAVITY, Wrench};
pub use held_joint::{HeldJoint, HeldLink};
pub use joint::Joint;
pub use joint_order::JointOrder;
pub use leg_reach::LegReach;
pub use mechanism::{JointLimits, Link, Mechanism};
pub use mirror::{Mirror, Mirrored, partner};
pub use motion::Motion;
pub use motor::{DcMotor, Motor, TorqueSource};
pub use per_joint::{JointVector, PerJoint};
pub use servo::{Servo, Servos};
pub use side::Side;
pub use sole::Sole;
pub use unlumped::UnlumpedMechanism;
pub use urdf_source::{UrdfJoint, UrdfSource};
