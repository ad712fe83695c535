//! What people write to a controller, and what they read from it.
//!
//! * [`lines`] are read from any input, and those of a stream wait in a [`line_queue`] until they are sent.
//! * [`script`]: requests with their times, read from JSON lines.
//! * [`place_json`]: way-points and footsteps as JSON.
//! * [`reply_text`]: replies as text and as JSON.
//! * [`push_text`]: pushes as text.

mod destination_text;
mod limit_unit;
pub mod line_queue;
pub mod lines;
pub mod place_json;
pub mod push_text;
pub mod reply_text;
pub mod script;
