//! Driving by hand, with keys, sticks or sliders: what a person asks for now, and what became of it.
//!
//! What is asked for stays in effect while its device lives: each sign of life becomes at most one heartbeat of the
//! stream. A device that is closed or cut off falls silent, and with it the stream: after its timeout the controller
//! stops the robot. Nothing here goes on in its place.

use std::time::Duration;

use dialogue::line_queue::{LineQueue, ReadLine};
use dialogue::reply_text::reply_text;
use dialogue::script::TimedRequest;
use interface::{Intent, Reply, Request, Source, Verdict};
use wire::{Instance, UrgentClient};

use crate::command_stream::SentRequest;
use crate::{CommandStream, OperatorError};

/// How long a stop may take to be answered.
const STOP_TIMEOUT: Duration = Duration::from_secs(2);

/// Sends what a person asks for, the newest only, as the source `teleop`.
pub struct HandDrive {
    instance: Instance,
    age_limit: Option<Duration>,
    stream: Option<CommandStream>,
    /// Requests that wait for the reply to the one before, newest positions only.
    waiting: LineQueue,
    sent: Option<(Request, SentRequest)>,
    asked: u64,
}

/// What became of something that was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DriveAnswer {
    /// Whether it was granted. What could not be asked at all was refused.
    pub verdict: Verdict,
    /// In words.
    pub text: String,
}

impl HandDrive {
    /// Of an instance, with requests that stay in effect for `age_limit` after the last sign of life; `None` is the
    /// controller's own limit. Connects when something is asked for.
    pub fn new(instance: Instance, age_limit: Option<Duration>) -> Self {
        Self { instance, age_limit, stream: None, waiting: LineQueue::default(), sent: None, asked: 0 }
    }

    /// Asks for something: at once, as soon as the request before is answered. What it overrides is not sent any more.
    pub fn ask(&mut self, request: Request) {
        self.asked += 1;
        let timed = TimedRequest { time: None, request: Request { source: Source::Teleop, ..request } };
        self.waiting.push(ReadLine { number: self.asked, timed, read_ns: 0 });
    }

    /// The device is alive. Gives what went wrong, if it cannot be passed on.
    pub fn beat(&mut self) -> Option<DriveAnswer> {
        let alive = self.stream.as_mut().map_or(Ok(()), CommandStream::keep_alive);
        alive.err().map(|error| self.give_up(&error))
    }

    /// Sends what is next, if it is its turn, and gives the answer that has arrived. To be called every few
    /// milliseconds.
    pub fn exchange(&mut self) -> Option<DriveAnswer> {
        self.send_and_receive().unwrap_or_else(|error| Some(self.give_up(&error)))
    }

    fn send_and_receive(&mut self) -> Result<Option<DriveAnswer>, OperatorError> {
        let mut answer = None;
        if let (Some((request, sent)), Some(stream)) = (&self.sent, &mut self.stream)
            && let Some(reply) = stream.poll(sent)?
        {
            answer = Some(DriveAnswer::of(request, &reply));
            self.sent = None;
        }
        if let Some(line) = self.waiting.next_for_at_once(self.sent.is_some()) {
            let stream = match &mut self.stream {
                Some(stream) => stream,
                none => none.insert(CommandStream::connect(&self.instance, self.age_limit)?),
            };
            let request = line.timed.request;
            self.sent = Some((request, stream.send(&request)?));
        }
        Ok(answer)
    }

    /// Stops the robot on the way that nothing can block, and lets go.
    pub fn stop(&mut self) -> DriveAnswer {
        self.let_go();
        let request = Request { intent: Some(Intent::Stop), ..Request::new(Source::Teleop) };
        let ask = || -> Result<Reply, OperatorError> {
            let urgent = UrgentClient::connect(&self.instance)?;
            Ok(urgent.stop(&(&request).into(), STOP_TIMEOUT)?.checked()?)
        };
        ask().map_or_else(|error| DriveAnswer::refused(&error.to_string()), |reply| DriveAnswer::of(&request, &reply))
    }

    /// Lets the stream fall silent.
    pub fn let_go(&mut self) {
        self.waiting = LineQueue::default();
        (self.sent, self.stream) = (None, None);
    }

    fn give_up(&mut self, error: &OperatorError) -> DriveAnswer {
        self.let_go();
        DriveAnswer::refused(&error.to_string())
    }
}

impl DriveAnswer {
    /// Nothing was asked, because of a problem.
    pub fn refused(problem: &str) -> Self {
        Self { verdict: Verdict::Refused, text: problem.to_owned() }
    }

    fn of(request: &Request, reply: &Reply) -> Self {
        Self { verdict: reply.verdict, text: reply_text(request, reply) }
    }
}
