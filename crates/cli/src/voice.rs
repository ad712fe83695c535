//! The voice of a stream: asks when it is time, gives signs of life in between, and takes its leave.
//!
//! What a stream asks lasts only while its source speaks (`controller::Sources`). A sign of life is a request for nothing:
//! it keeps the source in command and changes nothing that somebody else was granted meanwhile. It starts no walk, either:
//! after a silence in which the walk came to a stand, only a request to walk does. A voice that is killed is silent; one
//! that takes its leave leaves the walk as it is.

use std::time::Duration;

use runtime::Rate;
use wire::{Instance, Lasting, ObserverEnd, OperatorEnd, Reply, Request, Source, Verdict, Waiting};

use crate::failure::Failure;
use crate::script::Step;

/// Speaks for one stream.
pub struct Voice {
    operator: OperatorEnd,
    clock: ControllerClock,
    age_limit: Option<Duration>,
    /// The controller's tick when it last spoke; `None` before anything was granted: who asked for nothing holds nothing.
    spoke: Option<u64>,
    /// The last sign of life, until it is answered.
    sign: Option<Waiting>,
    rate: Rate,
}

/// The controller's time, by its reports: it may go faster or slower than the clock on the wall.
struct ControllerClock {
    observer: ObserverEnd,
    /// The tick at which the stream began.
    began: Option<u64>,
    now: u64,
}

/// How long the controller may take to answer: long enough to start its plant by hand.
const PATIENCE: Duration = Duration::from_secs(10);
/// How early a request is sent that is not yet due [ticks]: late enough that ending the stream ends its influence.
const LEAD: u64 = 20;
/// How many signs of life there are within the age limit, so that one may be late.
const SIGNS_PER_LIMIT: u32 = 3;

impl Voice {
    /// For a stream to an instance's controller. Without an age limit the controller's own counts.
    ///
    /// # Errors
    /// No controller is there.
    pub fn connect(instance: &Instance, age_limit: Option<Duration>) -> Result<Self, Failure> {
        let operator = OperatorEnd::connect(instance)?;
        let observer = ObserverEnd::connect(instance)?;
        let rate = Rate::new(observer.reports.rate_hz()).unwrap_or_default();
        let clock = ControllerClock { observer, began: None, now: 0 };
        Ok(Self { operator, clock, age_limit, spoke: None, sign: None, rate })
    }

    /// Looks at the controller's clock and gives a sign of life if it is time for one. To be called again and again.
    ///
    /// # Errors
    /// The shared memory failed, or the controller has left.
    pub fn keep_up(&mut self) -> Result<(), Failure> {
        self.clock.update()?;
        if self.sign.as_ref().is_some_and(|sign| !matches!(sign.poll(), Ok(None))) {
            self.sign = None;
        }
        // The controller may have started anew, and count from 0.
        let is_silent = self.spoke.is_some_and(|spoke| self.clock.now.abs_diff(spoke) >= self.ticks_between_signs());
        if is_silent && self.sign.is_none() {
            self.sign = Some(self.operator.requests.send(&(&self.request(Lasting::WhileSpeaking)).into())?);
            self.spoke = Some(self.clock.now);
        }
        Ok(())
    }

    /// The tick at which a step is due, if it is time to ask for it.
    pub fn due(&self, step: &Step) -> Option<u64> {
        if step.time.is_none() {
            return Some(0);
        }
        let due = self.clock.began? + step.tick(self.rate);
        (self.clock.now + LEAD >= due).then_some(due)
    }

    /// Whether the controller is still there.
    pub fn is_heard(&self) -> bool {
        self.operator.requests.controller_is_there()
    }

    /// Asks for what stands in a script, and waits for the reply.
    ///
    /// # Errors
    /// The controller does not answer, or nothing that makes sense.
    pub fn ask(&mut self, asked: &Request) -> Result<Reply, Failure> {
        let request = Request { lasting: Lasting::WhileSpeaking, age_limit: self.age_limit(), ..*asked };
        let reply = self.speak(&request)?;
        if reply.verdict != Verdict::Refused {
            self.clock.update()?;
            self.spoke = Some(self.clock.now);
        }
        Ok(reply)
    }

    /// Takes its leave: what it asked lasts from now on. The controller may have gone before.
    ///
    /// # Errors
    /// The controller is there but does not answer.
    pub fn take_leave(mut self) -> Result<(), Failure> {
        if self.spoke.is_some() && self.is_heard() {
            self.speak(&self.request(Lasting::Farewell))?;
        }
        Ok(())
    }

    fn speak(&mut self, request: &Request) -> Result<Reply, Failure> {
        // This is a sign of life, too.
        self.sign = None;
        self.operator.requests.ask(&request.into(), PATIENCE)?.checked().map_err(Failure::new)
    }

    /// A request for nothing.
    fn request(&self, lasting: Lasting) -> Request {
        Request { lasting, age_limit: self.age_limit(), ..Request::by(Source::Script) }
    }

    fn age_limit(&self) -> Option<f64> {
        self.age_limit.map(|limit| limit.as_secs_f64())
    }

    fn ticks_between_signs(&self) -> u64 {
        // Nobody says what the controller's own limit is, but it is no shorter than this.
        let limit = self.age_limit.unwrap_or(Duration::from_secs_f64(controller::AGE_LIMIT_MIN));
        (limit.div_duration_f64(self.rate.period() * SIGNS_PER_LIMIT) as u64).max(1)
    }
}

impl ControllerClock {
    fn update(&mut self) -> Result<(), Failure> {
        while let Some(report) = self.observer.reports.next_report()? {
            self.now = report.tick;
            self.began.get_or_insert(report.tick);
        }
        Ok(())
    }
}
