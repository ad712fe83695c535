//! What the controller's reports tell: the newest one, and what is kept of those before.

use std::collections::VecDeque;

use interface::Rate;
use interface::{Fault, Faults, Report};
use wire::ReportMessage;

/// How long the least margin is kept (s).
const MARGIN_KEPT: f64 = 2.0;
/// In how many parts (-).
const MARGIN_PARTS: f64 = 20.0;
/// How long a fault is shown (s): most last for a period only.
const FAULT_SHOWN: f64 = 2.0;
/// Distance between two kept points of the path (m), and how many are kept.
const PATH_STEP: f64 = 0.03;
const PATH_MAX: usize = 4000;

/// What is known of a robot by its controller's reports.
#[derive(Clone, Debug)]
pub(crate) struct Observed {
    rate: Rate,
    /// The controller's time (s), and its newest report.
    newest: Option<(f64, Report)>,
    missed: u64,
    /// The least margin (m) of each part of the last seconds, with the number of the part.
    margins: VecDeque<(u64, f64)>,
    /// The faults of the last seconds, each with when it was last seen (s).
    faults: Vec<(Fault, f64)>,
    /// Where the robot was (m), the oldest first.
    path: VecDeque<[f64; 2]>,
}

impl Observed {
    /// Nothing yet, of a controller with this rate.
    pub(crate) fn new(rate: Rate) -> Self {
        let (margins, path) = (VecDeque::new(), VecDeque::new());
        Self { rate, newest: None, missed: 0, margins, faults: Vec::new(), path }
    }

    /// Takes in a report. One that cannot be understood counts as lost.
    pub(crate) fn take(&mut self, message: &ReportMessage) {
        let Ok(report) = message.checked() else { return };
        let time = self.rate.time(message.tick);
        if self.newest.as_ref().is_some_and(|(before, _)| time < *before) {
            // The controller was restarted, and the walk begins anew.
            *self = Self::new(self.rate);
        }
        self.missed = message.timing().missed;
        let part = (time * MARGIN_PARTS / MARGIN_KEPT) as u64;
        if let Some(margin) = report.margin {
            match self.margins.back_mut() {
                Some((last, least)) if *last == part => *least = least.min(margin),
                _ => self.margins.push_back((part, margin)),
            }
        }
        self.margins.retain(|(kept, _)| kept + MARGIN_PARTS as u64 > part);
        self.note_faults(report.faults, time);
        let pose = report.odometry.pose;
        let is_near = |last: &[f64; 2]| (pose.x - last[0]).hypot(pose.y - last[1]) < PATH_STEP;
        if !self.path.back().is_some_and(is_near) {
            self.path.push_back([pose.x, pose.y]);
            if self.path.len() > PATH_MAX {
                self.path.pop_front();
            }
        }
        self.newest = Some((time, report));
    }

    fn note_faults(&mut self, faults: Faults, time: f64) {
        self.faults.retain(|(fault, seen)| !faults.contains(*fault) && time - seen < FAULT_SHOWN);
        self.faults.extend(faults.iter().map(|fault| (fault, time)));
    }

    /// The newest report, with the controller's time (s).
    pub(crate) fn newest(&self) -> Option<&(f64, Report)> {
        self.newest.as_ref()
    }

    /// Control periods per second.
    pub(crate) fn rate(&self) -> Rate {
        self.rate
    }

    /// Deadlines missed since the controller started.
    pub(crate) fn missed(&self) -> u64 {
        self.missed
    }

    /// The least margin of the last two seconds (m).
    pub(crate) fn least_margin(&self) -> Option<f64> {
        self.margins.iter().map(|(_, margin)| *margin).reduce(f64::min)
    }

    /// The faults of the last two seconds.
    pub(crate) fn faults(&self) -> impl Iterator<Item = Fault> {
        self.faults.iter().map(|(fault, _)| *fault)
    }

    /// Where the robot was (m), the oldest first.
    pub(crate) fn path(&self) -> impl Iterator<Item = [f64; 2]> {
        self.path.iter().copied()
    }

    /// Height of the centre of mass over the support sole (m), if it is known.
    pub(crate) fn com_height(&self) -> Option<f64> {
        self.newest
            .as_ref()
            .and_then(|(_, report)| report.com_planned.or(report.com_measured))
            .map(|com| com.position.z)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use interface::{HalfStep, Mode, Odometry, PeriodTiming, WalkPose, WalkVelocity};

    use super::*;

    /// A report of a robot that walks ahead.
    pub(crate) fn report(tick: u64, margin: f64, faults: Faults) -> ReportMessage {
        let x = tick as f64 * 0.3e-3;
        let pose = WalkPose { x, y: -0.41, heading: 0.2 };
        let velocity = WalkVelocity { ahead: 0.3, left: -0.01, turn: 0.1 };
        let report = Report {
            half_step: HalfStep { index: 34, ..HalfStep::first(model::Side::Left) },
            turn: 0.1,
            sidestep: -0.02,
            margin: Some(margin),
            odometry: Odometry { pose, velocity, support_sole: pose, landings: [pose; 2] },
            faults,
            ..Report::of(Mode::Walking)
        };
        ReportMessage::new(&PeriodTiming { tick, time_ns: 0, missed: 3, compute_ns: 0 }, &report)
    }

    #[test]
    fn the_least_margin_and_the_faults_are_those_of_the_last_two_seconds() {
        let mut observed = Observed::new(Rate::clamped(1000));
        let fault: Faults = [Fault::InTheAir].into_iter().collect();
        for tick in 0..4000 {
            let (margin, faults) = if tick == 1000 { (0.01, fault) } else { (0.03, Faults::default()) };
            observed.take(&report(tick, margin, faults));
            let is_recent = (1000..2900).contains(&tick);
            if is_recent || !(900..3100).contains(&tick) {
                assert_eq!(observed.least_margin(), Some(if is_recent { 0.01 } else { 0.03 }), "tick {tick}");
                assert_eq!(observed.faults().count(), usize::from(is_recent), "tick {tick}");
            }
        }
        assert_eq!(observed.path().count(), 40, "of 1.2 m");
    }

    #[test]
    fn a_controller_that_begins_anew_has_another_path() {
        let mut observed = Observed::new(Rate::clamped(1000));
        (0..2000).for_each(|tick| observed.take(&report(tick, 0.03, Faults::default())));
        observed.take(&report(0, 0.03, Faults::default()));
        assert_eq!((observed.path().count(), observed.newest().map(|(time, _)| *time)), (1, Some(0.0)));
    }
}
