//! Between the crates that do not know each other: what one says, in the words of another. One message per file.

pub mod measurement;
pub mod reply;
pub mod report;
pub mod request;
pub mod row;
pub mod setpoint;
pub mod source;
pub mod tick;
pub mod truth;
