//! A part of a log.

use super::{RunLog, TimeWindow};

impl RunLog {
    /// The rows within a window. Measures remain those of the whole run where they are sums over all of it.
    #[must_use]
    pub fn within(&self, window: TimeWindow) -> RunLog {
        RunLog {
            plant: self.plant.iter().filter(|row| window.contains(row.time)).cloned().collect(),
            controller: self.controller.iter().filter(|row| window.contains(row.time)).cloned().collect(),
            drives: self.drives.iter().filter(|row| window.contains(row.time)).cloned().collect(),
            is_part: true,
            ..self.clone_without_rows()
        }
    }

    fn clone_without_rows(&self) -> RunLog {
        let (totals, notes) = (self.totals.clone(), self.notes.clone());
        RunLog { totals, notes, is_estimated: self.is_estimated, ..RunLog::default() }
    }

    /// Times of the first and of the last row of any kind (s); `None` without rows.
    pub fn span(&self) -> Option<(f64, f64)> {
        let plant = self.plant.first().zip(self.plant.last()).map(|(first, last)| (first.time, last.time));
        let controller =
            self.controller.first().zip(self.controller.last()).map(|(first, last)| (first.time, last.time));
        [plant, controller].into_iter().flatten().reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{log, mechanism};
    use super::*;

    #[test]
    fn a_window_has_the_rows_of_its_time() {
        let log = log(10, 0.0);
        let part = log.within(TimeWindow { from: 1.15, to: 2.0 });
        assert_eq!(part.span(), Some((log.plant[12].time, log.plant[20].time)));
        assert_eq!((part.plant.len(), part.controller.len()), (9, 9));
        assert_eq!(part.footprints(&mechanism()).len(), 2, "the feet that bore in two half-steps");
        assert_eq!(log.within(TimeWindow { from: 99.0, to: 100.0 }).span(), None);
    }
}
