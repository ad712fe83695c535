//! Report, controller → anyone: the state of the controller after a period.

use iceoryx2::prelude::ZeroCopySend;
use interface::{
    AddedAngles, Capturability, DestinationProgress, Faults, HalfStep, Odometry, PeriodTiming, Report, StateEstimate,
    WalkPose, WalkVelocity,
};
use model::{ComState, Side};

use super::MessageFault;
use super::fault::Check;

/// A [`Report`] as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Report.v5")]
#[repr(C)]
pub struct ReportMessage {
    /// Periods since the controller started.
    pub tick: u64,
    /// When the period began, `CLOCK_MONOTONIC` (ns).
    pub time_ns: u64,
    /// A [`Mode`](interface::Mode).
    pub mode: u32,
    /// The support foot: 0 right, 1 left.
    pub support: u32,
    /// Half-steps finished, which is the number of the present one counted from 0.
    pub half_step: u64,
    /// How much of the present half-step is done, 0 to 1.
    pub progress: f64,
    /// `c` at this instant; a change of speed passes over a ramp.
    pub speed: f64,
    /// `α` in force (rad).
    pub turn: f64,
    /// `β` in force (rad).
    pub extension: f64,
    /// `γ` in force (rad).
    pub sidestep: f64,
    /// Measured ZMP, x and y in the support foot's sole frame (m); NaN when the feet carry too little.
    pub zmp_in_support: [f64; 2],
    /// Planned ZMP, likewise (m); NaN when there is no plan.
    pub zmp_planned: [f64; 2],
    /// Of the measured ZMP to the edge of the support polygon (m), negative outside; NaN when there is none.
    pub margin: f64,
    /// Feedback angles added at the support ankle: roll, pitch (rad).
    pub lean: [f64; 2],
    /// What the plan adds to the plain sum of the modifications: support ankle roll and pitch, waist roll and pitch
    /// (rad); NaN when it is not known.
    pub added: [f64; 4],
    /// Measured centre of mass in the support foot's sole frame, made level (m); NaN when it is not known.
    pub com_in_support: [f64; 3],
    /// Its velocity, likewise (m/s).
    pub com_velocity_in_support: [f64; 3],
    /// Planned centre of mass, likewise (m); NaN when there is no plan.
    pub com_planned: [f64; 3],
    /// Its velocity, likewise (m/s).
    pub com_velocity_planned: [f64; 3],
    /// The middle between both soles in the walk frame, as estimated: x, y (m), heading (rad).
    pub pose: [f64; 3],
    /// Mean velocity over the last full step, seen from the robot: ahead, left (m/s), turning to the left (rad/s).
    pub walk_velocity: [f64; 3],
    /// The sole of the support foot in the walk frame: x, y (m), heading (rad).
    pub support_sole: [f64; 3],
    /// Where the other foot is to land next, likewise.
    pub landing: [f64; 3],
    /// Where the support foot is to land after it, likewise.
    pub landing_after: [f64; 3],
    /// Whether there is a destination: 0 no, 1 yes.
    pub destination: u32,
    /// Way-points or footsteps still to come; 0 once the robot has arrived.
    pub destination_places_left: u32,
    /// From the pose to the last place, as the crow flies (m).
    pub destination_distance: f64,
    /// Heading of the last place against the robot's (rad), within ±π; 0 if any will do.
    pub destination_turn: f64,
    /// A [`Capturability`](interface::Capturability); 0 while no plan is followed.
    pub capturability: u32,
    /// Which feet touch the ground: 1 the right one, 2 the left one, 3 both.
    pub contact: u32,
    /// Horizontal force by which something pushes or pulls the robot, as estimated: x and y in the support foot's sole
    /// frame (N).
    pub external_force: [f64; 2],
    /// By how much the centre of mass seems to be farther ahead and to the left than it is, likewise (m).
    pub com_offset: [f64; 2],
    /// Bias of the gyro about the axes of the trunk, as estimated (rad/s).
    pub gyro_bias: [f64; 3],
    /// The [`Faults`] present.
    pub faults: u32,
    /// Deadlines missed since the start.
    pub missed: u32,
    /// Computing time of the period (ns).
    pub compute_ns: u64,
}

