//! Client library: commands a controller that runs in another process.
//!
//! * [`command_stream`]: a stream of commands with a heartbeat, as from a joystick or a program.
//! * [`script`] and [`script_runner`]: requests with their times, read from JSON lines and sent ahead of time.
//! * [`reply_text`]: replies as text and as JSON.

pub mod command_stream;
pub mod error;
pub mod reply_text;
pub mod script;
pub mod script_runner;

pub use command_stream::CommandStream;
pub use error::OperatorError;
