//! Pushes of the page that drives, on their way to the simulated plant. They have a thread of their own, since a plant
//! that does not answer must not hold up a command or a stop.

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::Duration;

use dialogue::push_text::push_text;
use interface::PushReply;
use scene::{AskedPush, ToPage};
use tokio::sync::broadcast;
use wire::{Instance, PushClient, PushError, PushRequestMessage};

/// How long a push may take to be answered.
const TIMEOUT: Duration = Duration::from_secs(2);

/// Asks the plant for pushes, and tells all pages what became of them.
pub(crate) struct Pusher {
    instance: Instance,
    answers: broadcast::Sender<Arc<str>>,
}

impl Pusher {
    pub(crate) fn new(instance: Instance, answers: broadcast::Sender<Arc<str>>) -> Self {
        Self { instance, answers }
    }

    /// Pushes the robot as it is asked for, until nobody can ask.
    pub(crate) fn run(self, pushes: &Receiver<AskedPush>) {
        for asked in pushes {
            let (verdict, text) = self.push(&asked);
            // Without any page nobody wants to know.
            let _ = self.answers.send(ToPage::Answer { verdict, text: &text }.text());
        }
    }

    /// Pushes the robot, and says what became of it.
    fn push(&self, asked: &AskedPush) -> (&'static str, String) {
        match self.ask(asked) {
            Err(error) => ("refused", error.to_string()),
            Ok(reply) => push_text(&asked.impulse, &reply),
        }
    }

    fn ask(&self, asked: &AskedPush) -> Result<PushReply, PushError> {
        let AskedPush { joint, impulse, lasts_s: duration } = *asked;
        let message = PushRequestMessage { link: joint.saturating_add(1), impulse, duration };
        let reply = PushClient::connect(&self.instance)?.ask(&message, TIMEOUT)?;
        // A plant of this protocol sends nothing else.
        reply.checked().map_err(|_| PushError::Dropped)
    }
}
