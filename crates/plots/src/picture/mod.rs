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

/// Draws the pictures of a run for which it holds what they show: all of them, if both processes recorded. Returns the
/// names and texts of the files.
pub fn of_run(log: &RunLog, mechanism: &Mechanism) -> Vec<(&'static str, String)> {
    let (plant, controller) = (!log.plant.is_empty(), !log.controller.is_empty());
    type Draw = fn(&RunLog, &Mechanism) -> String;
    let pictures: [(&str, bool, Draw); 7] = [
        ("footprints.svg", plant && controller, footprints),
        ("balance_over_time.svg", plant && controller, balance_over_time),
        ("margin_over_time.svg", controller, margin_over_time),
        ("compensation_over_time.svg", controller, compensation_over_time),
        ("zmp_over_time.svg", controller, zmp_over_time),
        ("zmp_in_sole.svg", plant && controller, zmp_in_sole),
        ("stick_walk.svg", plant, stick_walk),
    ];
    let drawn = pictures.into_iter().filter(|(_, can_be_drawn, _)| *can_be_drawn);
    drawn.map(|(name, _, draw)| (name, draw(log, mechanism))).collect()
}

#[cfg(test)]
mod tests {
    use super::colours::FALL;
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn pictures_of_short_runs_and_of_one_process_are_valid() {
        let mechanism = synthetic::mechanism();
        assert!(of_run(&RunLog::default(), &mechanism).is_empty());
        let (short, run) = (synthetic::log(0, 0.0), synthetic::log(3, 0.1));
        let of_controller = RunLog { plant: Vec::new(), ..run.clone() };
        let of_plant = RunLog { controller: Vec::new(), ..run };
        let drawn = |log| of_run(log, &mechanism).iter().map(|(name, _)| *name).collect::<Vec<_>>();
        assert_eq!(drawn(&of_controller), ["margin_over_time.svg", "compensation_over_time.svg", "zmp_over_time.svg"]);
        assert_eq!(drawn(&of_plant), ["stick_walk.svg"]);
        for log in [short, of_controller, of_plant] {
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
