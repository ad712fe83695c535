//! Controller and plant as processes.
//!
//! * The loops are in [`controller_loop`] and [`plant_loop`]; [`cycle`] decides when they run.
//! * Beside the controller's loop, threads do what allocates or takes long: [`request_bridge`] for operators,
//!   [`admission_worker`] for requests that must be simulated ahead, [`recorder`] for recordings and observers.
//! * [`replay`] runs a controller on recorded inputs, and compares the setpoints.
//! * [`announcements`] of the controller's modes and faults go to stderr through [`tell`].
//! * [`configuration`] and [`realtime`] read what a process needs; [`engine`] runs another program's physics.

pub mod admission_worker;
pub mod announcements;
pub mod configuration;
pub mod controller_loop;
pub mod cycle;
pub mod engine;
pub mod entry;
pub mod error;
pub mod interrupt;
mod nominal_check;
mod overload;
mod phase;
pub mod physics;
pub mod plant_loop;
pub mod push_bridge;
pub mod realtime;
pub mod recorder;
pub mod replay;
pub mod request_bridge;
pub mod request_queue;
pub mod summary;
pub mod tell;
pub mod timing;
mod valid_request;

pub use error::NodeError;
