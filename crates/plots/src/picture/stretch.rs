//! The part of a walk that detailed pictures show.

use crate::run_log::{PlantRow, RunLog};

/// Length of the part (s); more could not be distinguished.
const STRETCH: f64 = 4.0;
/// Time shown after a fall (s).
const AFTER_FALL: f64 = 0.4;

/// Start and end of the part that was asked for, else of some seconds in the middle of the walk, or up to its first
/// fall (s).
pub(super) fn stretch(log: &RunLog) -> (f64, f64) {
    let (Some(first), Some(last)) = (log.plant.first(), log.plant.last()) else { return (0.0, STRETCH) };
    if log.is_part {
        return (first.time, last.time);
    }
    let end = match log.falls().next() {
        Some(fall) => fall + AFTER_FALL,
        None => ((first.time + last.time + STRETCH) / 2.0).min(last.time),
    };
    ((end - STRETCH).max(first.time), end)
}

/// The plant's rows in a stretch of time.
pub(super) fn rows_between(log: &RunLog, (from, to): (f64, f64)) -> &[PlantRow] {
    let first = log.plant.partition_point(|row| row.time < from);
    let end = log.plant.partition_point(|row| row.time <= to);
    &log.plant[first..end]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn detailed_pictures_show_the_middle_of_a_walk_or_the_time_before_a_fall() {
        // 20 half-steps of 0.6 s and half of another.
        let mut log = synthetic::log(20, 0.0);
        let (from, to) = stretch(&log);
        assert!((from - 4.1).abs() < 1e-9 && (to - 8.1).abs() < 1e-9, "{from} to {to}");
        log.plant[100..].iter_mut().for_each(|row| row.fallen = true);
        let (from, to) = stretch(&log);
        assert!((from - 6.4).abs() < 1e-9 && (to - 10.4).abs() < 1e-9, "{from} to {to}");
        assert!(rows_between(&log, (from, to)).iter().any(|row| row.fallen));
    }
}
