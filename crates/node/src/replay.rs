//! Replays a run: a controller made from the recorded configuration receives the recorded inputs again.
//!
//! What a controller does depends on nothing but robot, parameters, and its inputs between and in the ticks: the length
//! of each period, measurements, requests, and when an evaluated admission job was returned. All of that is in a
//! recording, so that runs in real time can be replayed as well as runs in lockstep.

use std::collections::HashMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use config::Config;
use controller::{AdmissionJob, AdmissionTiming, AdmissionWorker, Controller, Driver};
use gait::{NominalTable, Robot};
use model::{Joint, Mechanism};
use record::{Provenance, Recording, RunEvent, TickMessage, files_of, provenance_of};
use serde::Serialize;
use wire::{MeasurementMessage, RequestMessage, SetpointMessage};

use crate::configuration::{CONTROLLER, Errors, MECHANISM, NOMINAL, controller};
use crate::cycle::Clock;
use crate::error::NodeError;

/// Result of a replay.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ReplayOutcome {
    /// How many setpoints were compared.
    pub setpoints: u64,
    /// The first setpoint that differs, if one does.
    pub difference: Option<Difference>,
    /// Largest difference of an angle in all setpoints (rad).
    pub angle_difference_max: f64,
    /// Why the replay ended before the recording does, if it did: inputs of the next tick are missing.
    pub missing: Option<String>,
    /// Where the recording is truncated, if it is: what follows was not recorded, and cannot be compared.
    pub cut: Option<String>,
    /// What the recorded messages lack because an earlier version wrote them, one text for each kind: the controller of
    /// this version replays without.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lacking: Vec<String>,
}

/// The first value in which a recorded and a replayed setpoint differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The controller's tick.
    pub tick: u64,
    /// Time since the start of the run (s).
    pub time_s: f64,
    /// Which value differs: `angle`, `rate` or `feed-forward torque`.
    pub quantity: &'static str,
    /// The joint's number.
    pub joint: u8,
    /// The joint's name.
    pub name: &'static str,
    /// The recorded value (rad), (rad/s) or (N·m).
    pub recorded: f64,
    /// The replayed value (rad), (rad/s) or (N·m).
    pub replayed: f64,
}

/// A controller that receives recorded inputs.
struct Replayer {
    driver: Driver<RecordedWorker>,
    /// By number: the requests that were not submitted yet.
    requests: HashMap<u32, RequestMessage>,
    next_tick: u64,
}

/// Completes admission jobs when the recording says so.
#[derive(Default)]
struct RecordedWorker {
    /// When a job came back in the period to replay.
    timing: AdmissionTiming,
    /// Taken from the controller and not completed.
    job: Option<Box<AdmissionJob>>,
}

/// Replays a run: a recording, or the folder that holds it.
///
/// # Errors
/// There is no recording of a controller, or it has another version.
pub fn replay(run: &Path) -> Result<ReplayOutcome, NodeError> {
    let mut replayer = Replayer::new(run, &provenance_of(run)?)?;
    let mut outcome = ReplayOutcome::default();
    for file in files_of(run)? {
        let mut recording = Recording::open(&file)?;
        let (mut tick, mut measurement) = (None, None);
        while let Some(stamped) = recording.next_event()? {
            match stamped.event {
                RunEvent::Request(message) => {
                    replayer.requests.insert(stamped.number, message);
                }
                RunEvent::Tick(message) => tick = Some(message),
                RunEvent::Measurement(message) => measurement = Some(message),
                RunEvent::Setpoint(recorded) => {
                    let (Some(tick), Some(measurement)) = (tick.take(), measurement.take()) else { continue };
                    outcome.missing = replayer.missing_before(&tick);
                    if outcome.missing.is_some() {
                        return Ok(outcome);
                    }
                    let replayed = replayer.tick(&tick, &measurement, recorded.time_ns);
                    outcome.setpoints += 1;
                    let difference = || Difference::between(&tick, stamped.time(), &recorded, &replayed);
                    outcome.difference = outcome.difference.or_else(difference);
                    let apart = recorded.angles.iter().zip(&replayed.angles).map(|(one, other)| (one - other).abs());
                    outcome.angle_difference_max = apart.fold(outcome.angle_difference_max, f64::max);
                }
                RunEvent::Reply(_) | RunEvent::Report(_) | RunEvent::Truth(_) | RunEvent::Push(_) => {}
            }
        }
        outcome.cut = outcome.cut.or(recording.cut());
        outcome.lacking.extend(recording.lacking());
    }
    Ok(outcome)
}