impl ReportMessage {
    /// The report of a period.
    pub fn new(timing: &PeriodTiming, report: &Report) -> Self {
        let com = |com: Option<ComState>| {
            com.map_or([[f64::NAN; 3]; 2], |ComState { position, velocity }| [position.into(), velocity.into()])
        };
        let DestinationProgress { places_left, distance, turn } = report.destination.unwrap_or_default();
        let [com_planned, com_velocity_planned] = com(report.com_planned);
        let [com_in_support, com_velocity_in_support] = com(report.com_measured);
        Self {
            tick: timing.tick,
            time_ns: timing.time_ns,
            mode: report.mode.code(),
            support: match report.half_step.support {
                Side::Right => 0,
                Side::Left => 1,
            },
            half_step: report.half_step.index,
            progress: report.half_step.progress,
            speed: report.speed,
            turn: report.turn,
            extension: report.extension,
            sidestep: report.sidestep,
            zmp_in_support: report.zmp_in_support.map_or([f64::NAN; 2], Into::into),
            zmp_planned: report.zmp_planned.map_or([f64::NAN; 2], Into::into),
            margin: report.margin.unwrap_or(f64::NAN),
            lean: report.lean.into(),
            added: report
                .added
                .map_or([f64::NAN; 4], |AddedAngles { ankle, waist }| [ankle.x, ankle.y, waist.x, waist.y]),
            com_in_support,
            com_velocity_in_support,
            com_planned,
            com_velocity_planned,
            pose: pose_numbers(&report.odometry.pose),
            walk_velocity: [
                report.odometry.velocity.ahead,
                report.odometry.velocity.left,
                report.odometry.velocity.turn,
            ],
            support_sole: pose_numbers(&report.odometry.support_sole),
            landing: pose_numbers(&report.odometry.landings[0]),
            landing_after: pose_numbers(&report.odometry.landings[1]),
            destination: report.destination.is_some().into(),
            destination_places_left: places_left,
            destination_distance: distance,
            destination_turn: turn,
            capturability: report.capturability.map_or(0, Capturability::code),
            contact: [1, 2]
                .into_iter()
                .zip(report.estimate.contact)
                .filter(|(_, touches)| *touches)
                .map(|(bit, _)| bit)
                .sum(),
            external_force: report.estimate.external_force.into(),
            com_offset: report.estimate.com_offset.into(),
            gyro_bias: report.estimate.gyro_bias.into(),
            faults: report.faults.0,
            missed: u32::try_from(timing.missed).unwrap_or(u32::MAX),
            compute_ns: timing.compute_ns,
        }
    }

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
        let com = |name, position: &[f64; 3], velocity: &[f64; 3]| {
            let (position, velocity) = (known(&check, name, position)?, known(&check, name, velocity)?);
            let state = |(position, velocity): ([f64; 3], [f64; 3])| ComState {
                position: position.into(),
                velocity: velocity.into(),
            };
            Ok(position.zip(velocity).map(state))
        };
        let added = known(&check, "added", &self.added)?.map(|[ankle_roll, ankle_pitch, waist_roll, waist_pitch]| {
            AddedAngles { ankle: [ankle_roll, ankle_pitch].into(), waist: [waist_roll, waist_pitch].into() }
        });
        Ok(Report {
            mode: check.code("mode", self.mode)?,
            half_step: HalfStep { index: self.half_step, support, progress: check.number("progress", self.progress)? },
            speed: check.number("speed", self.speed)?,
            turn: check.number("turn", self.turn)?,
            extension: check.number("extension", self.extension)?,
            sidestep: check.number("sidestep", self.sidestep)?,
            zmp_in_support: known(&check, "zmp_in_support", &self.zmp_in_support)?.map(Into::into),
            zmp_planned: known(&check, "zmp_planned", &self.zmp_planned)?.map(Into::into),
            margin: if self.margin.is_nan() { None } else { Some(check.number("margin", self.margin)?) },
            lean: check.numbers("lean", &self.lean)?.into(),
            added,
            com_planned: com("com_planned", &self.com_planned, &self.com_velocity_planned)?,
            com_measured: com("com_in_support", &self.com_in_support, &self.com_velocity_in_support)?,
            capturability: match self.capturability {
                0 => None,
                code => Some(check.code("capturability", code)?),
            },
            estimate: StateEstimate {
                contact: [1, 2].map(|bit| self.contact & bit != 0),
                external_force: check.numbers("external_force", &self.external_force)?.into(),
                com_offset: check.numbers("com_offset", &self.com_offset)?.into(),
                gyro_bias: check.numbers("gyro_bias", &self.gyro_bias)?.into(),
            },
            odometry: self.odometry(&check)?,
            destination: self.destination_progress(&check)?,
            faults: Faults(self.faults),
        })
    }

    fn odometry(&self, check: &Check) -> Result<Odometry, MessageFault> {
        let pose =
            |field, numbers: &[f64; 3]| check.numbers(field, numbers).map(|[x, y, heading]| WalkPose { x, y, heading });
        let [ahead, left, turn] = check.numbers("walk_velocity", &self.walk_velocity)?;
        Ok(Odometry {
            pose: pose("pose", &self.pose)?,
            velocity: WalkVelocity { ahead, left, turn },
            support_sole: pose("support_sole", &self.support_sole)?,
            landings: [pose("landing", &self.landing)?, pose("landing_after", &self.landing_after)?],
        })
    }

    fn destination_progress(&self, check: &Check) -> Result<Option<DestinationProgress>, MessageFault> {
        match self.destination {
            0 => Ok(None),
            1 => Ok(Some(DestinationProgress {
                places_left: self.destination_places_left,
                distance: check.not_negative("destination_distance", self.destination_distance)?,
                turn: check.number("destination_turn", self.destination_turn)?,
            })),
            value => {
                let (field, known) = ("destination", "0 (no) 1 (yes)");
                Err(MessageFault::UnknownCode { message: check.0, field, value, known })
            }
        }
    }

    /// How the control loop kept its time in the period.
    pub fn timing(&self) -> PeriodTiming {
        let Self { tick, time_ns, missed, compute_ns, .. } = *self;
        PeriodTiming { tick, time_ns, missed: missed.into(), compute_ns }
    }
}

