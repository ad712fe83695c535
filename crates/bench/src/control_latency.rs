//! Latency of a running controller, measured from outside: from measurement to setpoint, from request to reply and
//! effect.
//!
//! This process is plant and operator at once. It waits actively, so that messages are timed as they arrive. Requests
//! are due at times that are unrelated to the periods, and their latency counts from when they are due.

use std::collections::VecDeque;
use std::hint::spin_loop;
use std::time::Duration;

use interface::{GaitChange, Rate, Request, Setpoint, Source};
use model::Mechanism;
use plant::Plant;
use runtime::{Scheduling, now_ns};
use wire::{Instance, MeasurementMessage, ObserverPorts, OperatorPorts, PendingReply, PlantPorts, ReplyMessage};

use crate::{BenchError, BenchReport, Machine, Ratio, Reduction, Series};

/// Options of the measurement.
#[derive(Clone, Copy, Debug)]
pub struct ControlLatencyOptions {
    /// Control periods per second.
    pub rate: Rate,
    /// Number of requests to time, 1.35 s apart: a change of speed must have ended before the next can be seen.
    pub requests: u32,
    /// Number of periods to time in lockstep.
    pub in_lockstep: u64,
    /// Scheduling of this process.
    pub scheduling: Scheduling,
}

/// A simulated robot that receives setpoints and sends measurements.
pub struct SimulatedRobot<'r> {
    plant: &'r mut Plant,
    end: PlantPorts,
    setpoint: Setpoint,
    tick: u64,
}

/// A request whose effect has not been seen yet.
struct RequestInFlight {
    due_ns: u64,
    waiting: Option<PendingReply>,
    /// The speed factor before the request.
    speed: f64,
    is_seen: bool,
}

/// Time between two requests.
const BETWEEN_REQUESTS: Duration = Duration::from_millis(1350);
/// The requested speed factors, alternating; neither is refused.
const SPEEDS: [f64; 2] = [1.05, 0.95];
/// How long before the next deadline this process stops sleeping (ns).
const AWAKE_BEFORE_NS: u64 = 200_000;
/// How long to wait for the controller (ns).
const TIMEOUT_NS: u64 = 10_000_000_000;

