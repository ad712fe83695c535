//! Client library: commands a controller that runs in another process.
//!
//! * [`command_stream`]: a stream of commands with a heartbeat, as from a joystick or a program.
//! * [`hand_drive`]: what a person asks for with keys, sticks or sliders.
//! * [`script_runner`]: the requests of a script, sent ahead of time.

pub mod command_stream;
pub mod error;
pub mod hand_drive;
pub mod script_runner;

pub use command_stream::CommandStream;
pub use error::OperatorError;
