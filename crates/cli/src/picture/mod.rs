//! SVG pictures of a run and of the nominal half-step. Each is a function that returns the file's text.
//!
//! One colour has one meaning in all of them: right blue, left orange, the zero-moment point black, the centre of mass
//! green, the divergent component of motion and its feedback purple, what was planned grey or pale (Okabe and Ito 2008: told
//! apart by colour-blind readers and on grey paper), a fall red.

mod balance_over_time;
mod chart;
mod compensation_over_time;
mod fall_marks;
mod footprints;
mod margin_over_time;
mod nominal_footprints;
mod nominal_stick;
mod paper_figure;
mod sole_outline;
mod spread_of_times;
mod stick_walk;
mod sticks;
mod stretch;
mod thinning;
mod time_panel;
mod zmp_in_sole;
mod zmp_over_time;

use model::{Mechanism, Side};

pub use balance_over_time::balance_over_time;
pub use compensation_over_time::compensation_over_time;
pub use footprints::footprints;
pub use margin_over_time::margin_over_time;
pub use nominal_footprints::nominal_footprints;
pub use nominal_stick::nominal_stick;
pub use paper_figure::paper_figure;
pub use spread_of_times::spread_of_times;
pub use stick_walk::stick_walk;
pub use zmp_in_sole::zmp_in_sole;
pub use zmp_over_time::zmp_over_time;

use crate::run_log::RunLog;

/// All pictures of a run, each with the name of its file.
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

const RIGHT: &str = "#0072B2";
const LEFT: &str = "#D55E00";
const ZMP: &str = "#000000";
const PLANNED: &str = "#8C8C8C";
const COM: &str = "#009E73";
const COM_PLANNED: &str = "#8FD8C2";
const DIVERGENT: &str = "#A8317F";
const DIVERGENT_PLANNED: &str = "#E6AFD2";
const EDGE: &str = "#999999";
const FALL: &str = "#CC0000";

/// The colour of a side's foot.
const fn colour(side: Side) -> &'static str {
    match side {
        Side::Right => RIGHT,
        Side::Left => LEFT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn a_run_that_ended_before_it_began_or_at_once_has_pictures() {
        let mechanism = synthetic::mechanism();
        for log in [RunLog::default(), synthetic::log(0, 0.0)] {
            for (_, svg) in of_run(&log, &mechanism) {
                assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            }
        }
    }

    #[test]
    fn a_fall_is_marked_in_every_picture_of_balance() {
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