impl Replayer {
    /// Makes the controller as it was when the run began.
    fn new(run: &Path, origin: &Provenance) -> Result<Self, NodeError> {
        let run = run.display();
        let mut errors = Errors::default();
        let mut text = |name: &str| {
            let text = origin.file(name).ok_or_else(|| format!("{run}: has no {name} attached"));
            errors.note(text).map(|text| (text, format!("{run}: {name}")))
        };
        let (mechanism, nominal, parameters) = (text(MECHANISM), text(NOMINAL), text(CONTROLLER));
        let mechanism = mechanism.and_then(|(text, name)| errors.note(Mechanism::from_toml(text, &name)));
        let nominal = nominal.and_then(|(text, name)| errors.note(NominalTable::from_csv(text, Path::new(&name))));
        let parameters =
            parameters.and_then(|(text, name)| errors.note(controller::Parameters::from_toml(text, &name)));
        let ((mechanism, nominal), parameters) = errors.finish(mechanism.zip(nominal).zip(parameters))?;

        let word = |key| origin.entry("controller", key);
        let clock = if word("clock") == Some(Clock::Lockstep.text()) { Clock::Lockstep } else { Clock::Realtime };
        let robot = Robot { mechanism, nominal: Arc::new(nominal) };
        let controller = controller(&robot, parameters, clock, word("from_stand") == Some("true"))?;
        let driver = Driver { controller, worker: RecordedWorker::default() };
        Ok(Self { driver, requests: HashMap::new(), next_tick: 0 })
    }

    /// Describes what is missing in the recording to replay a tick: ticks before it, or its request.
    fn missing_before(&self, tick: &TickMessage) -> Option<String> {
        let (from, to) = (self.next_tick, tick.tick.saturating_add(1).saturating_sub(tick.periods));
        if from != to {
            return Some(format!("recording gap: ticks {from} up to {to} are missing; cannot continue"));
        }
        let request = tick.request;
        (request != 0 && !self.requests.contains_key(&request)).then(|| {
            format!("recording gap: request {request}, of tick {}, is missing in /requests; cannot continue", tick.tick)
        })
    }

    /// Does with the controller what the loop did in a tick.
    fn tick(&mut self, tick: &TickMessage, measurement: &MeasurementMessage, time_ns: u64) -> SetpointMessage {
        self.next_tick = tick.tick.saturating_add(1);
        self.driver.worker.timing = AdmissionTiming::from_code(tick.returned);
        let request = self.requests.remove(&tick.request).and_then(|message| message.checked().ok());
        let step = self.driver.step(tick.dt, Some(&measurement.measurement()), |_| request);
        SetpointMessage::new(measurement.tick, time_ns, &step.tick.setpoint)
    }
}

impl RecordedWorker {
    fn take_job(&mut self, controller: &mut Controller) {
        if let Some(job) = controller.take_job() {
            self.job = Some(job);
        }
    }
}

impl AdmissionWorker for RecordedWorker {
    fn serve(&mut self, controller: &mut Controller, point: AdmissionTiming) -> bool {
        self.take_job(controller);
        let due = if point == self.timing { self.job.take() } else { None };
        let Some(mut job) = due else { return false };
        job.evaluate();
        controller.complete(job);
        self.take_job(controller);
        true
    }
}

impl ReplayOutcome {
    /// Whether all recorded setpoints were compared, and are the same to the bit. The recording may be truncated: what
    /// was not recorded cannot differ.
    pub fn is_identical(&self) -> bool {
        self.setpoints > 0 && self.difference.is_none() && self.missing.is_none()
    }
}

impl Difference {
    /// Finds the first value that is not the same to the bit.
    fn between(
        tick: &TickMessage,
        time_s: f64,
        recorded: &SetpointMessage,
        replayed: &SetpointMessage,
    ) -> Option<Self> {
        let quantities = [
            ("angle", &recorded.angles, &replayed.angles),
            ("rate", &recorded.rates, &replayed.rates),
            ("feed-forward torque", &recorded.feed_forward, &replayed.feed_forward),
        ];
        quantities.into_iter().find_map(|(quantity, recorded, replayed)| {
            let joint = Joint::ALL.into_iter().find(|joint| {
                let at = joint.index();
                recorded[at].to_bits() != replayed[at].to_bits()
            })?;
            let (number, name, at) = (joint.number(), joint.name(), joint.index());
            Some(Self {
                tick: tick.tick,
                time_s,
                quantity,
                joint: number,
                name,
                recorded: recorded[at],
                replayed: replayed[at],
            })
        })
    }
}

impl fmt::Display for ReplayOutcome {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match &self.difference {
            Some(Difference { tick, time_s, quantity, joint, name, recorded, replayed }) => {
                write!(
                    out,
                    "differs in tick {tick} ({time_s:.3} s): {quantity} of joint {joint} ({name}) was {recorded:?}, is \
                     {replayed:?}\nangles differ by at most {:.1e} rad in {} setpoints",
                    self.angle_difference_max, self.setpoints
                )?;
            }
            None if self.setpoints == 0 => write!(out, "nothing to compare: no setpoint was recorded")?,
            None => write!(out, "identical: {} setpoints", self.setpoints)?,
        }
        for rest in self.missing.iter().chain(&self.cut) {
            write!(out, "\nreplay incomplete: {rest}")?;
        }
        for lacking in &self.lacking {
            write!(out, "\nof an earlier version: {lacking}")?;
        }
        Ok(())
    }
}