fn pose_numbers(pose: &WalkPose) -> [f64; 3] {
    [pose.x, pose.y, pose.heading]
}

/// Numbers that are all there, or none of them.
fn known<const N: usize>(
    check: &Check,
    field: &'static str,
    values: &[f64; N],
) -> Result<Option<[f64; N]>, MessageFault> {
    if values.iter().all(|value| value.is_nan()) { Ok(None) } else { check.numbers(field, values).map(Some) }
}

#[cfg(test)]
mod tests {
    use interface::{Fault, Mode};

    use super::*;

    #[test]
    fn a_report_survives_its_message() {
        let com = |y: f64| Some(ComState { position: [0.1, y, 0.9].into(), velocity: [0.4, -0.1, 0.01].into() });
        let known = Report {
            mode: Mode::Walking,
            half_step: HalfStep { index: 3, support: Side::Left, progress: 0.5 },
            speed: 1.0,
            turn: 0.1,
            extension: 0.0,
            sidestep: -0.1,
            zmp_in_support: Some([0.01, -0.02].into()),
            zmp_planned: Some([0.0, 0.0].into()),
            margin: Some(-0.01),
            lean: [0.0, 0.01].into(),
            added: Some(AddedAngles { ankle: [0.01, -0.02].into(), waist: [0.03, 0.04].into() }),
            com_planned: com(0.09),
            com_measured: com(0.08),
            odometry: Odometry {
                pose: WalkPose { x: 1.0, y: 2.0, heading: 3.0 },
                velocity: WalkVelocity { ahead: 0.4, left: -0.1, turn: 0.2 },
                support_sole: WalkPose { x: 1.1, y: 2.1, heading: 3.1 },
                landings: [WalkPose { x: 1.2, y: 2.2, heading: 3.2 }, WalkPose { x: 1.3, y: 2.3, heading: 3.3 }],
            },
            capturability: Some(Capturability::BySteps),
            estimate: StateEstimate {
                contact: [true, false],
                external_force: [12.0, -7.0].into(),
                com_offset: [0.01, -0.002].into(),
                gyro_bias: [0.01, 0.02, -0.03].into(),
            },
            destination: Some(DestinationProgress { places_left: 3, distance: 1.2, turn: -0.5 }),
            faults: [Fault::InTheAir, Fault::DeadlineMissed].into_iter().collect(),
        };
        let unknown = Report {
            zmp_in_support: None,
            zmp_planned: None,
            margin: None,
            added: None,
            com_planned: None,
            com_measured: None,
            capturability: None,
            destination: None,
            ..known
        };
        let timing = PeriodTiming { tick: 1, time_ns: 2, missed: 4, compute_ns: 5 };
        for report in [known, unknown] {
            let message = ReportMessage::new(&timing, &report);
            assert_eq!((message.checked(), message.timing()), (Ok(report), timing));
        }
    }

    #[test]
    fn half_a_point_is_refused() {
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
            sidestep: 0.0,
            zmp_in_support: [0.0, f64::NAN],
            zmp_planned: [0.0; 2],
            margin: 0.0,
            lean: [0.0; 2],
            added: [0.0; 4],
            com_in_support: [0.0; 3],
            com_velocity_in_support: [0.0; 3],
            com_planned: [0.0; 3],
            com_velocity_planned: [0.0; 3],
            pose: [0.0; 3],
            walk_velocity: [0.0; 3],
            support_sole: [0.0; 3],
            landing: [0.0; 3],
            landing_after: [0.0; 3],
            destination: 0,
            destination_places_left: 0,
            destination_distance: 0.0,
            destination_turn: 0.0,
            capturability: 0,
            contact: 3,
            external_force: [0.0; 2],
            com_offset: [0.0; 2],
            gyro_bias: [0.0; 3],
            faults: 0,
            missed: 0,
            compute_ns: 0,
        };
        assert_eq!(report.checked().unwrap_err().to_string(), "report: zmp_in_support is NaN; it must be finite");
        let text = ReportMessage { support: 2, ..report }.checked().unwrap_err().to_string();
        assert_eq!(text, "report: support is 2; known are 0 (right) 1 (left)");
        let whole = ReportMessage { zmp_in_support: [0.0; 2], destination_distance: f64::NAN, ..report };
        assert_eq!(whole.checked().map(|report| report.destination), Ok(None));
        let text = ReportMessage { destination: 1, ..whole }.checked().unwrap_err().to_string();
        assert_eq!(text, "report: destination_distance is NaN; it must be finite");
        let text = ReportMessage { destination: 2, ..whole }.checked().unwrap_err().to_string();
        assert_eq!(text, "report: destination is 2; known are 0 (no) 1 (yes)");
    }
}
