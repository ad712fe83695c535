//! What the robot is: joints, links, mechanism, mirror, frames, sole, limits.
//!
//! Facts only, no motion generation. Angles are in radians, lengths in metres; degrees and joint numbers exist in text
//! only.

mod com_state;
pub mod frame;
mod joint;
mod joint_order;
mod leg_reach;
mod mechanism;
mod mechanism_file;
mod mirror;
mod motion;
mod per_joint;
mod servo;
mod side;
mod sole;
mod urdf_source;

pub use com_state::ComState;
pub use frame::{GRAVITY, Wrench};
pub use joint::Joint;
pub use joint_order::JointOrder;
pub use leg_reach::LegReach;
pub use mechanism::{Body, DcMotor, JointLimits, Link, Mechanism, Motor, TorqueSource};
pub use mirror::{Mirror, Mirrored, partner};
pub use motion::Motion;
pub use per_joint::{JointVector, PerJoint};
pub use servo::{Servo, Servos};
pub use side::Side;
pub use sole::Sole;
pub use urdf_source::{HeldJoint, UrdfJoint, UrdfSource};
