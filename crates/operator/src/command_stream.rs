//! A stream of commands: sends requests when they are due, a heartbeat in between, and a release when it is closed.
//!
//! What a stream commands stays in effect only while its source is active (`controller::CommandArbiter`). A heartbeat
//! is an empty request: it keeps the source active and changes nothing, whatever others were granted meanwhile. Nor
//! does it start a walk: after a silence in which the robot has stopped, only a request to walk does. A stream whose
//! process is killed falls silent; one that is closed leaves its last commands in effect.

use std::time::Duration;

use interface::{COMMAND_TIMEOUT_MIN, Lifetime, Reply, Request, Source, Verdict};
use runtime::Rate;
use wire::{Instance, ObserverPorts, OperatorPorts, PendingReply};

use crate::OperatorError;
use crate::script::TimedRequest;

/// A stream of commands to a controller that runs in another process.
pub struct CommandStream {
    operator: OperatorPorts,
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
struct ControllerClock {
    observer: ObserverPorts,
    /// The controller's tick when the stream began.
    started_at: Option<u64>,
    now: u64,
}

/// How long the controller may take to reply: long enough to start its plant by hand.
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
        let clock = ControllerClock { observer, started_at: None, now: 0 };
        Ok(Self { operator, clock, timeout, source: Source::Script, last_sent: None, heartbeat: None, rate })
    }

    /// Reads the controller's clock and sends a heartbeat if it is time for one. Call it at least every few
    /// milliseconds.
    ///
    /// # Errors
    /// Shared memory failed, or the controller has gone.
    pub fn keep_alive(&mut self) -> Result<(), OperatorError> {
        self.clock.update()?;
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
        let due = self.clock.started_at? + timed.tick(self.rate);
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
        let request = Request { lifetime: Lifetime::Streamed, timeout: self.timeout(), ..*request };
        self.source = request.source;
        let reply = self.send(&request)?;
        if reply.verdict != Verdict::Refused {
            self.clock.update()?;
            self.last_sent = Some(self.clock.now);
        }
        Ok(reply)
    }

    /// Ends the stream: its last commands stay in effect. The controller may have gone before.
    ///
    /// # Errors
    /// The controller is there but does not reply.
    pub fn close(mut self) -> Result<(), OperatorError> {
        if self.last_sent.is_some() && self.is_connected() {
            self.send(&self.empty_request(Lifetime::Release))?;
        }
        Ok(())
    }

    fn send(&mut self, request: &Request) -> Result<Reply, OperatorError> {
        // Every request is a heartbeat, too.
        self.heartbeat = None;
        Ok(self.operator.requests.ask(&request.into(), REPLY_TIMEOUT)?.checked()?)
    }

    fn empty_request(&self, lifetime: Lifetime) -> Request {
        Request { lifetime, timeout: self.timeout(), ..Request::new(self.source) }
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
    fn update(&mut self) -> Result<(), OperatorError> {
        while let Some(report) = self.observer.reports.next_report()? {
            self.now = report.tick;
            self.started_at.get_or_insert(report.tick);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
