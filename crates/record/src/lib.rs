//! Recordings of runs: MCAP files (<https://mcap.dev>) with every message exchanged and the configuration of the run.
//!
//! | topic | message | number |
//! |---|---|---|
//! | `/requests` | the requests of operators, as received | 1, 2, 3, … |
//! | `/replies` | the replies to them | that of its request |
//! | `/setpoints` | the setpoints sent to the plant | tick |
//! | `/measurements` | the measurement that the controller used in each of its ticks | tick |
//! | `/reports` | the reports published to observers | tick |
//! | `/ticks` | the inputs of each tick of the controller beside the measurement: [`TickMessage`] | tick |
//! | `/truth` | the true state of the simulated robot, every few ticks: [`TruthMessage`] | tick |
//! | `/pushes` | pushes on the simulated robot that were asked for while it ran: [`PushMessage`] | tick |
//!
//! The time of a message is that of the run: its tick times the control period, so that the messages of both processes
//! share one timeline. Its *number* above is MCAP's `sequence`. The configuration files of the run are attachments,
//! byte for byte; how it was started is metadata (see [`Provenance`]).
//!
//! A message is stored as in shared memory, little-endian, after four bytes that make it CDR, the serialisation of ROS
//! 2. Its schema is a `.msg` text generated from [`wire::Layout`]. So every bit of a number is kept, NaN included, the
//! layouts are defined in one place, and PyPI's `mcap-ros2-support`, Foxglove and others can read a recording without
//! our code.
//!
//! Controller and plant each write a file of their own, in chunks of half a second; [`merge()`] joins them. A file
//! whose writer was killed can be read up to its last complete chunk.

mod error;
mod merge;
mod message;
mod new_file;
mod older_files;
mod older_layout;
mod provenance;
mod reader;
mod record_stream;
mod run_event;
mod schema;
mod writer;

pub use error::RecordError;
pub use merge::merge;
pub use message::{PushMessage, TickMessage, TruthMessage};
pub use new_file::{set_aside, set_folder_aside};
pub use provenance::{Metadata, Provenance};
pub use reader::{Item, Recording, TimedEvent, files_of, provenance_of};
pub use run_event::{Channel, RunEvent};
pub use writer::RecordingWriter;

/// Name of the file in the folder of a run that holds the whole recording.
pub const RUN_FILE: &str = "run.mcap";
/// Name of the file that the controller's process writes in the folder of a run.
pub const CONTROLLER_FILE: &str = "controller.mcap";
/// Name of the file that the plant's process writes in the folder of a run.
pub const PLANT_FILE: &str = "plant.mcap";
