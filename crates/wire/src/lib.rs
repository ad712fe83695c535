//! What crosses the process boundary: messages in shared memory, the services that carry them, and the ports of each
//! process. Beside the benchmarks this is the only crate that names iceoryx2.
//!
//! The processes of a robot exchange messages by six services. Their names begin with `halfstep/<instance>/`, so that
//! several robots and tests can run at the same time:
//!
//! | service | from → to | message | pattern |
//! |---|---|---|---|
//! | `setpoint` | controller → plant | [`SetpointMessage`] | blackboard |
//! | `measurement` | plant → controller | [`MeasurementMessage`] | blackboard |
//! | `request` | operator → controller and back | [`RequestMessage`], [`ReplyMessage`] | request–response |
//! | `report` | controller → anyone | [`ReportMessage`] | publish–subscribe |
//! | `push` | anyone → simulated plant and back | [`PushRequestMessage`], [`PushReplyMessage`] | request–response |
//! | `true-pose` | simulated plant → anyone | [`TruePoseMessage`] | blackboard |
//!
//! A blackboard has one writer and up to 16 readers; only the latest message counts. The request service has one server
//! and up to 32 clients, each with up to 32 unanswered requests. The report service has one publisher and up to 16
//! subscribers; the 64 latest reports are kept for each.
//!
//! A stop has a way of its own beside the request service: [`UrgentClient`] sends it through a socket in the instance's
//! folder, which needs no place among the clients and no shared memory.
//!
//! # Terms
//!
//! * An **instance** ([`Instance`]) is one robot: a name, and the memory that its processes share.
//! * **Ports** are what a process connects with: [`ControllerPorts`] and [`PlantPorts`], of which an instance has one
//!   each, and several [`OperatorPorts`], which send requests, [`ObserverPorts`], which receive reports, and
//!   [`SpectatorPorts`], which receive measurements, too, and from a simulated plant its [`TruePoses`]. The ports of a
//!   process are public fields; each may be moved to another thread.
//! * The **tick** of a message is the writer's count of control periods. [`NEVER_WRITTEN`] marks a message that was
//!   never written; readers turn it into `None`. To find out whether a message is new, compare its tick with the last
//!   one for *inequality*: a restarted writer counts from 0 again. The last message of a writer that has disconnected
//!   stays until another one writes; the only sign is that its tick no longer changes.
//! * The **protocol** ([`PROTOCOL`]) is the version of all layouts and meanings; the **mechanism** is the fingerprint
//!   of the robot that joint numbers refer to; the **rate** is the number of control periods in a second, the unit of
//!   all ticks; the **clock** is what begins a period (`realtime` or `lockstep`); the **start** is the posture in which
//!   the robot begins (`stride` or `stand`). They are attributes of the services (keys `protocol`, `mechanism`,
//!   `rate_hz`, `clock` and `start`, numbers as decimal, `0x…` and decimal text). All processes compare the protocol.
//!   Controller and plant also compare the rate, and on `setpoint` and `measurement` mechanism and clock; as long as no
//!   controller has written a setpoint also the start. Observers can read the rate.
//!
//! # Connecting and disconnecting
//!
//! Controller and plant start in either order: the first one creates the setpoint and measurement services. Either may
//! be killed and restarted while the other keeps running. There is one writer of each kind: a second controller (or
//! plant) of an instance is refused. Operators and observers need a running controller.
//!
//! A writer that is killed leaves its slot on the blackboard occupied for ever. Therefore a blackboard has
//! [`WRITER_SLOTS`] slots: keys 0, 1, 2, … of type `u64`, each with one message. A writer takes the first free slot, a
//! reader reads the highest slot that was ever written. All slots are free again once both sides have disconnected.
//!
//! Files lie in `<runtime folder>/halfstep-<user id>/<instance>/` and `/dev/shm/halfstep.<hash>.<instance>.*`, where
//! the hash is that of the folder's path. The runtime folder is `$XDG_RUNTIME_DIR` or `/run/user/<user id>` if that
//! belongs to the user alone, else `/tmp`. A folder that others own or may enter is refused. Whoever leaves an instance
//! last removes its files ([`Instance::leftovers`]). A killed process leaves files: the next process of its instance
//! cleans up after it, and an instance without a process is removed by the next controller or plant of this user.
//! Processes connect one at a time, so that a process that is killed while connecting leaves no incomplete service for
//! others to wait for.
//!
//! A process makes sure that `/dev/shm` has room before it connects ([`ConnectError::NoRoom`]), and takes the memory of
//! all files at once: later no one can run out of it.
//!
//! # Costs
//!
//! Writing and reading setpoint and measurement neither allocates nor enters the kernel. Publishing a report, sending a
//! request and replying allocate; after a peer connects or disconnects, the next of these calls takes about 0.1 ms
//! longer. Do not call them in the control loop.

mod connect_lock;
mod error;
mod instance;
mod latest;
mod layout;
mod leftovers;
mod message;
mod ports;
mod push;
pub mod python;
mod report;
mod request;
mod running;
mod runtime_folder;
mod service_contract;
mod shared_memory;
mod urgent_socket;

pub use error::{ConnectError, Elsewhere, PushError, RequestError, TransportError};
pub use instance::{Instance, InstanceName};
pub use latest::{LatestReader, LatestWriter, WRITER_SLOTS};
#[doc(hidden)]
pub use layout::kind;
pub use layout::{Field, FieldValue, Layout, NumberType, WireLayout, layouts};
pub use leftovers::Leftovers;
pub use message::*;
pub use ports::{ControllerPorts, ObserverPorts, OperatorPorts, PlantPorts, SpectatorPorts, TruePoses};
pub use push::{PushClient, PushResponder, PushServer};
pub use report::{ReportPublisher, ReportSubscriber};
pub use request::{MAX_OPERATORS, MAX_UNANSWERED, PendingReply, RequestClient, RequestServer, Responder};
pub use running::{Participants, instances_in_use, running_instances};
pub use urgent_socket::UrgentClient;

/// Version of all layouts and meanings. Processes of different versions refuse to connect.
pub const PROTOCOL: u32 = 8;

/// Control rate of an instance unless [`Instance::with_rate_hz`] sets another one (Hz).
pub const DEFAULT_RATE_HZ: u32 = 1000;

/// The kind of iceoryx2 service: between processes, and movable between threads.
type Ipc = iceoryx2::prelude::ipc_threadsafe::Service;
