//! Robots with everything that they need to walk, as the texts of a configuration folder: those in the box
//! ([`BuiltInRobot`]), and those that come as a URDF ([`ImportedRobot`]).

mod built_in_robot;
mod imported_robot;

pub use built_in_robot::{BuiltInRobot, ROBOTS};
pub use imported_robot::{ImportedRobot, ImportedRobotError, URDF};