/// Times the controller of an instance, which has just been started in real time.
///
/// # Errors
/// The controller does not start, or it ends.
pub fn in_realtime(
    options: &ControlLatencyOptions,
    instance: &Instance,
    mechanism: &Mechanism,
    plant: &mut Plant,
) -> Result<BenchReport, BenchError> {
    let operator = connect_retrying(|| OperatorPorts::connect(instance))?;
    let mut observer = connect_retrying(|| ObserverPorts::connect(instance))?;
    let mut robot = SimulatedRobot::connect(instance, mechanism, plant)?;
    // An ordinary thread: a waiting thread with priority would starve the thread that publishes the reports read here.
    let _granted = Scheduling { priority: None, ..options.scheduling }.request();
    let series = |name: &str| {
        let mut series = Series::new(format!("controller at {}", options.rate), name, Reduction::Median);
        series.begin_round();
        series
    };
    let mut to_setpoint = series("measurement → setpoint");
    let mut to_reply = series("request → reply");
    let mut to_effect = series("request → first changed setpoint");

    let period_ns = options.rate.period().as_nanos() as u64;
    let mut due_ns = now_ns() + period_ns;
    let mut unanswered = VecDeque::with_capacity(1024);
    // A second for the walk to become steady.
    let mut request_due_ns = now_ns() + 1_000_000_000;
    let (mut asked, mut sent, mut speed) = (None::<RequestInFlight>, 0, 1.0);
    while sent < options.requests || asked.is_some() {
        let now = now_ns();
        if let Some(setpoint) = robot.take_setpoint() {
            while unanswered.front().is_some_and(|(tick, _)| *tick <= setpoint) {
                if let Some((_, written_ns)) = unanswered.pop_front() {
                    to_setpoint.add((now - written_ns) as f64);
                }
            }
        }
        while let Some(report) = observer.reports.next_report().map_err(gone)? {
            speed = report.speed;
            if let Some(asked) = asked.as_mut().filter(|asked| !asked.is_seen) {
                // The setpoint of the report left at this time.
                let went_ns = report.time_ns + report.compute_ns;
                asked.is_seen = went_ns > asked.due_ns && report.speed != asked.speed;
                if asked.is_seen {
                    to_effect.add((went_ns - asked.due_ns) as f64);
                }
            }
        }
        if let Some(request) = &mut asked {
            let reply: Option<ReplyMessage> =
                request.waiting.as_ref().map_or(Ok(None), PendingReply::poll).map_err(gone)?;
            if reply.is_some() {
                to_reply.add((now - request.due_ns) as f64);
                request.waiting = None;
            }
            let is_over = now > request.due_ns + BETWEEN_REQUESTS.as_nanos() as u64;
            if is_over || (request.waiting.is_none() && request.is_seen) {
                asked = None;
            }
        } else if sent < options.requests && now >= request_due_ns {
            let gait = GaitChange { speed: Some(SPEEDS[sent as usize % 2]), ..GaitChange::NONE };
            let wanted = Request { gait, ..Request::new(Source::Program) };
            let waiting = Some(operator.requests.send(&(&wanted).into()).map_err(gone)?);
            asked = Some(RequestInFlight { due_ns: request_due_ns, waiting, speed, is_seen: false });
            sent += 1;
            // At a different time within the period.
            let offset_ns = u64::from(sent) * 377_123 % period_ns;
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
        interval: None,
        at_most: 1.0,
    };
    let notes = vec![format!(
        "The controller ticks at its own deadlines: a measurement waits up to a period for the next. {} requests.",
        to_reply.count()
    )];
    let series = vec![to_setpoint, to_reply, to_effect];
    Ok(BenchReport { what: "latency", machine: Machine::of_this_process(), series, ratios: vec![seen], notes })
}

/// Times the controller of an instance tick for tick, which has just been started in lockstep.
///
/// # Errors
/// The controller does not start, or it ends.
pub fn in_lockstep(
    options: &ControlLatencyOptions,
    instance: &Instance,
    mechanism: &Mechanism,
    plant: &mut Plant,
) -> Result<Series, BenchError> {
    connect_retrying(|| OperatorPorts::connect(instance))?;
    let mut robot = SimulatedRobot::connect(instance, mechanism, plant)?;
    // An ordinary thread, as the controller in lockstep is: a thread that never sleeps must not have priority.
    let _granted = Scheduling { priority: None, ..options.scheduling }.request();
    let mut series = Series::new("controller in lockstep", "measurement → setpoint", Reduction::Median);
    series.begin_round();
    for _ in 0..options.in_lockstep {
        let (tick, written_ns) = robot.step();
        while robot.take_setpoint() != Some(tick) {
            if now_ns() - written_ns > TIMEOUT_NS {
                return Err(BenchError::new("the controller", "no message for too long"));
            }
            spin_loop();
        }
        series.add((now_ns() - written_ns) as f64);
    }
    Ok(series)
}

impl<'r> SimulatedRobot<'r> {
    /// Connects to an instance as its plant.
    ///
    /// # Errors
    /// The instance has a plant already.
    pub fn connect(instance: &Instance, mechanism: &Mechanism, plant: &'r mut Plant) -> Result<Self, BenchError> {
        let end = PlantPorts::connect(instance, mechanism.fingerprint);
        let end = end.map_err(|error| BenchError::new("the plant's services", error))?;
        let setpoint = Setpoint { angles: plant.robot.angles, ..Setpoint::default() };
        Ok(Self { plant, end, setpoint, tick: 0 })
    }

    /// Reads a new setpoint, if there is one, and returns its tick.
    pub fn take_setpoint(&mut self) -> Option<u64> {
        let message = self.end.setpoints.take_new()?;
        self.setpoint = message.checked().ok()?;
        Some(message.tick)
    }

    /// Simulates a period and writes the measurement. Returns its tick, and when it was written (ns).
    pub fn step(&mut self) -> (u64, u64) {
        let measured = if self.tick == 0 { self.plant.measure() } else { self.plant.step(&self.setpoint) };
        let written_ns = now_ns();
        self.end.measurements.write(&MeasurementMessage::new(self.tick, written_ns, &measured));
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

/// Tries to connect until it succeeds.
///
/// # Errors
/// It did not succeed within ten seconds.
pub fn connect_retrying<T, E: std::fmt::Display>(connect: impl Fn() -> Result<T, E>) -> Result<T, BenchError> {
    let began_ns = now_ns();
    loop {
        match connect() {
            Ok(end) => return Ok(end),
            Err(error) if now_ns() - began_ns > TIMEOUT_NS => return Err(BenchError::new("the controller", error)),
            Err(_) => std::thread::sleep(Duration::from_millis(5)),
        }
    }
}

fn gone(error: impl std::fmt::Display) -> BenchError {
    BenchError::new("the controller", error)
}
