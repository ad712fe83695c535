//! The controller as it runs, timed from outside: from measurement to setpoint, from request to reply and effect.
//!
//! This process is the plant and an operator at once. It is awake while it waits for something, so that this is timed as it
//! arrives.
//! Requests are due at times that have nothing to do with the periods, and their times count from when they are due.

use std::collections::VecDeque;
use std::hint::spin_loop;
use std::time::Duration;

use bench::{BenchError, Findings, Machine, Over, Ratio, Series};
use model::Mechanism;
use plant::{Plant, Setpoint};
use runtime::{Rate, Scheduling, now_ns};
use wire::{Instance, ObserverEnd, OperatorEnd, PlantEnd, ReplyMessage, Request, Source, Waiting};

use crate::exchange;

/// How it is measured.
#[derive(Clone, Copy, Debug)]
pub struct InCommandOptions {
    /// The loops' rate.
    pub rate: Rate,
    /// Requests to time, each 1.35 s after the other: a change of speed must have ended before the next can be seen.
    pub requests: u32,
    /// Periods to time flat out.
    pub flat_out: u64,
    /// What this process asks of the system.
    pub scheduling: Scheduling,
}

/// A robot's other side: who hears setpoints and answers with measurements.
pub struct Robot<'r> {
    plant: &'r mut Plant,
    end: PlantEnd,
    setpoint: Setpoint,
    tick: u64,
}

/// A request on its way.
struct Asked {
    due_ns: u64,
    waiting: Option<Waiting>,
    /// The speed factor before.
    speed: f64,
    is_seen: bool,
}

const BETWEEN_REQUESTS: Duration = Duration::from_millis(1350);
/// What is asked in turn; neither is refused.
const SPEEDS: [f64; 2] = [1.05, 0.95];
/// How long before something is due this process is awake again [ns].
const AWAKE_BEFORE_NS: u64 = 200_000;
/// The controller starts, or is gone.
const PATIENCE_NS: u64 = 10_000_000_000;

/// Times the controller of an instance at its own pace, which has just been started.
///
/// # Errors
/// The controller does not come, or goes.
pub fn at_pace(
    options: &InCommandOptions,
    instance: &Instance,
    mechanism: &Mechanism,
    plant: &mut Plant,
) -> Result<Findings, BenchError> {
    let operator = patiently(|| OperatorEnd::connect(instance))?;
    let mut observer = patiently(|| ObserverEnd::connect(instance))?;
    let mut robot = Robot::connect(instance, mechanism, plant)?;
    // An ordinary thread: who is awake before everybody else would starve the thread that tells what is seen here.
    let _granted = Scheduling { priority: None, ..options.scheduling }.ask();
    let series = |name: &str| {
        let mut series = Series::new(format!("controller at {}", options.rate), name, Over::Median);
        series.begin_round();
        series
    };
    let mut to_setpoint = series("measurement → setpoint");
    let mut to_reply = series("request → reply");
    let mut to_effect = series("request → first changed setpoint");

    let period_ns = options.rate.period().as_nanos() as u64;
    let mut due_ns = now_ns() + period_ns;
    let mut unanswered = VecDeque::with_capacity(1024);
    // A second to find the stride.
    let mut request_due_ns = now_ns() + 1_000_000_000;
    let (mut asked, mut sent, mut speed) = (None::<Asked>, 0, 1.0);
    while sent < options.requests || asked.is_some() {
        let now = now_ns();
        if let Some(setpoint) = robot.hear() {
            while unanswered.front().is_some_and(|(tick, _)| *tick <= setpoint) {
                if let Some((_, written_ns)) = unanswered.pop_front() {
                    to_setpoint.add((now - written_ns) as f64);
                }
            }
        }
        while let Some(report) = observer.reports.next_report().map_err(gone)? {
            speed = report.speed;
            if let Some(asked) = asked.as_mut().filter(|asked| !asked.is_seen) {
                // It was sent after its measurement came, and says when it went.
                let went_ns = report.time_ns + report.compute_ns;
                asked.is_seen = went_ns > asked.due_ns && report.speed != asked.speed;
                if asked.is_seen {
                    to_effect.add((went_ns - asked.due_ns) as f64);
                }
            }
        }
        if let Some(request) = &mut asked {
            let reply: Option<ReplyMessage> = request.waiting.as_ref().map_or(Ok(None), Waiting::poll).map_err(gone)?;
            if reply.is_some() {
                to_reply.add((now - request.due_ns) as f64);
                request.waiting = None;
            }
            let is_over = now > request.due_ns + BETWEEN_REQUESTS.as_nanos() as u64;
            if is_over || (request.waiting.is_none() && request.is_seen) {
                asked = None;
            }
        } else if sent < options.requests && now >= request_due_ns {
            let wanted = Request { speed: Some(SPEEDS[sent as usize % 2]), ..Request::by(Source::Program) };
            let waiting = Some(operator.requests.send(&(&wanted).into()).map_err(gone)?);
            asked = Some(Asked { due_ns: request_due_ns, waiting, speed, is_seen: false });
            sent += 1;
            // Sooner or later within a period.
            let offset_ns = u64::from(sent) * 377_123 % 1_000_000;
            request_due_ns += BETWEEN_REQUESTS.as_nanos() as u64 + offset_ns;
        }
        if now >= due_ns {
            due_ns += period_ns;
            let written = robot.step();
            if unanswered.len() < unanswered.capacity() {
                unanswered.push_back(written);
            }
        }
        if unanswered.is_empty() && asked.is_none() {
            sleep_until(due_ns.min(request_due_ns).saturating_sub(AWAKE_BEFORE_NS));
        }
        spin_loop();
    }
    let seen = Ratio {
        of: format!("{} ({})", to_effect.name, to_effect.group),
        to: "a period".to_owned(),
        number: "p99".to_owned(),
        ratio: to_effect.quantile(0.99) / period_ns as f64,
        at_most: 1.0,
    };
    let notes = vec![format!(
        "The controller ticks at its own deadlines: a measurement waits up to a period for the next. {} requests.",
        to_reply.count()
    )];
    let series = vec![to_setpoint, to_reply, to_effect];
    Ok(Findings { what: "latency", machine: Machine::of_this_process(), series, ratios: vec![seen], notes })
}

