//! Plots of a run and of the nominal half-step as SVG. Each is a function that returns the file's text.
//!
//! One colour has one meaning in all of them, see [`colours`]: right blue, left orange, the zero-moment point black,
//! the centre of mass green, the divergent component of motion and its feedback purple, planned values grey or pale, a
//! fall red.

mod balance_over_time;
mod compared_runs;
mod compensation_over_time;
mod drives_over_time;
mod fall_marks;
mod floor;
mod footprints;
mod joint_panels;
mod joints_over_time;
mod margin_over_time;
mod nominal_footprints;
mod nominal_stick;
mod stick_walk;
mod sticks;
mod stretch;
mod thinning;
mod time_panel;
mod zmp_in_sole;
mod zmp_over_time;

use model::Mechanism;

pub use charts::{chart, colours, sole_outline};

pub use balance_over_time::balance_over_time;
pub use compared_runs::{ComparedRun, compared_footprints, compared_over_time};
pub use compensation_over_time::compensation_over_time;
pub use drives_over_time::{currents_over_time, torques_over_time};
pub use floor::FloorHeights;
pub use footprints::footprints;
pub use joints_over_time::{joint_errors_over_time, joints_over_time};
pub use margin_over_time::margin_over_time;
pub use nominal_footprints::nominal_footprints;
pub use nominal_stick::nominal_stick;
pub use stick_walk::stick_walk;
pub use zmp_in_sole::zmp_in_sole;
pub use zmp_over_time::zmp_over_time;

use crate::run_log::RunLog;

/// The pictures of a run, and those that cannot be drawn of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunPictures {
    /// The pictures in the order in which they tell of the run.
    pub drawn: Vec<RunPicture>,
    /// Pictures that are missing and why, one text each.
    pub missing: Vec<String>,
}

/// A picture of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunPicture {
    /// Name of its file.
    pub file: &'static str,
    /// What it shows, in a sentence.
    pub shows: &'static str,
    /// Its text.
    pub svg: String,
}

/// What a picture is drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Needs {
    /// The robot: its true states, or those that the controller estimates.
    Robot,
    /// The controller's reports.
    Reports,
    /// Measurements and setpoints.
    Drives,
    /// Currents of DC motors.
    Currents,
}

impl Needs {
    /// What is missing, if the run does not have it.
    fn missing(self, log: &RunLog, mechanism: &Mechanism) -> Option<&'static str> {
        match self {
            Needs::Robot => log.plant.is_empty().then_some("no state of the robot was recorded"),
            Needs::Reports => log.controller.is_empty().then_some("no report of the controller was recorded"),
            Needs::Drives | Needs::Currents if log.drives.is_empty() => {
                Some("no measurement and setpoint were recorded")
            }
            Needs::Currents if !drives_over_time::has_currents(mechanism) => {
                Some("the robot has no DC motor: nothing is known of the currents of its drives")
            }
            Needs::Drives | Needs::Currents => None,
        }
    }
}

type Draw = fn(&RunLog, &Mechanism, &FloorHeights) -> String;

const PICTURES: [(&str, &str, Needs, Draw); 11] = [
    (
        "footprints.svg",
        "The floor from above: where the soles stood, and the paths of ZMP, centre of mass and divergent component.",
        Needs::Robot,
        |log, mechanism, _| footprints(log, mechanism),
    ),
    (
        "stick_walk.svg",
        "The robot from the side and from the front, on the floor along its way.",
        Needs::Robot,
        stick_walk,
    ),
    (
        "margin_over_time.svg",
        "Distance of the ZMP from the edge of the support polygon. At a support change it passes zero; the lower panel \
         leaves support changes out.",
        Needs::Reports,
        |log, mechanism, _| margin_over_time(log, mechanism),
    ),
    (
        "zmp_over_time.svg",
        "Measured and planned ZMP in the support foot's sole frame, and the commands.",
        Needs::Reports,
        |log, mechanism, _| zmp_over_time(log, mechanism),
    ),
    (
        "balance_over_time.svg",
        "ZMP, centre of mass and divergent component over the soles on the floor.",
        Needs::Robot,
        |log, mechanism, _| balance_over_time(log, mechanism),
    ),
    (
        "zmp_in_sole.svg",
        "The ZMP of all half-steps in the soles: how much of them the walk uses.",
        Needs::Robot,
        |log, mechanism, _| zmp_in_sole(log, mechanism),
    ),
    (
        "compensation_over_time.svg",
        "Angles that plan and feedback add at the support ankle and the waist.",
        Needs::Reports,
        |log, mechanism, _| compensation_over_time(log, mechanism),
    ),
    (
        "joints_over_time.svg",
        "Joint angles: setpoint, measured, and the ends of their ranges.",
        Needs::Drives,
        |log, mechanism, _| joints_over_time(log, mechanism),
    ),
    (
        "joint_errors_over_time.svg",
        "How far each joint is from its setpoint. A servo yields under load: a bearing leg always has an error.",
        Needs::Drives,
        |log, mechanism, _| joint_errors_over_time(log, mechanism),
    ),
    (
        "torques_over_time.svg",
        "Motor torques at the joints, what the plan expected, and the limits of the drives.",
        Needs::Drives,
        |log, mechanism, _| torques_over_time(log, mechanism),
    ),
    ("currents_over_time.svg", "Measured motor currents.", Needs::Currents, |log, mechanism, _| {
        currents_over_time(log, mechanism)
    }),
];

/// Draws the pictures of a run, or of a part of it, for which it holds what they show: all of them, if both processes
/// recorded.
pub fn of_run(log: &RunLog, mechanism: &Mechanism, floor: &FloorHeights) -> RunPictures {
    let mut pictures = RunPictures::default();
    for (file, shows, needs, draw) in PICTURES {
        match needs.missing(log, mechanism) {
            Some(why) => pictures.missing.push(format!("{file}: {why}")),
            None => pictures.drawn.push(RunPicture { file, shows, svg: draw(log, mechanism, floor) }),
        }
    }
    pictures
}

#[cfg(test)]
mod tests {
    use super::colours::FALL;
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn pictures_of_short_runs_and_of_one_process_are_valid() {
        let mechanism = synthetic::mechanism();
        let all = |log: &RunLog| of_run(log, &mechanism, &FloorHeights::PLANE);
        assert!(all(&RunLog::default()).drawn.is_empty());
        let (short, mut run) = (synthetic::log(0, 0.0), synthetic::log(3, 0.1));
        run.drives = (0..20).map(|tick| synthetic::drives_at(f64::from(tick) * 0.1, &mechanism, |_| 1.5)).collect();
        let of_controller = RunLog { plant: Vec::new(), ..run.clone() };
        let of_plant = RunLog { controller: Vec::new(), drives: Vec::new(), ..run.clone() };
        assert_eq!((all(&run).drawn.len(), all(&run).missing.len()), (11, 0));
        assert_eq!((all(&of_controller).drawn.len(), all(&of_plant).drawn.len()), (7, 4));
        let missing = all(&of_plant).missing;
        assert!(missing.contains(&"zmp_over_time.svg: no report of the controller was recorded".to_owned()));
        for log in [short, run, of_controller, of_plant] {
            for RunPicture { file, svg, .. } in all(&log).drawn {
                assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf"), "{file}: {svg}");
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
