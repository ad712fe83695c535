//! Plots of a run and of the nominal half-step as SVG. Each is a function that returns the file's text.
//!
//! One colour has one meaning in all of them, see [`colours`]: right blue, left orange, the zero-moment point black,
//! the centre of mass green, the divergent component of motion and its feedback purple, planned values grey or pale, a
//! fall red.

mod balance_over_time;
pub mod chart;
pub mod colours;
mod compensation_over_time;
mod fall_marks;
mod footprints;
mod margin_over_time;
mod nominal_footprints;
mod nominal_stick;
pub mod sole_outline;
mod stick_walk;
mod sticks;
mod stretch;
mod thinning;
mod time_panel;
mod zmp_in_sole;
mod zmp_over_time;

use model::Mechanism;

pub use balance_over_time::balance_over_time;
pub use compensation_over_time::compensation_over_time;
pub use footprints::footprints;
pub use margin_over_time::margin_over_time;
pub use nominal_footprints::nominal_footprints;
pub use nominal_stick::nominal_stick;
pub use stick_walk::stick_walk;
pub use zmp_in_sole::zmp_in_sole;
pub use zmp_over_time::zmp_over_time;

use crate::run_log::RunLog;

/// Draws all pictures of a run. Returns the names and texts of the files.
pub fn of_run(log: &RunLog, mechanism: &Mechanism) -> [(&'static str, String); 7] {
    [
        ("footprints.svg", footprints(log, mechanism)),
        ("balance_over_time.svg", balance_over_time(log, mechanism)),
        ("margin_over_time.svg", margin_over_time(log, mechanism)),
        ("compensation_over_time.svg", compensation_over_time(log, mechanism)),
        ("zmp_over_time.svg", zmp_over_time(log, mechanism)),
        ("zmp_in_sole.svg", zmp_in_sole(log, mechanism)),
        ("stick_walk.svg", stick_walk(log, mechanism)),
    ]
}

#[cfg(test)]
mod tests {
    use super::colours::FALL;
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn pictures_of_empty_and_of_short_runs_are_valid() {
        let mechanism = synthetic::mechanism();
        for log in [RunLog::default(), synthetic::log(0, 0.0)] {
            for (_, svg) in of_run(&log, &mechanism) {
                assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            }
        }
    }

    #[test]
    fn pictures_of_balance_mark_a_fall() {
        let (mut log, mechanism) = (synthetic::log(5, 0.0), synthetic::mechanism());
        // The synthetic centre of mass is metres off the soles from the beginning.
        log.plant[20..].iter_mut().for_each(|row| row.fallen = true);
        for picture in [balance_over_time, compensation_over_time, footprints, margin_over_time, zmp_over_time] {
            let svg = picture(&log, &mechanism);
            let marks = [FALL.to_lowercase(), "it fell at 2.00 s".to_owned(), "unavoidable".to_owned()];
            assert!(marks.iter().all(|mark| svg.contains(mark.as_str())), "{svg}");
        }
    }
}