/// Times the controller of an instance flat out, tick for tick; it has been started in lockstep.
///
/// # Errors
/// The controller does not come, or goes.
pub fn flat_out(
    options: &InCommandOptions,
    instance: &Instance,
    mechanism: &Mechanism,
    plant: &mut Plant,
) -> Result<Series, BenchError> {
    patiently(|| OperatorEnd::connect(instance))?;
    let mut robot = Robot::connect(instance, mechanism, plant)?;
    // As the controller in lockstep, which is an ordinary thread: who never sleeps must not be before everybody else.
    let _granted = Scheduling { priority: None, ..options.scheduling }.ask();
    let mut series = Series::new("controller in lockstep", "measurement → setpoint", Over::Median);
    series.begin_round();
    for _ in 0..options.flat_out {
        let (tick, written_ns) = robot.step();
        while robot.hear() != Some(tick) {
            if now_ns() - written_ns > PATIENCE_NS {
                return Err(BenchError::new("the controller", "it is silent"));
            }
            spin_loop();
        }
        series.add((now_ns() - written_ns) as f64);
    }
    Ok(series)
}

impl<'r> Robot<'r> {
    /// Takes the plant's place at an instance.
    ///
    /// # Errors
    /// The place is taken.
    pub fn connect(instance: &Instance, mechanism: &Mechanism, plant: &'r mut Plant) -> Result<Self, BenchError> {
        let end = PlantEnd::connect(instance, mechanism.fingerprint);
        let end = end.map_err(|error| BenchError::new("the plant's services", error))?;
        let setpoint = Setpoint { angles: plant.robot.angles, ..Setpoint::default() };
        Ok(Self { plant, end, setpoint, tick: 0 })
    }

    /// The tick of a setpoint that has come.
    pub fn hear(&mut self) -> Option<u64> {
        let setpoint = self.end.setpoints.news()?.checked().ok()?;
        self.setpoint = exchange::setpoint::for_plant(&setpoint);
        Some(setpoint.tick)
    }

    /// Simulates a period and tells what is sensed: the measurement's tick, and when it was written [ns].
    pub fn step(&mut self) -> (u64, u64) {
        let measured = if self.tick == 0 { self.plant.measure() } else { self.plant.step(&self.setpoint) };
        let written_ns = now_ns();
        self.end.measurements.write(&exchange::measurement::message(self.tick, written_ns, &measured));
        self.tick += 1;
        (self.tick - 1, written_ns)
    }
}

fn sleep_until(time_ns: u64) {
    let left_ns = time_ns.saturating_sub(now_ns());
    if left_ns > 0 {
        std::thread::sleep(Duration::from_nanos(left_ns));
    }
}

/// Connects as soon as the other side is there.
///
/// # Errors
/// It does not come.
pub fn patiently<T, E: std::fmt::Display>(connect: impl Fn() -> Result<T, E>) -> Result<T, BenchError> {
    let began_ns = now_ns();
    loop {
        match connect() {
            Ok(end) => return Ok(end),
            Err(error) if now_ns() - began_ns > PATIENCE_NS => return Err(BenchError::new("the controller", error)),
            Err(_) => std::thread::sleep(Duration::from_millis(5)),
        }
    }
}

fn gone(error: impl std::fmt::Display) -> BenchError {
    BenchError::new("the controller", error)
}
