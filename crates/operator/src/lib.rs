//! Client library: commands a controller that runs in another process.
//!
//! * [`command_stream`]: a stream of commands with a heartbeat, as from a joystick or a program.
//! * [`hand_drive`]: what a person asks for with keys, sticks or sliders.
//! * [`lines`] are read from any input, and those of a stream wait in a [`line_queue`] until they are sent.
//! * [`script`] and [`script_runner`]: requests with their times, read from JSON lines and sent ahead of time.
//! * [`place_json`]: way-points and footsteps as JSON.
//! * [`reply_text`]: replies as text and as JSON.

pub mod command_stream;
mod destination_text;
pub mod error;
pub mod hand_drive;
mod limit_unit;
pub mod line_queue;
pub mod lines;
pub mod place_json;
pub mod reply_text;
pub mod script;
pub mod script_runner;

pub use command_stream::CommandStream;
pub use error::OperatorError;
