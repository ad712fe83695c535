//! A stream of commands: sends requests when they are due, a heartbeat in between, and a release when it is closed.
//!
//! What a stream commands stays in effect only while its source is active (`controller::CommandArbiter`). A heartbeat
//! is an empty request: it keeps the source active and changes nothing, whatever others were granted meanwhile. Nor
//! does it start a walk: after a silence in which the robot has stopped, only a request to walk does. A stream whose
//! process is killed falls silent; one that is closed leaves its last commands in effect.

use std::time::Duration;

use interface::{COMMAND_TIMEOUT_MIN, Lifetime, Rate, Reply, Request, Source, Verdict};
use runtime::now_ns;
use wire::{Instance, ObserverPorts, OperatorPorts, PendingReply, RequestError};

use crate::OperatorError;
use dialogue::script::TimedRequest;

/// A stream of commands to a controller that runs in another process.
pub struct CommandStream {
    operator: OperatorPorts,
    observer: ObserverPorts,
    clock: ControllerClock,
    timeout: Option<Duration>,
    /// The source of the stream's requests, and so of its heartbeats.
    source: Source,
    /// The controller's tick when the stream last sent something; `None` before anything was granted, so that a stream
    /// without commands holds no authority.
    last_sent: Option<u64>,
    /// The last heartbeat, until it is answered.
    heartbeat: Option<PendingReply>,
    rate: Rate,
}

/// The controller's time as its reports give it: it may run faster or slower than the wall clock.
#[derive(Debug, Default)]
struct ControllerClock {
    /// The controller's tick from which times are counted: that of the first report since it started.
    started_at: Option<u64>,
    /// Ticks of the stream before the controller was restarted.
    before: u64,
    now: u64,
}

/// A request that was sent and has no reply yet. Dropping it cancels the request.
#[derive(Debug)]
pub struct SentRequest {
    pending: PendingReply,
    sent_ns: u64,
}

/// How long the controller may take to reply, and to begin with a request before it expires: long enough to start its
/// plant by hand.
const REPLY_TIMEOUT: Duration = Duration::from_secs(10);
/// How long before it is due a request is sent: late enough that closing the stream ends its influence.
const LEAD: Duration = Duration::from_millis(20);
/// Heartbeats within the timeout, so that one may be late.
const HEARTBEATS_PER_TIMEOUT: u32 = 3;

impl CommandStream {
    /// Connects to an instance's controller. Without a timeout the controller's own applies.
    ///
    /// # Errors
    /// There is no controller.
    pub fn connect(instance: &Instance, timeout: Option<Duration>) -> Result<Self, OperatorError> {
        let operator = OperatorPorts::connect(instance)?;
        let observer = ObserverPorts::connect(instance)?;
        let rate = Rate::clamped(observer.reports.rate_hz());
        let clock = ControllerClock::default();
        Ok(Self { operator, observer, clock, timeout, source: Source::Script, last_sent: None, heartbeat: None, rate })
    }

    /// Reads the controller's clock and sends a heartbeat if it is time for one. Call it at least every few
    /// milliseconds.
    ///
    /// # Errors
    /// Shared memory failed, or the controller has gone.
    pub fn keep_alive(&mut self) -> Result<(), OperatorError> {
        self.update_clock()?;
        if self.heartbeat.as_ref().is_some_and(|heartbeat| !matches!(heartbeat.poll(), Ok(None))) {
            self.heartbeat = None;
        }
        // The controller may have been restarted, and count from 0.
        let is_silent = self.last_sent.is_some_and(|sent| self.clock.now.abs_diff(sent) >= self.heartbeat_ticks());
        if is_silent && self.heartbeat.is_none() {
            let empty = self.empty_request(Lifetime::Streamed);
            self.heartbeat = Some(self.operator.requests.send(&(&empty).into())?);
            self.last_sent = Some(self.clock.now);
        }
        Ok(())
    }

    /// The tick at which a request is due, if it is time to send it.
    pub fn due(&self, timed: &TimedRequest) -> Option<u64> {
        if timed.time.is_none() {
            return Some(0);
        }
        let due = self.clock.tick_after(timed.tick(self.rate))?;
        is_to_be_sent(self.clock.now, due, self.rate).then_some(due)
    }

    /// Whether the controller is still there.
    pub fn is_connected(&self) -> bool {
        self.operator.requests.controller_is_there()
    }

    /// Sends a request, which stays in effect while the stream is active, and waits for the reply.
    ///
    /// # Errors
    /// The controller does not reply, or its reply is invalid.
    pub fn request(&mut self, request: &Request) -> Result<Reply, OperatorError> {
        let request = self.streamed(request);
        let reply = self.ask(&request)?;
        self.note(&reply)?;
        Ok(reply)
    }

    /// Sends a request, which stays in effect while the stream is active. [`poll`](Self::poll) gives the reply.
    ///
    /// # Errors
    /// There is no controller, or too many requests have no reply.
    pub fn send(&mut self, request: &Request) -> Result<SentRequest, OperatorError> {
        let request = self.streamed(request);
        // Every request is a heartbeat, too.
        self.heartbeat = None;
        let pending = self.operator.requests.send(&(&request).into())?;
        Ok(SentRequest { pending, sent_ns: now_ns() })
    }

