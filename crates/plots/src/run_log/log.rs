//! The log of a run, read from its recording.

use std::path::Path;

use config::Config;
use model::Mechanism;
use record::{RecordError, provenance_of};

use super::each_row::{RunRow, each_row};
use super::estimate::Estimator;
use super::rows::{ControllerRow, PlantRow};
use super::run_totals::RunTotals;
use super::thinner::{Survey, Thinner};
use super::{DriveRow, TimeWindow};

/// The log of a run. Of a run of more than some minutes only evenly spaced rows are kept, and those from which it is
/// measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunLog {
    /// Rows of the plant in order of time.
    pub plant: Vec<PlantRow>,
    /// Rows of the controller in order of time.
    pub controller: Vec<ControllerRow>,
    /// Rows of the drives in order of time.
    pub drives: Vec<DriveRow>,
    /// What is summed up over all rows of the run.
    pub totals: RunTotals,
    /// Whether it is a part of the run only.
    pub is_part: bool,
    /// Whether the plant's rows are what the controller estimates: nobody recorded the truth.
    pub is_estimated: bool,
    /// What the user must know about the recording, one text each: where it is truncated, what it lacks, and what was
    /// left out.
    pub notes: Vec<String>,
}

impl RunLog {
    /// Reads a run: a recording, or the folder that holds it. A truncated recording is read as far as it goes.
    ///
    /// Rows whose numbers are not finite, or absurd, are left out, and so are rows that are earlier than those before.
    ///
    /// # Errors
    /// There is no recording, or it has another version.
    pub fn read(run: &Path) -> Result<Self, RecordError> {
        Self::read_in_detail(run, None)
    }

    /// Reads a run likewise, with all rows in a window of time, if it is not too long for that.
    ///
    /// # Errors
    /// As above.
    pub fn read_in_detail(run: &Path, window: Option<TimeWindow>) -> Result<Self, RecordError> {
        // What is attached may be anything; who draws says so.
        let mechanism = provenance_of(run)?.file("mechanism.toml").map(|text| Mechanism::from_toml(text, ""));
        let mechanism = mechanism.and_then(Result::ok);
        let read = |estimator: Option<&Estimator<'_>>| Self::read_twice(run, window, mechanism.as_ref(), estimator);
        let mut log = read(None)?;
        if let (true, false, Some(mechanism)) = (log.plant.is_empty(), log.controller.is_empty(), &mechanism) {
            log = Self { is_estimated: true, ..read(Some(&Estimator::new(mechanism)))? };
        }
        log.notes.extend(log.missing_part());
        Ok(log)
    }

    /// Reads a run first to survey it, and then what is kept of it.
    fn read_twice(
        run: &Path,
        window: Option<TimeWindow>,
        mechanism: Option<&Mechanism>,
        estimator: Option<&Estimator<'_>>,
    ) -> Result<Self, RecordError> {
        let mut survey = Survey::in_detail(window);
        let (mut drawable, mut totals) = (Drawable::default(), RunTotals::default());
        let notes = each_row(run, mechanism, estimator, |row| match drawable.filter(row) {
            Some(RunRow::Plant(row)) => {
                survey.note_plant(&row);
                totals.note_plant(&row);
            }
            Some(RunRow::Controller(row)) => {
                survey.note_controller(&row);
                totals.note_controller(&row);
            }
            Some(RunRow::Drives(row)) => {
                survey.note_drives();
                mechanism.iter().for_each(|mechanism| totals.note_drives(mechanism, &row));
            }
            None => {}
        })?;
        let mut log = Self { notes, totals, ..Self::default() };
        log.notes.extend(drawable.note());
        let is_short = survey.is_short();
        let (mut thinner, mut drawable) = (Thinner::new(survey), Drawable::default());
        each_row(run, mechanism, estimator, |row| match drawable.filter(row) {
            Some(RunRow::Plant(row)) if is_short || thinner.keeps_plant(&row) => log.plant.push(row),
            Some(RunRow::Controller(row)) if is_short || thinner.keeps_controller(&row) => log.controller.push(row),
            Some(RunRow::Drives(row)) if thinner.keeps_drives(&row) => log.drives.push(row),
            _ => {}
        })?;
        Ok(log)
    }

    /// What cannot be drawn because one of the processes recorded nothing.
    fn missing_part(&self) -> Option<String> {
        let text = match (self.is_estimated || self.plant.is_empty(), self.controller.is_empty()) {
            (true, false) if self.is_estimated => {
                "it holds no states of the plant (/truth): the robot is drawn where the controller estimates it, on a \
                 plane"
            }
            (true, false) => "it holds no states of the plant (/truth): only what the controller reports can be drawn",
            (false, true) => {
                "it holds no reports of the controller (/reports): only the robot, its footprints and the ground's \
                 forces can be drawn"
            }
            _ => return None,
        };
        Some(format!(
            "{text}. If both were recorded: give controller and plant the same --out, or put both files into one folder"
        ))
    }

    /// What is added to the title of a picture of the robot: whether it is an estimate.
    pub(crate) fn estimated_text(&self) -> &'static str {
        if self.is_estimated { ", as the controller estimates" } else { "" }
    }

    /// The plant's row at a time (s) or the first one after it; `None` after the end.
    pub fn plant_at(&self, time: f64) -> Option<&PlantRow> {
        self.plant.get(self.plant.partition_point(|row| row.time < time))
    }
}

