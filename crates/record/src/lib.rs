//! Recordings of runs: MCAP files (<https://mcap.dev>) that hold everything a run was.
//!
//! | topic | what | number |
//! |---|---|---|
//! | `/requests` | what operators asked, as it came over the wire | 1, 2, 3, … |
//! | `/replies` | the answers | its request's |
//! | `/setpoints` | what the plant was given | tick |
//! | `/measurements` | what the controller went by, in each of its ticks | tick |
//! | `/reports` | what observers were told | tick |
//! | `/ticks` | what the controller's loop did: [`TickMessage`] | tick |
//! | `/truth` | the simulated robot, every few ticks: [`TruthMessage`] | tick |
//!
//! A message's time is that of the run: its tick times the control period, so that both processes' messages share one
//! timeline; its *number* above is MCAP's `sequence`. Files that the run began with are attachments, byte for byte; how it
//! was started is metadata (see [`Origin`]).
//!
//! A message is stored as it lies in shared memory, little-endian, after four bytes that make it CDR, the serialisation of
//! ROS 2; its schema is a `.msg` text written from [`wire::Layout`]. So every bit of a number is kept, NaN included, the
//! layouts stand in one place, and PyPI's `mcap-ros2-support`, Foxglove and others read it without any of our code.
//!
//! Controller and plant each write a file of their own, in chunks of half a second; [`merge`] makes one of them. A file whose
//! writer was killed is read up to its last whole chunk.

mod error;
mod event;
mod merge;
mod message;
mod origin;
mod reader;
mod schema;
mod writer;

pub use error::RecordError;
pub use event::{Channel, Event};
pub use merge::merge;
pub use message::{Returned, TickMessage, TruthMessage};
pub use origin::{Note, Origin};
pub use reader::{Item, Recording, Stamped, files_of, origin_of};
pub use writer::RecordingWriter;

/// The file in a run's folder that holds all of it.
pub const RUN_FILE: &str = "run.mcap";
/// What the controller's process writes there.
pub const CONTROLLER_FILE: &str = "controller.mcap";
/// What the plant's process writes there.
pub const PLANT_FILE: &str = "plant.mcap";
