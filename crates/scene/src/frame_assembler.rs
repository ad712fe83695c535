//! Makes frames of the reports and measurements of a walk, live or recorded.

use dynamics::Tree;
use interface::{Faults, Measurement, PeriodTiming, Rate, Report};
use model::{LegReach, Mechanism};
use nalgebra::Isometry3;

use crate::floor_cells::world_in_walk;
use crate::placement::right_sole_in_walk;
use crate::rounded::rounded;
use crate::view_frame::{SinceLastFrame, ViewFrame};

/// Takes every report and measurement, and makes a frame of them now and then. A fault or a small margin between two
/// frames is seen in the next one.
#[derive(Clone, Debug)]
pub struct FrameAssembler {
    mechanism: Mechanism,
    tree: Tree,
    scale: f64,
    rate: Rate,
    is_lockstep: bool,
    last: Option<(PeriodTiming, Report)>,
    since: SinceLastFrame,
}

impl FrameAssembler {
    /// For a robot at a rate; in lockstep periods have no length by the wall clock.
    pub fn new(mechanism: &Mechanism, rate: Rate, is_lockstep: bool) -> Self {
        Self {
            mechanism: mechanism.clone(),
            tree: Tree::new(mechanism),
            scale: LegReach::of(mechanism).scale(),
            rate,
            is_lockstep,
            last: None,
            since: SinceLastFrame::default(),
        }
    }

    /// Takes the next report, with how its period was kept.
    pub fn take(&mut self, timing: &PeriodTiming, report: &Report) {
        let since = &mut self.since;
        if let Some(margin) = report.margin {
            since.margin = Some(since.margin.map_or(margin, |least| least.min(margin)));
        }
        since.faults = Faults(since.faults.0 | report.faults.0);
        since.compute_ns = since.compute_ns.max(timing.compute_ns);
        // The period after a lost report, or of another controller, has nothing to be compared with.
        let last = self.last.as_ref().filter(|(last, _)| !self.is_lockstep && timing.tick == last.tick + 1);
        if let Some((last, _)) = last {
            let period_ns = (self.rate.period_s() * 1e9).round() as u64;
            let lasted = timing.time_ns.saturating_sub(last.time_ns);
            since.jitter_ns = since.jitter_ns.max(lasted.abs_diff(period_ns));
        }
        self.last = Some((*timing, *report));
    }

    /// The frame of the newest report with a measurement; `None` if there was no report yet, or the measurement makes
    /// no sense.
    ///
    /// * `true_sole` – the right sole in the world, if that is known
    pub fn frame(&mut self, measurement: &Measurement, true_sole: Option<&Isometry3<f64>>) -> Option<ViewFrame> {
        let (timing, report) = self.last?;
        let finite = measurement.angles.0.iter().chain(measurement.orientation.coords.iter()).all(|n| n.is_finite());
        if !finite {
            return None;
        }
        let sole = right_sole_in_walk(&self.mechanism, &self.tree, self.scale, &report, measurement);
        let since = std::mem::take(&mut self.since);
        let time = self.rate.time(timing.tick);
        let floor = true_sole.map(|truly| rounded(world_in_walk(&sole, truly)));
        Some(ViewFrame { floor, ..ViewFrame::new(time, &report, measurement, &sole, &since, timing.missed) })
    }
}

#[cfg(test)]
mod tests {
    use interface::Fault;

    use super::*;
    use crate::tests::{measured, mechanism, reported};

    /// The report of a tick that began so late (ns).
    fn report(tick: u64, late_ns: u64, margin: f64, faults: &[Fault]) -> (PeriodTiming, Report) {
        let timing = PeriodTiming { tick, time_ns: tick * 1_000_000 + late_ns, missed: 0, compute_ns: 1000 * tick };
        let faults: Faults = faults.iter().copied().collect();
        (timing, Report { margin: Some(margin), faults, ..reported() })
    }

    #[test]
    fn what_happens_between_two_frames_is_seen_in_the_second() {
        let mut assembler = FrameAssembler::new(&mechanism(), Rate::clamped(1000), false);
        assert_eq!(assembler.frame(&measured(), None), None, "there was no report");
        for (timing, report) in
            [report(5, 0, 0.03, &[]), report(6, 400, 0.01, &[Fault::RateLimited]), report(7, 0, 0.02, &[])]
        {
            assembler.take(&timing, &report);
        }
        let frame = assembler.frame(&measured(), None).expect("a frame");
        assert_eq!((frame.t, frame.margin, frame.faults), (0.007, Some(0.01), vec![Fault::RateLimited.text()]));
        assert_eq!((frame.compute_us, frame.jitter_us), (7.0, 0.4));
        // The period after a lost report has nothing to be compared with.
        let (timing, last) = report(9, 900, 0.03, &[]);
        assembler.take(&timing, &last);
        let frame = assembler.frame(&measured(), None).expect("a frame");
        assert_eq!((frame.margin, frame.faults.len(), frame.jitter_us), (Some(0.03), 0, 0.0));
    }

    #[test]
    fn a_measurement_of_no_numbers_gives_no_frame() {
        let mut assembler = FrameAssembler::new(&mechanism(), Rate::clamped(1000), true);
        let (timing, first) = report(1, 0, 0.03, &[]);
        assembler.take(&timing, &first);
        let mut broken = measured();
        broken.angles.0[7] = f64::NAN;
        assert_eq!(assembler.frame(&broken, None), None);
        assert!(assembler.frame(&measured(), None).is_some());
    }
}
