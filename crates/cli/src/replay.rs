//! Replaying a run: the controller, made anew from what it was made from, is given what it was given then.
//!
//! What a controller does depends on nothing but robot, parameters, and what it is told between and in its ticks: the length
//! of each period, measurements, requests, and when a settled inquiry came back. All of that is in a recording, so that a run
//! in real time can be replayed as well as one in lockstep.

use std::collections::HashMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use ::record::{Event, Origin, Recording, Returned, TickMessage, files_of, origin_of};
use controller::{Controller, Inquiry};
use gait::NominalTable;
use model::{Joint, Mechanism};
use serde::Serialize;
use wire::{MeasurementMessage, RequestMessage, SetpointMessage};

use crate::configuration::{CONTROLLER, Errors, MECHANISM, NOMINAL, Robot};
use crate::exchange;
use crate::failure::Failure;
use crate::turns::Clock;

/// How a replay came out.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Outcome {
    /// How many setpoints were compared.
    pub setpoints: u64,
    /// Where the first of them differs, if one does: nothing is compared after it.
    pub difference: Option<Difference>,
    /// Why the rest of the run could not be replayed, if it could not.
    pub rest: Option<String>,
}

/// Where recorded and replayed setpoint differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The controller's tick.
    pub tick: u64,
    /// Since the start of the run [s].
    pub time_s: f64,
    /// `angle`, `rate` or `feed-forward torque`.
    pub quantity: &'static str,
    /// The joint's number.
    pub joint: u8,
    /// The joint's name.
    pub name: &'static str,
    /// [rad], [rad/s] or [N·m]
    pub recorded: f64,
    /// Likewise.
    pub replayed: f64,
}

/// A controller that is given what another one was given.
struct Replayer {
    controller: Controller,
    /// By their numbers, those that it was not asked yet.
    requests: HashMap<u32, RequestMessage>,
    /// Taken, and not given back.
    inquiry: Option<Box<Inquiry>>,
    next_tick: u64,
}

/// Replays a run: a recording, or the folder that holds it.
///
/// # Errors
/// There is no recording of a controller, or one of another version.
pub fn replay(run: &Path) -> Result<Outcome, Failure> {
    let mut replayer = Replayer::new(run, &origin_of(run)?)?;
    let mut outcome = Outcome::default();
    for file in files_of(run)? {
        let mut recording = Recording::open(&file)?;
        let (mut tick, mut measurement) = (None, None);
        while let Some(stamped) = recording.next_event()? {
            match stamped.event {
                Event::Request(message) => {
                    replayer.requests.insert(stamped.number, message);
                }
                Event::Tick(message) => tick = Some(message),
                Event::Measurement(message) => measurement = Some(message),
                Event::Setpoint(recorded) => {
                    let (Some(tick), Some(measurement)) = (tick.take(), measurement.take()) else { continue };
                    if let Some(missing) = replayer.missing_before(&tick) {
                        outcome.rest = Some(missing);
                        return Ok(outcome);
                    }
                    let replayed = replayer.tick(&tick, &measurement, recorded.time_ns);
                    outcome.setpoints += 1;
                    outcome.difference = Difference::between(&tick, stamped.time(), &recorded, &replayed);
                    if outcome.difference.is_some() {
                        return Ok(outcome);
                    }
                }
                Event::Reply(_) | Event::Report(_) | Event::Truth(_) => {}
            }
        }
        outcome.rest = outcome.rest.or(recording.cut());
    }
    Ok(outcome)
}

impl Replayer {
    /// The controller as it was when its run began.
    fn new(run: &Path, origin: &Origin) -> Result<Self, Failure> {
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

        let word = |key| origin.word("controller", key);
        let clock = if word("clock") == Some(Clock::Lockstep.text()) { Clock::Lockstep } else { Clock::Realtime };
        let robot = Robot { mechanism, nominal: Arc::new(nominal) };
        let controller = robot.controller(parameters, clock, word("from_stand") == Some("true"))?;
        Ok(Self { controller, requests: HashMap::new(), inquiry: None, next_tick: 0 })
    }

    /// What was lost before a tick, if something was.
    fn missing_before(&self, tick: &TickMessage) -> Option<String> {
        let (from, to) = (self.next_tick, (tick.tick + 1).saturating_sub(tick.periods));
        (from != to)
            .then(|| format!("the recording has no ticks from {from} up to {to}, so that nobody knows what came then"))
    }

    /// What the loop did in a tick.
    fn tick(&mut self, tick: &TickMessage, measurement: &MeasurementMessage, time_ns: u64) -> SetpointMessage {
        if tick.returned == Returned::BeforeRequest as u32 {
            self.give_back();
        }
        self.take();
        let asked =
            self.requests.remove(&tick.request).and_then(|message| exchange::request::for_controller(&message).ok());
        if let Some((_, asked)) = asked {
            self.controller.ask(&asked);
            if tick.returned == Returned::AfterRequest as u32 {
                self.give_back();
            }
            self.take();
        }
        self.next_tick = tick.tick + 1;
        let report = self.controller.tick(tick.dt, Some(&exchange::measurement::for_controller(measurement)));
        exchange::setpoint::message(measurement.tick, time_ns, &report.setpoint)
    }

    /// Has looked into what is to be looked into, and says so.
    fn give_back(&mut self) {
        self.take();
        if let Some(mut inquiry) = self.inquiry.take() {
            inquiry.settle();
            self.controller.give_back(inquiry);
        }
    }

    /// Takes what is to be looked into.
    fn take(&mut self) {
        if let Some(inquiry) = self.controller.inquiry() {
            self.inquiry = Some(inquiry);
        }
    }
}

impl Outcome {
    /// Whether every setpoint of the run came out as recorded.
    pub fn is_identical(&self) -> bool {
        self.setpoints > 0 && self.difference.is_none()
    }
}

impl Difference {
    /// The first value that is not the same to the bit.
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

impl fmt::Display for Outcome {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match &self.difference {
            Some(Difference { tick, time_s, quantity, joint, name, recorded, replayed }) => {
                write!(
                    out,
                    "different in tick {tick} ({time_s:.3} s): {quantity} of joint {joint} ({name}) was {recorded:?}, is \
                     {replayed:?}"
                )?;
            }
            None if self.setpoints == 0 => write!(out, "nothing to compare: no setpoint was recorded")?,
            None => write!(out, "identical: {} setpoints", self.setpoints)?,
        }
        match &self.rest {
            Some(rest) => write!(out, "\nnot all of the run: {rest}"),
            None => Ok(()),
        }
    }
}
