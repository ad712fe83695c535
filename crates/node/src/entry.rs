//! What the loops hand to their recorders, and the messages that are recorded of it.

use controller::{AdmissionTiming, Tick};
use interface::PeriodTiming;
use model::JointVector;
use plant::{Push, Truth};
use record::{PushMessage, RunEvent, TickMessage, TruthMessage};
use wire::{MeasurementMessage, ReplyMessage, ReportMessage, RequestMessage, SetpointMessage};

/// One tick of the controller's loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerEntry {
    /// How the loop kept its time.
    pub timing: PeriodTiming,
    /// How many periods the tick was for.
    pub periods: u64,
    /// Length of the tick as the controller received it (s).
    pub dt: f64,
    /// The measurement that the tick used.
    pub measurement: MeasurementMessage,
    /// The number of the request that the controller received before the tick; 0 is none.
    pub request: u32,
    /// When a completed admission job came back to the controller.
    pub admission: AdmissionTiming,
    /// What the controller returned.
    pub tick: Tick,
}

/// Everything that the controller's process records.
// A ring has room for the largest everywhere.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControllerEvent {
    /// The controller has ticked.
    Tick(ControllerEntry),
    /// A request has arrived; requests are counted from 1.
    Request(u32, RequestMessage),
    /// The request with this number was answered.
    Reply(u32, ReplyMessage),
}

/// Everything that the plant's process records.
// A ring has room for the largest everywhere.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlantEvent {
    /// The plant has ticked.
    Tick(PlantEntry),
    /// A push has begun before the tick of this number.
    Push(u64, Push),
    /// Up to this tick the controller has sent nothing for long. It is told, and not recorded.
    ControllerSilent(u64),
    /// In this tick the controller was heard again.
    ControllerBack(u64),
}

/// One tick of the plant's loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantEntry {
    /// Periods since the start.
    pub tick: u64,
    /// Angles of the physical joints (rad).
    pub angles: JointVector,
    /// State of the simulated robot that no sensor of a real one measures exactly.
    pub truth: Truth,
}

impl ControllerEntry {
    /// The report that observers receive.
    pub fn report(&self) -> ReportMessage {
        ReportMessage::new(&self.timing, &self.tick.report)
    }

    /// The setpoint that was sent.
    pub fn setpoint(&self) -> SetpointMessage {
        SetpointMessage::new(self.measurement.tick, self.timing.time_ns, &self.tick.setpoint)
    }

    /// Everything that is recorded of the tick.
    pub fn events(&self) -> [RunEvent; 4] {
        let tick = TickMessage {
            tick: self.timing.tick,
            periods: self.periods,
            dt: self.dt,
            request: self.request,
            returned: self.admission as u32,
            speed_in_force: self.tick.command.speed,
        };
        [
            RunEvent::Tick(tick),
            RunEvent::Measurement(self.measurement),
            RunEvent::Setpoint(self.setpoint()),
            RunEvent::Report(self.report()),
        ]
    }
}

impl PlantEntry {
    /// Everything that is recorded of the tick.
    pub fn event(&self) -> RunEvent {
        let Self { tick, angles, ref truth } = *self;
        let (p, q) = (truth.soles[0].translation, truth.soles[0].rotation);
        RunEvent::Truth(TruthMessage {
            tick,
            right_sole: [p.x, p.y, p.z, q.w, q.i, q.j, q.k],
            angles: angles.0,
            loads: truth.loads,
            com: truth.com.into(),
            zmp: truth.zmp.map_or([f64::NAN; 2], Into::into),
            trunk_tilt: truth.trunk_tilt,
            fallen: truth.has_fallen().into(),
        })
    }
}

/// What is recorded of a push that begins before a tick.
pub(crate) fn push_event(tick: u64, push: &Push) -> RunEvent {
    let Push { link, impulse, start, duration } = *push;
    RunEvent::Push(PushMessage { tick, link: link.number().into(), start, duration, impulse: impulse.into() })
}
