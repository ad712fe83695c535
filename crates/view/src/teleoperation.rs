//! Commands of the page that drives, on their way to the controller.
//!
//! A page's commands stay in effect while it lives. A page that is closed, hidden or cut off falls silent, and with it
//! the stream: after its timeout the controller stops the robot. Nothing here goes on in its place.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use dialogue::script::{Reader, TimedRequest};
use operator::hand_drive::{DriveAnswer, HandDrive};
use scene::ToPage;
use tokio::sync::broadcast;
use wire::Instance;

/// Time between two looks for a reply.
const POLL_INTERVAL: Duration = Duration::from_millis(5);

/// An order of a page.
#[derive(Debug)]
pub(crate) enum Order {
    /// A page has begun to drive, or the one that drove has ended.
    Handover,
    /// A command, as a line of `halfstep stream` has it.
    Line(String),
    /// The page that drives is alive.
    Beat,
    /// Stop the robot.
    Stop,
}

/// Carries out the orders of pages, and tells all pages what became of them.
pub(crate) struct Teleoperation {
    drive: HandDrive,
    answers: broadcast::Sender<Arc<str>>,
    reader: Reader,
}

impl Teleoperation {
    /// Of an instance, with commands that stay in effect for `age_limit` after the last sign of life; `None` is the
    /// controller's own limit.
    pub(crate) fn new(instance: Instance, age_limit: Option<Duration>, answers: broadcast::Sender<Arc<str>>) -> Self {
        Self { drive: HandDrive::new(instance, age_limit), answers, reader: Reader::new("page") }
    }

    /// Carries out orders until nobody can give any.
    pub(crate) fn run(mut self, orders: &Receiver<Order>) {
        loop {
            let answer = match orders.recv_timeout(POLL_INTERVAL) {
                Ok(order) => self.obey(order),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => return,
            };
            for DriveAnswer { verdict, text } in answer.into_iter().chain(self.drive.exchange()) {
                // Without any page nobody wants to know.
                let _ = self.answers.send(ToPage::Answer { verdict: verdict.text(), text: &text }.text());
            }
        }
    }

    fn obey(&mut self, order: Order) -> Option<DriveAnswer> {
        match order {
            Order::Handover => self.drive.let_go(),
            Order::Stop => return Some(self.drive.stop()),
            Order::Line(line) => match self.reader.read(Ok(&line)) {
                None => {}
                Some(Err(error)) => return Some(DriveAnswer::refused(&error.problem)),
                // A person drives by what is seen: at once, whatever time the command states.
                Some(Ok(TimedRequest { request, .. })) => self.drive.ask(request),
            },
            Order::Beat => return self.drive.beat(),
        }
        None
    }
}
