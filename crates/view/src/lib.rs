//! A page in a browser that shows the robot and drives it.
//!
//! [`ViewServer`] serves one page on an address of this computer. It shows a robot that is running, or recorded runs
//! ([`Shown`]). Either way the page gets the same frames ([`ViewFrame`](scene::ViewFrame)), each the state of one
//! instant; what it draws of them is in `tools/view`.
//!
//! * A running robot is observed through its reports and measurements: neither controller nor plant waits for a page.
//! * One page at a time drives. Its commands are a stream of the client library `operator`, and stay in effect while
//!   the page shows signs of life. Any page may stop the robot.
//! * A socket is opened only by a page of this server and with the token that it prints.

mod access;
mod error;
mod fall_watch;
mod floor_texts;
mod live_feed;
mod live_pages;
mod pusher;
mod recorded_requests;
mod recorded_run;
mod server;
mod socket;
mod teleoperation;

pub use error::ViewError;
pub use floor_texts::{FloorFile, FloorTexts};
pub use recorded_run::RecordedRun;
pub use server::{RunningRobot, Shown, ViewServer};