/// Passes on the rows that can be drawn.
#[derive(Default)]
struct Drawable {
    left_out: u64,
    /// Time of the first row that was left out (s).
    since: f64,
    /// Times of the last rows of plant, controller and drives (s).
    last: [f64; 3],
}

impl Drawable {
    fn filter(&mut self, row: RunRow) -> Option<RunRow> {
        let (time, which) = match &row {
            RunRow::Plant(row) => (row.time, 0),
            RunRow::Controller(row) => (row.time, 1),
            RunRow::Drives(row) => (row.time, 2),
        };
        let row = match row {
            RunRow::Plant(row) => row.plausible().map(RunRow::Plant),
            RunRow::Controller(row) => row.plausible().map(RunRow::Controller),
            RunRow::Drives(row) => Some(RunRow::Drives(row)),
        };
        let row = row.filter(|_| time >= self.last[which]);
        if row.is_some() {
            self.last[which] = time;
        } else {
            if self.left_out == 0 {
                self.since = time;
            }
            self.left_out += 1;
        }
        row
    }

    fn note(&self) -> Option<String> {
        let Self { left_out, since, .. } = self;
        (*left_out > 0).then(|| {
            format!(
                "{left_out} recorded states from {since:.3} s on cannot be drawn: numbers are not finite, or absurd"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;
    use record::{Provenance, RecordingWriter, RunEvent, TruthMessage};
    use wire::{ReportMessage, WireLayout};

    use super::super::synthetic::{log, mechanism};
    use super::super::write_csv;
    use super::*;
    use crate::picture::{FloorHeights, RunPicture, of_run};

    /// A message of zeros and some numbers, each anything or absurd.
    fn message<M: WireLayout>(numbers: &[(f64, u64)]) -> M {
        const ABSURD: [f64; 8] = [f64::NAN, f64::INFINITY, 1e308, -1e300, 5e-324, 1.0, -3.0, 1e5];
        let mut bytes = vec![0; M::layout().size];
        for (place, bits) in numbers {
            let at = (place * (bytes.len() / 8) as f64) as usize * 8;
            let bits = ABSURD.get(*bits as usize % 16).map_or(*bits, |number| number.to_bits());
            bytes[at..at + 8].copy_from_slice(&bits.to_le_bytes());
        }
        M::decode(&bytes).expect("as long as its layout says")
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: cases(), ..ProptestConfig::default() })]

        #[test]
        fn a_run_of_any_numbers_is_measured_and_drawn(
            rows in vec((vec((0.0..1.0, any::<u64>()), 0..4), vec((0.0..1.0, any::<u64>()), 0..4), 0..9_u64), 1..12),
            long in any::<bool>(),
        ) {
            let folder = tempfile::tempdir().unwrap();
            let file = folder.path().join("run.mcap");
            let mut writer = RecordingWriter::create(&file, &Provenance::default()).unwrap();
            let mut time_ns = 0;
            for (number, (truth, report, step)) in (0..).zip(&rows) {
                let mut truth: TruthMessage = message(truth);
                // Else hardly any is drawn.
                truth.right_sole[3] = if number % 5 == 4 { truth.right_sole[3] } else { 1.0 };
                time_ns = u64::saturating_add(time_ns, if long { step << 58 } else { step * 100_000_000 });
                for event in [RunEvent::Truth(truth), RunEvent::Report(message::<ReportMessage>(report))] {
                    writer.write(time_ns, number, &event).unwrap();
                }
            }
            writer.finish().unwrap();
            let (log, mechanism) = (RunLog::read(&file).unwrap(), mechanism());
            log.measures(&mechanism);
            for RunPicture { file, svg, .. } in of_run(&log, &mechanism, &FloorHeights::PLANE).drawn {
                assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{file}");
                assert!(svg.len() < 4 << 20, "{file} has {} bytes", svg.len());
            }
            write_csv(&file, folder.path(), Some(&mechanism)).unwrap();
        }
    }

    /// Drawing takes a while; more where the environment asks for it.
    fn cases() -> u32 {
        std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(40)
    }

    #[test]
    fn a_long_run_has_the_measures_of_all_its_rows() {
        // Longer than all that is kept, with a dip of the margin and a fall that no even spacing would meet.
        let mut whole = log(80_000, 0.001);
        whole.controller[300_007].margin = Some(-0.0123);
        let fell = whole.plant.len() - 5_003;
        whole.plant[fell..].iter_mut().for_each(|row| row.fallen = true);
        let mut survey = Survey::default();
        whole.controller.iter().for_each(|row| survey.note_controller(row));
        whole.plant.iter().for_each(|row| survey.note_plant(row));
        assert!(!survey.is_short());
        let mut thinner = Thinner::new(survey);
        let thinned = RunLog {
            controller: whole.controller.iter().filter(|row| thinner.keeps_controller(row)).cloned().collect(),
            plant: whole.plant.iter().filter(|row| thinner.keeps_plant(row)).cloned().collect(),
            totals: whole.totals.clone(),
            ..RunLog::default()
        };
        assert!(thinned.controller.len() < whole.controller.len() && thinned.plant.len() < whole.plant.len() * 2 / 3);
        assert_eq!(thinned.measures(&mechanism()), whole.measures(&mechanism()));
    }
}
