//! Checks a robot's configuration one thing after the other, and names the first thing that is wrong with the key to
//! turn.
//!
//! * What can be computed comes first: [`body`], [`drives`], [`sensors`], [`half_step`].
//! * Then the robot is simulated in lockstep, from a stand to pushes: [`trial`].
//! * A trial that fails is repeated with one setting at a time as it usually is ([`settings`]): what mends it is named
//!   ([`diagnosis`]). So a cause is not guessed from what one sees.

pub mod body;
pub mod diagnosis;
pub mod drives;
pub mod examination;
pub mod examined_robot;
pub mod finding;
pub mod half_step;
pub mod sensors;
pub mod settings;
pub mod trial;

pub use examination::examine;
pub use examined_robot::{ExaminedRobot, RobotSetup};
pub use finding::{Finding, Remedy};
