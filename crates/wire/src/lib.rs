//! What crosses the process boundary; the only crate that names iceoryx2.
//!
//! A robot walks by four services. Their names begin with `halfstep/<instance>/`, so that many robots and many tests
//! live side by side:
//!
//! | service | from → to | message | pattern | quality |
//! |---|---|---|---|---|
//! | `setpoint` | controller → plant | [`SetpointMessage`] | blackboard | one writer, 16 readers, newest wins |
//! | `measurement` | plant → controller | [`MeasurementMessage`] | blackboard | one writer, 16 readers, newest wins |
//! | `request` | operator → controller and back | [`RequestMessage`], [`ReplyMessage`] | request–response | one server, 8 clients, 256 requests of each unanswered at a time |
//! | `report` | controller → anyone | [`ReportMessage`] | publish–subscribe | one publisher, 16 subscribers, 64 reports kept for each, the oldest gives way |
//!
//! # Who is who
//!
//! * An **instance** ([`Instance`]) is one robot: a name, and the memory that its processes share.
//! * An **end** is what a process holds of an instance: [`ControllerEnd`] and [`PlantEnd`], of which there is one each,
//!   and any number of [`OperatorEnd`]s, who ask, and [`ObserverEnd`]s, who only look. An end's parts are public fields
//!   and may each be moved to another thread.
//! * The **tick** of a message is the writer's count of periods. [`NOTHING_YET`] stands where nothing was written, and
//!   readers turn it into `None`. A reader that wants to know whether a message is new compares its tick with the last
//!   one's, for *inequality*: a restarted writer counts from 0 again. The last message of a writer that has gone stays
//!   until another one writes; that its tick stands still is the only sign.
//! * The **protocol** ([`PROTOCOL`]) is the version of all layouts and meanings; the **mechanism** is the fingerprint of
//!   the robot that joint numbers refer to; the **rate** is the periods in a second, the unit of all ticks. They are
//!   attributes of the services (keys `protocol`, `mechanism` and `rate_hz`, as decimal, `0x…` and decimal text). All ends
//!   compare the protocol. Controller and plant also compare the rate, and the mechanism on `setpoint` and `measurement`,
//!   which are the services that carry joint numbers. Operators and observers are told the rate.
//!
//! # Coming and going
//!
//! Controller and plant start in either order: whoever comes first creates setpoint and measurement. Either may be
//! killed and started again while the other goes on. Each kind of writer exists once: the second controller (or plant)
//! of an instance is refused. Operators and observers need a controller that is there.
//!
//! A writer that dies without a goodbye leaves its place on the blackboard taken for ever, so that a blackboard has
//! [`NEWEST_SLOTS`] places: keys 0, 1, 2, … of type `u64`, each with one message. A writer takes the first free
//! one, a reader reads the highest one that was ever written. All of them are free again once both sides have gone.
//!
//! Files lie in `<temporary folder>/halfstep-<user id>/<instance>/` and `/dev/shm/halfstep.<instance>.*`, readable by
//! the user alone. A clean exit leaves a few bytes there, a kill more; the next start cleans up after the dead, and
//! [`Instance::remove_leftovers`] removes everything once nobody is there. Processes connect one at a time, so that one
//! that is killed while it connects leaves nothing half made that others would wait for.
//!
//! # Costs
//!
//! Writing and reading setpoint and measurement neither allocates nor enters the kernel. Publishing a report, answering
//! and asking allocate; a peer that comes or goes costs the next of these calls some 0.1 ms. Do them beside the loop.

mod agreement;
mod end;
mod error;
mod instance;
mod layout;
mod message;
mod newest;
mod report;
mod request;
mod turn;

pub use end::{ControllerEnd, ObserverEnd, OperatorEnd, PlantEnd};
pub use error::{AskError, ConnectError, WireFault};
pub use instance::{Instance, InstanceName, Leftovers};
#[doc(hidden)]
pub use layout::kind;
pub use layout::{Field, FieldValue, LaidOut, Layout, Number, layouts};
pub use message::*;
pub use newest::{NEWEST_SLOTS, NewestReader, NewestWriter};
pub use report::{ReportPublisher, ReportSubscriber};
pub use request::{Answer, RequestClient, RequestServer, Waiting};

/// The version of all layouts and meanings. Ends of different versions refuse to talk.
pub const PROTOCOL: u32 = 3;

/// Periods in a second, unless [`Instance::with_rate_hz`] says otherwise [Hz].
pub const RATE_HZ: u32 = 1000;

/// The kind of iceoryx2 ports: between processes, and movable between threads.
type Ipc = iceoryx2::prelude::ipc_threadsafe::Service;
