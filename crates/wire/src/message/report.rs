//! Report, controller → anyone: what happened in one period.

use iceoryx2::prelude::ZeroCopySend;
use model::Side;

use super::MessageFault;
use super::code::codes;
use super::fault::Check;

codes! {
    /// What the controller is doing.
    Mode {
        /// Half-step after half-step.
        Walking = 0 "walking",
        /// On both feet, in stride.
        Holding = 1 "holding",
        /// Lying, or about to.
        Fallen = 2 "fallen",
        /// On both feet, the weight going to the foot that is to bear first.
        Starting = 3 "starting",
        /// On both feet, side by side.
        Standing = 4 "standing",
        /// The last half-steps before a stand.
        Stopping = 5 "stopping",
        /// Standing until a reset, since something went wrong.
        Faulted = 6 "faulted",
        /// Half-step after half-step without getting ahead.
        InPlace = 7 "in place",
    }
}

codes! {
    /// One thing that is not as it should be; its number is its bit in [`ReportMessage::faults`].
    Fault {
        /// A measurement holds a number that is not finite.
        MeasurementNotFinite = 1 "a measurement holds a number that is not finite",
        /// A measurement holds a number that no working sensor gives.
        MeasurementAbsurd = 2 "a measurement holds a number that no working sensor gives",
        /// No new measurement has come for too long.
        MeasurementStale = 4 "no new measurement has come for too long",
        /// A measurement is older than one before it.
        MeasurementOutOfOrder = 8 "a measurement is older than one before it",
        /// A joint angle in the setpoint had to be held within its range.
        AngleLimited = 16 "a joint angle had to be held within its range",
        /// A joint rate in the setpoint had to be held within its limit.
        RateLimited = 32 "a joint rate had to be held within its limit",
        /// The setpoint computed was not finite and the last good one was sent.
        SetpointNotFinite = 64 "the setpoint was not finite; the last good one was sent",
        /// The feet carry too little for a ZMP estimate.
        InTheAir = 128 "the feet carry too little for a zero-moment point",
        /// The robot has fallen.
        Fallen = 256 "the robot has fallen",
        /// The plan went where a leg cannot reach; the posture before was kept.
        OutOfReach = 1024 "the plan went where a leg cannot reach",
        /// A deadline was missed in this period.
        DeadlineMissed = 512 "a deadline was missed",
    }
}

/// A [`Report`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Report.v2")]
#[repr(C)]
pub struct ReportMessage {
    /// Periods since the controller started.
    pub tick: u64,
    /// When the period began, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// A [`Mode`].
    pub mode: u32,
    /// The bearing foot: 0 right, 1 left.
    pub support: u32,
    /// Half-steps finished, which is the number of the present one counted from 0.
    pub half_step: u64,
    /// How much of the present half-step is done, 0 to 1.
    pub progress: f64,
    /// `c` in force.
    pub speed: f64,
    /// `α` in force [rad].
    pub turn: f64,
    /// `β` in force [rad].
    pub extension: f64,
    /// Measured ZMP, x and y in the bearing foot's sole frame [m]; NaN when the feet carry too little.
    pub zmp_in_support: [f64; 2],
    /// Planned ZMP, likewise [m]; NaN when there is no plan.
    pub zmp_planned: [f64; 2],
    /// Of the measured ZMP to the edge of the support polygon [m], negative outside; NaN when there is none.
    pub margin: f64,
    /// Feedback angles added at the support ankle: roll, pitch [rad].
    pub lean: [f64; 2],
    /// What the plan adds to the plain sum of the modifications: support ankle roll and pitch, waist roll and pitch [rad];
    /// NaN when it is not known.
    pub added: [f64; 4],
    /// Sensed centre of mass in the bearing foot's sole frame, made level [m]; NaN when it is not known.
    pub com_in_support: [f64; 3],
    /// Its velocity, likewise [m/s].
    pub com_velocity_in_support: [f64; 3],
    /// Planned centre of mass, likewise [m]; NaN when there is no plan.
    pub com_planned: [f64; 3],
    /// Its velocity, likewise [m/s].
    pub com_velocity_planned: [f64; 3],
    /// Sum of the [`Fault`]s present.
    pub faults: u32,
    /// Deadlines missed since the start.
    pub missed: u32,
    /// Computing time of the period [ns].
    pub compute_ns: u64,
}

