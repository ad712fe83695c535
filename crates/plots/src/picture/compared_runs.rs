//! Two runs over each other.

use model::{Joint, Mechanism};

use super::chart::{Chart, Map, Pen, Point, maps};
use super::colours::{EDGE, FIRST_RUN, SECOND_RUN};
use super::footprints::map_scale;
use super::margin_over_time::{LOWEST as LOWEST_MARGIN, least_measured_margins};
use super::sole_outline::sole_outline;
use super::thinning::thinned;
use super::time_panel::{TimePanel, picture};
use crate::run_log::{PlantRow, RunLog};

/// Height of a panel (px).
const HEIGHT: f64 = 190.0;
/// A value that the range of the margin always has (mm): it shows the edge of the support polygon.
const EDGE_ALWAYS: f64 = -5.0;
/// Time between two points of a path (s).
const BETWEEN: f64 = 0.02;

/// A run that is compared.
#[derive(Clone, Copy, Debug)]
pub struct ComparedRun<'r> {
    /// Its name in legends and tables.
    pub name: &'r str,
    /// Its log.
    pub log: &'r RunLog,
    /// Its robot.
    pub mechanism: &'r Mechanism,
}

/// Pens of the first and of the second run: the first is wide, under the second.
const PENS: [Pen; 2] = [Pen::solid(FIRST_RUN, 2.2), Pen::solid(SECOND_RUN, 1.2)];

type CurveOf = fn(&ComparedRun) -> Vec<Point>;

/// Panels over time: margin, error of the zero-moment point, feedback, tilt of the trunk, torque.
pub fn compared_over_time(runs: &[ComparedRun; 2]) -> String {
    let panels: [(&str, &[f64], CurveOf); 5] = [
        ("least margin [mm]", &[EDGE_ALWAYS, 30.0], |run| least_measured_margins(run.log, run.mechanism)),
        ("ZMP error [mm]", &[0.0, 10.0], |run| {
            let rows = run.log.controller.iter();
            rows.map(|row| [row.time, row.zmp_error().map_or(f64::NAN, |error| error.norm() * 1e3)]).collect()
        }),
        ("feedback lean [°]", &[0.0, 1.0], |run| {
            let rows = run.log.controller.iter();
            rows.map(|row| [row.time, row.lean_roll.hypot(row.lean_pitch).to_degrees()]).collect()
        }),
        ("tilt of the trunk [°]", &[0.0, 5.0], |run| {
            run.log.plant.iter().map(|row| [row.time, row.trunk_tilt.to_degrees()]).collect()
        }),
        ("torque share [%]", &[0.0, 50.0], torque_shares),
    ];
    let spans = runs.iter().filter_map(|run| run.log.span());
    let shown = spans.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1))).unwrap_or((0.0, 1.0));
    let panels = panels.into_iter().map(|(label, always, quantity)| {
        let mut panel = if always.contains(&EDGE_ALWAYS) {
            TimePanel::new(label, always).not_below(LOWEST_MARGIN)
        } else {
            TimePanel::usual(label, always)
        };
        for (run, pen) in runs.iter().zip(PENS) {
            panel.draw(run.name, pen, quantity(run));
        }
        if always.contains(&EDGE_ALWAYS) {
            panel.level("edge of the support polygon", &[0.0], Pen::dashed(EDGE, 1.2));
        }
        panel
    });
    let title = "Two runs: margin, errors, and the most loaded drive";
    picture(title, &RunLog::default(), runs[0].mechanism, shown, HEIGHT, panels.collect())
}

/// The greatest share of its torque at standstill that any drive yields (%).
fn torque_shares(run: &ComparedRun) -> Vec<Point> {
    let limit = |joint: Joint| run.mechanism.links[joint].motor.map(|motor| motor.torque_max());
    let greatest = |row: &crate::run_log::DriveRow| {
        let shares = Joint::ALL.into_iter().filter_map(|joint| Some(row.torques[joint].abs() / limit(joint)?));
        shares.fold(f64::NAN, f64::max) * 100.0
    };
    run.log.drives.iter().map(|row| [row.time, greatest(row)]).collect()
}

/// The floor from above: soles and centre of mass of both runs.
pub fn compared_footprints(runs: &[ComparedRun; 2]) -> String {
    let mut chart = Chart::new("x [m]", "y [m]");
    for ((run, pen), opacity) in runs.iter().zip(PENS).zip([0.18, 0.0]) {
        for print in run.log.footprints(run.mechanism) {
            let outline = sole_outline(run.mechanism, print.side, &print.sole_to_world);
            chart.polygon(&outline, Pen { width: 1.2, ..pen }, opacity);
        }
        let upright = run.log.plant.split(|row| row.fallen).next().unwrap_or_default();
        let path = thinned(upright, BETWEEN, |row: &PlantRow| row.time);
        chart.line(path.map(|row| [row.com_in_world.x, row.com_in_world.y]), pen);
        chart.key_line(run.name, pen);
    }
    let scale = map_scale(&chart);
    maps("Soles and centre of mass of two runs", vec![Map { chart, scale }])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn both_runs_are_drawn_with_their_names() {
        let mechanism = synthetic::mechanism();
        let (one, mut other) = (synthetic::log(4, 0.0), synthetic::log(6, 0.2));
        other.plant.clear();
        let runs = [("before", &one), ("after", &other)];
        let runs = runs.map(|(name, log)| ComparedRun { name, log, mechanism: &mechanism });
        for svg in [compared_over_time(&runs), compared_footprints(&runs)] {
            assert!(svg.contains("before") && svg.contains("after") && !svg.contains("NaN"), "{svg}");
        }
    }
}
