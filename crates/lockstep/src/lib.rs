//! Controller and plant that walk in one thread, to the bits of two processes in lockstep.
//!
//! A [`WalkableRobot`] is read from the texts of a configuration folder; a [`LockstepWalk`] is its walk, period by
//! period. There is no clock, no thread and no file: who calls says when the next period comes.

mod lockstep_walk;
mod walkable_robot;

pub use lockstep_walk::{LockstepOptions, LockstepWalk};
pub use walkable_robot::{WalkableRobot, WalkableRobotError};