/// What happened in one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Periods since the controller started.
    pub tick: u64,
    /// When the period began, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// What the controller is doing.
    pub mode: Mode,
    /// The bearing foot.
    pub support: Side,
    /// Half-steps finished, which is the number of the present one counted from 0.
    pub half_step: u64,
    /// How much of the present half-step is done, 0 to 1.
    pub progress: f64,
    /// `c` in force.
    pub speed: f64,
    /// `α` in force [rad].
    pub turn: f64,
    /// `β` in force [rad].
    pub extension: f64,
    /// Measured ZMP, x and y in the bearing foot's sole frame [m]; `None` when the feet carry too little.
    pub zmp_in_support: Option<[f64; 2]>,
    /// Planned ZMP, likewise [m]; `None` when there is no plan.
    pub zmp_planned: Option<[f64; 2]>,
    /// Of the measured ZMP to the edge of the support polygon [m], negative outside.
    pub margin: Option<f64>,
    /// Feedback angles added at the support ankle: roll, pitch [rad].
    pub lean: [f64; 2],
    /// What the plan adds to the plain sum of the modifications: support ankle roll and pitch, waist roll and pitch [rad];
    /// `None` when it is not known.
    pub added: Option<[f64; 4]>,
    /// Sensed centre of mass in the bearing foot's sole frame, made level [m].
    pub com_in_support: Option<[f64; 3]>,
    /// Its velocity, likewise [m/s].
    pub com_velocity_in_support: Option<[f64; 3]>,
    /// Planned centre of mass, likewise [m]; `None` when there is no plan.
    pub com_planned: Option<[f64; 3]>,
    /// Its velocity, likewise [m/s].
    pub com_velocity_planned: Option<[f64; 3]>,
    /// Sum of the [`Fault`]s present, as [`Fault::sum`] makes it; bits that this version does not know may be set.
    pub faults: u32,
    /// Deadlines missed since the start.
    pub missed: u32,
    /// Computing time of the period [ns].
    pub compute_ns: u64,
}

impl Fault {
    /// Several faults as one number.
    pub fn sum(faults: impl IntoIterator<Item = Fault>) -> u32 {
        faults.into_iter().fold(0, |sum, fault| sum | fault.code())
    }

    /// The faults in such a number.
    pub fn in_sum(sum: u32) -> impl Iterator<Item = Fault> {
        Fault::ALL.iter().copied().filter(move |fault| sum & fault.code() != 0)
    }
}

impl ReportMessage {
    /// The report, if its codes are known and its numbers finite (but for those that may be NaN).
    pub fn checked(&self) -> Result<Report, MessageFault> {
        let check = Check("report");
        let support = match self.support {
            0 => Side::Right,
            1 => Side::Left,
            value => {
                let (field, known) = ("support", "0 (right) 1 (left)");
                return Err(MessageFault::UnknownCode { message: check.0, field, value, known });
            }
        };
        Ok(Report {
            tick: self.tick,
            time_ns: self.time_ns,
            mode: check.code("mode", self.mode)?,
            support,
            half_step: self.half_step,
            progress: check.number("progress", self.progress)?,
            speed: check.number("speed", self.speed)?,
            turn: check.number("turn", self.turn)?,
            extension: check.number("extension", self.extension)?,
            zmp_in_support: known(&check, "zmp_in_support", &self.zmp_in_support)?,
            zmp_planned: known(&check, "zmp_planned", &self.zmp_planned)?,
            margin: if self.margin.is_nan() { None } else { Some(check.number("margin", self.margin)?) },
            lean: check.numbers("lean", &self.lean)?,
            added: known(&check, "added", &self.added)?,
            com_in_support: known(&check, "com_in_support", &self.com_in_support)?,
            com_velocity_in_support: known(&check, "com_velocity_in_support", &self.com_velocity_in_support)?,
            com_planned: known(&check, "com_planned", &self.com_planned)?,
            com_velocity_planned: known(&check, "com_velocity_planned", &self.com_velocity_planned)?,
            faults: self.faults,
            missed: self.missed,
            compute_ns: self.compute_ns,
        })
    }
}

