//! Which rows of a long run are kept: evenly spaced ones, and all from which the run is measured, so that no number of
//! the summary depends on how long the run was.

use super::rows::{ControllerRow, PlantRow};
use super::{DriveRow, TimeWindow};

/// Most evenly spaced rows of controller and plant that are kept: those of five minutes at the usual rate. Less than
/// 150 MB.
const CONTROLLER_ROWS: u64 = 300_000;
const PLANT_ROWS: u64 = 100_000;
/// Most evenly spaced rows of the drives, which are larger. Less than 50 MB.
const DRIVE_ROWS: u64 = 40_000;
/// Longest window in which all rows are kept (s).
const WINDOW_MAX: f64 = 60.0;
/// Time around a fall, and in the middle of the run, in which all rows are kept (s): the pictures show it in detail.
const IN_DETAIL: f64 = 6.0;

/// What is known of a run after a first reading.
#[derive(Default)]
pub(super) struct Survey {
    controller_rows: u64,
    plant_rows: u64,
    drive_rows: u64,
    /// The part of the run that is asked for in detail.
    window: Option<TimeWindow>,
    half_steps: Vec<HalfStepSpan>,
    /// Times of the first and of the last row of the plant (s).
    span: Option<(f64, f64)>,
    first_fall: Option<f64>,
}

/// The rows of the controller in one half-step.
struct HalfStepSpan {
    index: u64,
    /// Numbers of the first and of the last row, and of those with the least margin at all and away from support
    /// changes.
    rows: [u64; 4],
    /// The two margins (m).
    margins: [f64; 2],
    /// Times of the first and of the last row (s).
    times: [f64; 2],
}

/// Decides row by row, in their order, what is kept.
pub(super) struct Thinner {
    survey: Survey,
    controller_row: u64,
    plant_row: u64,
    drive_row: u64,
    /// The half-step of the next row of the controller.
    half_step: usize,
    /// The times, in their order, whose next row of the plant is kept (s), and the first that is not yet passed.
    wanted: Vec<f64>,
    next_wanted: usize,
    was_fallen: bool,
}

impl Survey {
    /// A survey of a run of which a part is asked for in detail.
    pub(super) fn in_detail(window: Option<TimeWindow>) -> Self {
        Self { window: window.filter(|window| window.to - window.from <= WINDOW_MAX), ..Self::default() }
    }

    pub(super) fn note_drives(&mut self) {
        self.drive_rows += 1;
    }

    pub(super) fn note_controller(&mut self, row: &ControllerRow) {
        let number = self.controller_rows;
        self.controller_rows += 1;
        let margin = row.margin.unwrap_or(f64::INFINITY);
        let margins = [margin, if row.is_off_support_changes() && row.is_balancing() { margin } else { f64::INFINITY }];
        match self.half_steps.last_mut().filter(|span| span.index == row.half_step) {
            Some(span) => {
                (span.rows[1], span.times[1]) = (number, row.time);
                for (which, margin) in margins.into_iter().enumerate() {
                    if margin < span.margins[which] {
                        (span.rows[2 + which], span.margins[which]) = (number, margin);
                    }
                }
            }
            None => {
                let (index, time) = (row.half_step, row.time);
                self.half_steps.push(HalfStepSpan { index, rows: [number; 4], margins, times: [time; 2] });
            }
        }
    }

    pub(super) fn note_plant(&mut self, row: &PlantRow) {
        self.plant_rows += 1;
        self.span = Some((self.span.map_or(row.time, |(first, _)| first), row.time));
        if row.fallen {
            self.first_fall.get_or_insert(row.time);
        }
    }

    /// Whether all rows are kept.
    pub(super) fn is_short(&self) -> bool {
        self.controller_rows <= CONTROLLER_ROWS && self.plant_rows <= PLANT_ROWS
    }

    fn is_in_detail(&self, time: f64) -> bool {
        let middle = self.span.map(|(first, last)| (first + last) / 2.0);
        [self.first_fall, middle].into_iter().flatten().any(|shown| (time - shown).abs() < IN_DETAIL)
            || self.window.is_some_and(|window| window.contains(time))
    }
}

impl Thinner {
    pub(super) fn new(survey: Survey) -> Self {
        let first = survey.half_steps.first().map(|span| span.times[0]);
        let middles = survey.half_steps.iter().map(|span| (span.times[0] + span.times[1]) / 2.0);
        let wanted = first.into_iter().chain(middles).collect();
        Self {
            survey,
            controller_row: 0,
            plant_row: 0,
            drive_row: 0,
            half_step: 0,
            wanted,
            next_wanted: 0,
            was_fallen: false,
        }
    }

    pub(super) fn keeps_controller(&mut self, row: &ControllerRow) -> bool {
        let number = self.controller_row;
        self.controller_row += 1;
        let spans = &self.survey.half_steps;
        self.half_step += usize::from(spans.get(self.half_step).is_some_and(|span| span.rows[1] < number));
        number.is_multiple_of(self.survey.controller_rows.div_ceil(CONTROLLER_ROWS).max(1))
            || spans.get(self.half_step).is_some_and(|span| span.rows.contains(&number))
            || self.survey.is_in_detail(row.time)
    }

    pub(super) fn keeps_drives(&mut self, row: &DriveRow) -> bool {
        let number = self.drive_row;
        self.drive_row += 1;
        number.is_multiple_of(self.survey.drive_rows.div_ceil(DRIVE_ROWS).max(1)) || self.survey.is_in_detail(row.time)
    }

    pub(super) fn keeps_plant(&mut self, row: &PlantRow) -> bool {
        let number = self.plant_row;
        self.plant_row += 1;
        let is_wanted = self.wanted.get(self.next_wanted).is_some_and(|wanted| *wanted <= row.time);
        while self.wanted.get(self.next_wanted).is_some_and(|wanted| *wanted <= row.time) {
            self.next_wanted += 1;
        }
        let is_change = std::mem::replace(&mut self.was_fallen, row.fallen) != row.fallen;
        number.is_multiple_of(self.survey.plant_rows.div_ceil(PLANT_ROWS).max(1))
            || is_wanted
            || is_change
            || number + 1 == self.survey.plant_rows
            || self.survey.is_in_detail(row.time)
    }
}
