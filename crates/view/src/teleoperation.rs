//! Commands of the page that drives, on their way to the controller.
//!
//! A page's commands stay in effect while it lives: each sign of life becomes at most one heartbeat of the stream. A
//! page that is closed, hidden or cut off falls silent, and with it the stream: after its timeout the controller stops
//! the robot. Nothing here goes on in its place.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use dialogue::line_queue::{LineQueue, ReadLine};
use dialogue::reply_text::reply_text;
use dialogue::script::{Reader, TimedRequest};
use interface::{Intent, Reply, Request, Source};
use operator::command_stream::SentRequest;
use operator::{CommandStream, OperatorError};
use scene::ToPage;
use tokio::sync::broadcast;
use wire::{Instance, UrgentClient};

/// Time between two looks for a reply.
const POLL_INTERVAL: Duration = Duration::from_millis(5);
/// How long a stop may take to be answered.
const STOP_TIMEOUT: Duration = Duration::from_secs(2);

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
    instance: Instance,
    age_limit: Option<Duration>,
    answers: broadcast::Sender<Arc<str>>,
    reader: Reader,
    stream: Option<CommandStream>,
    /// Commands that wait for the reply to the one before, newest positions only.
    waiting: LineQueue,
    sent: Option<(Request, SentRequest)>,
}

impl Teleoperation {
    /// Of an instance, with commands that stay in effect for `age_limit` after the last sign of life; `None` is the
    /// controller's own limit.
    pub(crate) fn new(instance: Instance, age_limit: Option<Duration>, answers: broadcast::Sender<Arc<str>>) -> Self {
        let (reader, waiting) = (Reader::new("page"), LineQueue::default());
        Self { instance, age_limit, answers, reader, stream: None, waiting, sent: None }
    }

    /// Carries out orders until nobody can give any.
    pub(crate) fn run(mut self, orders: &Receiver<Order>) {
        loop {
            match orders.recv_timeout(POLL_INTERVAL) {
                Ok(order) => self.obey(order),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            if let Err(error) = self.exchange() {
                self.give_up(&error);
            }
        }
    }

    fn obey(&mut self, order: Order) {
        match order {
            Order::Handover => self.forget(),
            Order::Stop => self.stop(),
            Order::Line(line) => match self.reader.read(Ok(&line)) {
                None => {}
                Some(Err(error)) => self.answer("refused", &error.problem),
                Some(Ok(TimedRequest { request, .. })) => {
                    // A person drives by what is seen: at once, whatever time the command states.
                    let timed = TimedRequest { time: None, request: Request { source: Source::Teleop, ..request } };
                    self.waiting.push(ReadLine { number: self.reader.line(), timed, read_ns: 0 });
                }
            },
            Order::Beat => {
                if let Some(Err(error)) = self.stream.as_mut().map(CommandStream::keep_alive) {
                    self.give_up(&error);
                }
            }
        }
    }

    /// Sends the next command, if it is its turn, and takes replies.
    fn exchange(&mut self) -> Result<(), OperatorError> {
        if let (Some((request, sent)), Some(stream)) = (&self.sent, &mut self.stream)
            && let Some(reply) = stream.poll(sent)?
        {
            let request = *request;
            self.sent = None;
            self.tell(&request, &reply);
        }
        if let Some(line) = self.waiting.next_for_at_once(self.sent.is_some()) {
            let stream = match &mut self.stream {
                Some(stream) => stream,
                none => none.insert(CommandStream::connect(&self.instance, self.age_limit)?),
            };
            let request = line.timed.request;
            self.sent = Some((request, stream.send(&request)?));
        }
        Ok(())
    }

    /// Stops the robot on the way that nothing can block.
    fn stop(&mut self) {
        self.forget();
        let request = Request { intent: Some(Intent::Stop), ..Request::new(Source::Teleop) };
        let ask = || -> Result<Reply, OperatorError> {
            let urgent = UrgentClient::connect(&self.instance)?;
            Ok(urgent.stop(&(&request).into(), STOP_TIMEOUT)?.checked()?)
        };
        match ask() {
            Ok(reply) => self.tell(&request, &reply),
            Err(error) => self.answer("refused", &error.to_string()),
        }
    }

    /// Lets the stream fall silent.
    fn forget(&mut self) {
        self.waiting = LineQueue::default();
        (self.sent, self.stream) = (None, None);
    }

    fn give_up(&mut self, error: &OperatorError) {
        self.forget();
        self.answer("refused", &error.to_string());
    }

    fn tell(&self, request: &Request, reply: &Reply) {
        self.answer(reply.verdict.text(), &reply_text(request, reply));
    }

    fn answer(&self, verdict: &str, text: &str) {
        // Without any page nobody wants to know.
        let _ = self.answers.send(ToPage::Answer { verdict, text }.text());
    }
}