/// Numbers that are all there, or none of them.
fn known<const N: usize>(
    check: &Check,
    field: &'static str,
    values: &[f64; N],
) -> Result<Option<[f64; N]>, MessageFault> {
    if values.iter().all(|value| value.is_nan()) { Ok(None) } else { check.numbers(field, values).map(Some) }
}

impl From<&Report> for ReportMessage {
    fn from(report: &Report) -> Self {
        Self {
            tick: report.tick,
            time_ns: report.time_ns,
            mode: report.mode.code(),
            support: match report.support {
                Side::Right => 0,
                Side::Left => 1,
            },
            half_step: report.half_step,
            progress: report.progress,
            speed: report.speed,
            turn: report.turn,
            extension: report.extension,
            zmp_in_support: report.zmp_in_support.unwrap_or([f64::NAN; 2]),
            zmp_planned: report.zmp_planned.unwrap_or([f64::NAN; 2]),
            margin: report.margin.unwrap_or(f64::NAN),
            lean: report.lean,
            added: report.added.unwrap_or([f64::NAN; 4]),
            com_in_support: report.com_in_support.unwrap_or([f64::NAN; 3]),
            com_velocity_in_support: report.com_velocity_in_support.unwrap_or([f64::NAN; 3]),
            com_planned: report.com_planned.unwrap_or([f64::NAN; 3]),
            com_velocity_planned: report.com_velocity_planned.unwrap_or([f64::NAN; 3]),
            faults: report.faults,
            missed: report.missed,
            compute_ns: report.compute_ns,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_survives_the_way_there_and_back() {
        let known = Report {
            tick: 1,
            time_ns: 2,
            mode: Mode::Walking,
            support: Side::Left,
            half_step: 3,
            progress: 0.5,
            speed: 1.0,
            turn: 0.1,
            extension: 0.0,
            zmp_in_support: Some([0.01, -0.02]),
            zmp_planned: Some([0.0, 0.0]),
            margin: Some(-0.01),
            lean: [0.0, 0.01],
            added: Some([0.01, -0.02, 0.03, 0.04]),
            com_in_support: Some([0.1, 0.09, 0.9]),
            com_velocity_in_support: Some([0.4, -0.1, 0.01]),
            com_planned: Some([0.11, 0.08, 0.91]),
            com_velocity_planned: Some([0.41, -0.12, 0.02]),
            faults: Fault::sum([Fault::InTheAir, Fault::DeadlineMissed]),
            missed: 4,
            compute_ns: 5,
        };
        let unknown = Report {
            zmp_in_support: None,
            zmp_planned: None,
            margin: None,
            added: None,
            com_in_support: None,
            com_velocity_in_support: None,
            com_planned: None,
            com_velocity_planned: None,
            ..known
        };
        for report in [known, unknown] {
            assert_eq!(ReportMessage::from(&report).checked(), Ok(report));
        }
        assert_eq!(Fault::in_sum(known.faults).collect::<Vec<_>>(), [Fault::InTheAir, Fault::DeadlineMissed]);
    }

    #[test]
    fn half_a_point_is_none() {
        let report = ReportMessage {
            tick: 0,
            time_ns: 0,
            mode: 2,
            support: 0,
            half_step: 0,
            progress: 0.0,
            speed: 1.0,
            turn: 0.0,
            extension: 0.0,
            zmp_in_support: [0.0, f64::NAN],
            zmp_planned: [0.0; 2],
            margin: 0.0,
            lean: [0.0; 2],
            added: [0.0; 4],
            com_in_support: [0.0; 3],
            com_velocity_in_support: [0.0; 3],
            com_planned: [0.0; 3],
            com_velocity_planned: [0.0; 3],
            faults: 0,
            missed: 0,
            compute_ns: 0,
        };
        assert_eq!(report.checked().unwrap_err().to_string(), "report: zmp_in_support is NaN; it must be finite");
        let text = ReportMessage { support: 2, ..report }.checked().unwrap_err().to_string();
        assert_eq!(text, "report: support is 2; known are 0 (right) 1 (left)");
    }
}
