//! When a fall of a recorded run became unavoidable.

use interface::{Capturability, Mode};
use scene::{RunNote, rounded};
use wire::ReportMessage;

/// Sees falls, and since when each was foreseen.
#[derive(Default)]
pub(crate) struct FallWatch {
    /// Since when the robot has been reported as falling (s), if it is.
    lost_since: Option<f64>,
    has_fallen: bool,
    /// The falls so far, in words, each at the moment from which on nothing could catch the robot.
    pub(crate) notes: Vec<RunNote>,
}

impl FallWatch {
    /// A report of the run at a time (s). Those with unknown codes are left out.
    pub(crate) fn take(&mut self, time: f64, message: &ReportMessage) {
        let Ok(report) = message.checked() else { return };
        let falls = report.mode == Mode::Fallen;
        if falls && !self.has_fallen {
            let since = self.lost_since.unwrap_or(time);
            let text = format!("from here on the robot could not be caught; it fell {:.2} s later", time - since);
            self.notes.push(RunNote { t: rounded([since])[0], kind: "fall", text });
        }
        self.has_fallen = falls;
        let is_lost = report.capturability == Some(Capturability::Lost);
        self.lost_since = is_lost.then(|| self.lost_since.unwrap_or(time));
    }
}

#[cfg(test)]
mod tests {
    use interface::{PeriodTiming, Report};

    use super::*;

    #[test]
    fn a_fall_is_noted_where_it_became_unavoidable() {
        use Capturability::{ByAnkles, BySteps, Lost};
        let mut watch = FallWatch::default();
        let judged = [ByAnkles, BySteps, Lost, BySteps, Lost, Lost, Lost];
        for (tick, capturability) in judged.into_iter().enumerate() {
            let mode = if tick < 6 { Mode::Walking } else { Mode::Fallen };
            let report = Report { capturability: Some(capturability), ..Report::of(mode) };
            let timing = PeriodTiming { tick: tick as u64, time_ns: 0, missed: 0, compute_ns: 0 };
            watch.take(tick as f64, &ReportMessage::new(&timing, &report));
        }
        let found: Vec<(f64, &str)> = watch.notes.iter().map(|note| (note.t, note.kind)).collect();
        assert_eq!(found, [(4.0, "fall")]);
        assert!(watch.notes[0].text.ends_with("it fell 2.00 s later"), "{}", watch.notes[0].text);
    }
}