    /// The reply to a request, if it has arrived.
    ///
    /// # Errors
    /// The controller does not reply in time, has gone, or its reply is invalid.
    pub fn poll(&mut self, sent: &SentRequest) -> Result<Option<Reply>, OperatorError> {
        let age = Duration::from_nanos(now_ns().saturating_sub(sent.sent_ns));
        let reply = match sent.pending.poll()? {
            Some(reply) => reply.checked()?,
            None if age < REPLY_TIMEOUT => return Ok(None),
            None => return Err(RequestError::TimedOut { seconds: REPLY_TIMEOUT.as_secs_f64().to_string() }.into()),
        };
        self.note(&reply)?;
        Ok(Some(reply))
    }

    /// A request of this stream, which expires when nobody waits for the reply any more.
    fn streamed(&mut self, request: &Request) -> Request {
        self.source = request.source;
        let expires_ns = Some(now_ns() + REPLY_TIMEOUT.as_nanos() as u64);
        Request { lifetime: Lifetime::Streamed, timeout: self.timeout(), expires_ns, ..*request }
    }

    /// Notes that a reply has arrived.
    fn note(&mut self, reply: &Reply) -> Result<(), OperatorError> {
        if reply.verdict != Verdict::Refused {
            self.update_clock()?;
            self.last_sent = Some(self.clock.now);
        }
        Ok(())
    }

    /// Ends the stream: its last commands stay in effect. The controller may have gone before.
    ///
    /// # Errors
    /// The controller is there but does not reply.
    pub fn close(mut self) -> Result<(), OperatorError> {
        if self.last_sent.is_some() && self.is_connected() {
            self.ask(&self.empty_request(Lifetime::Release))?;
        }
        Ok(())
    }

    fn ask(&mut self, request: &Request) -> Result<Reply, OperatorError> {
        // Every request is a heartbeat, too.
        self.heartbeat = None;
        Ok(self.operator.requests.ask(&request.into(), REPLY_TIMEOUT)?.checked()?)
    }

    fn empty_request(&self, lifetime: Lifetime) -> Request {
        Request { lifetime, timeout: self.timeout(), ..Request::new(self.source) }
    }

    fn update_clock(&mut self) -> Result<(), OperatorError> {
        while let Some(report) = self.observer.reports.next_report()? {
            self.clock.pass(report.tick);
        }
        Ok(())
    }

    fn timeout(&self) -> Option<f64> {
        self.timeout.map(|timeout| timeout.as_secs_f64())
    }

    /// Time between two heartbeats (ticks).
    fn heartbeat_ticks(&self) -> u64 {
        // The controller's own limit is not known here, but it is no shorter than this.
        heartbeat_ticks(self.timeout.unwrap_or(Duration::from_secs_f64(COMMAND_TIMEOUT_MIN)), self.rate)
    }
}

/// Whether at tick `now` it is time to send a request that is due at tick `due`.
fn is_to_be_sent(now: u64, due: u64, rate: Rate) -> bool {
    now + rate.ticks(LEAD) >= due
}

/// Time between two heartbeats of a stream that must not be silent for longer than `timeout` (ticks).
fn heartbeat_ticks(timeout: Duration, rate: Rate) -> u64 {
    (timeout.div_duration_f64(rate.period() * HEARTBEATS_PER_TIMEOUT) as u64).max(1)
}

impl ControllerClock {
    /// The controller's tick so many ticks after the stream began, if it has reported yet.
    fn tick_after(&self, ticks: u64) -> Option<u64> {
        Some(self.started_at? + ticks.saturating_sub(self.before))
    }

    /// Takes note of the controller's newest tick.
    fn pass(&mut self, tick: u64) {
        if let Some(started_at) = self.started_at.filter(|_| tick < self.now) {
            // The controller was restarted, and counts from 0; the stream's time goes on.
            self.before += self.now - started_at;
            self.started_at = Some(tick);
        }
        self.now = tick;
        self.started_at.get_or_insert(tick);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_a_stream_goes_on_when_the_controller_is_restarted() {
        let mut clock = ControllerClock::default();
        assert_eq!(clock.tick_after(5), None, "nothing is known yet");
        [5000, 5001, 7000].into_iter().for_each(|tick| clock.pass(tick));
        assert_eq!(clock.tick_after(3000), Some(8000));
        [0, 1, 500].into_iter().for_each(|tick| clock.pass(tick));
        assert_eq!(clock.tick_after(3000), Some(1000), "2000 of the 3000 had passed before");
        assert_eq!(clock.tick_after(1000), Some(0), "that is over");
    }

    #[test]
    fn requests_are_sent_twenty_milliseconds_early_at_any_rate() {
        for (hz, lead) in [(250, 5), (1000, 20), (4000, 80)] {
            let rate = Rate::new(hz).expect("a rate that loops can keep");
            assert!(is_to_be_sent(100, 100 + lead, rate) && !is_to_be_sent(100, 101 + lead, rate), "{rate}");
        }
    }

    #[test]
    fn heartbeats_come_three_times_within_the_timeout_at_any_rate() {
        for (hz, ticks) in [(250, 25), (1000, 100), (4000, 400)] {
            let rate = Rate::new(hz).expect("a rate that loops can keep");
            assert_eq!(heartbeat_ticks(Duration::from_millis(300), rate), ticks, "{rate}");
        }
    }
}
