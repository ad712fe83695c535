//! Zero-moment point in the sole: the paths of all half-steps over each other, which show how much of the sole the walk
//! uses.

use dynamics::Tree;
use model::{Mechanism, Side};
use nalgebra::{Isometry3, Point3, Vector3};

use super::chart::{Chart, Map, Pen, Point, maps};
use super::colours::{LEFT, PLANNED, RIGHT, ZMP};
use super::sole_outline::draw_sole;
use super::thinning::thinned;
use crate::run_log::{PlantRow, RunLog};

/// Time between two points of a path (s).
const BETWEEN: f64 = 0.004;
/// Most points of all paths together; a long walk has fewer per second.
const POINTS: f64 = 20_000.0;
/// Scale of the picture (px/m).
const SCALE: f64 = 3200.0;
const GROUND_PEN: Pen = Pen::solid(ZMP, 0.5);
const PLANNED_PEN: Pen = Pen::solid(PLANNED, 1.4);

/// Draws the true and the planned zero-moment point of all half-steps in single support; where nobody recorded the true
/// one, the measured one. The left sole is above the right one, as for feet that point to the right.
pub fn zmp_in_sole(log: &RunLog, mechanism: &Mechanism) -> String {
    let [mut right, mut left] = Side::BOTH.map(|side| chart(log, mechanism, side));
    right.x_label = "x in the sole [m]".into();
    // With the same range they can be compared at sight.
    left.include(&right.extent());
    right.include(&left.extent());
    left.key_area("left sole", LEFT);
    left.key_area("right sole", RIGHT);
    let is_true = !(log.plant.is_empty() || log.is_estimated);
    left.key_line(if is_true { "ZMP of the ground" } else { "ZMP measured" }, GROUND_PEN);
    if !log.controller.is_empty() {
        left.key_line("ZMP planned, off support changes", PLANNED_PEN);
    }
    let title = "Zero-moment point in the support sole, single support of all half-steps";
    maps(title, [left, right].map(|chart| Map { chart, scale: SCALE }).into())
}

fn chart(log: &RunLog, mechanism: &Mechanism, side: Side) -> Chart {
    let tree = Tree::new(mechanism);
    let mut chart = Chart::new("", "y in the sole [m]");
    draw_sole(&mut chart, mechanism, side, &Isometry3::identity());
    let between = BETWEEN.max(log.span().map_or(0.0, |(first, last)| last - first) / POINTS);
    let on_sole = |plant: &PlantRow| -> Option<Point> {
        let sole = plant.footprint(mechanism, &tree, side).sole_to_world;
        let zmp = plant.zmp_in_world?;
        // The line through it along the world's z meets the sole, at whatever height that is.
        let (normal, place) = (sole.rotation * Vector3::z(), sole.translation.vector);
        let height = place.z - (zmp - place.xy()).dot(&normal.xy()) / normal.z;
        let zmp = sole.inverse() * Point3::new(zmp.x, zmp.y, height);
        Some([zmp.x, zmp.y])
    };
    if log.controller.is_empty() {
        for support in log.plant.chunk_by(|row, next| row.bears_alone(side) == next.bears_alone(side)) {
            let alone = thinned(support, between, |row| row.time).filter(|row| row.bears_alone(side) && !row.fallen);
            chart.line(alone.filter_map(on_sole).collect::<Vec<Point>>(), GROUND_PEN);
        }
        return chart;
    }
    for half_step in log.half_steps().filter(|half_step| half_step[0].support == side) {
        let (mut planned, mut ground): (Vec<Point>, Vec<Point>) = Default::default();
        for row in thinned(half_step, between, |row| row.time) {
            let Some(plant) = log.plant_at(row.time).filter(|plant| plant.bears_alone(side) && !plant.fallen) else {
                continue;
            };
            if row.is_off_support_changes() {
                planned.extend(row.zmp_planned.map(|zmp| [zmp.x, zmp.y]));
            }
            ground.extend(on_sole(plant));
        }
        chart.line(planned, PLANNED_PEN);
        chart.line(ground, GROUND_PEN);
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn zmp_under_the_ankle_is_drawn_there_wherever_the_foot_is() {
        // The log's zero-moment point is under the right ankle: on the left foot that is 0.19 m to the right.
        let (log, mechanism) = (synthetic::log(6, 0.2), synthetic::mechanism());
        let [right, left] = Side::BOTH.map(|side| chart(&log, &mechanism, side).extent());
        let sole = &mechanism.sole;
        assert_eq!(right, [[-sole.behind, -sole.outside], [sole.ahead, sole.inside]]);
        assert!((left[0][1] + 0.19).abs() < 1e-9 && left[1] == right[1], "{left:?}");
    }
}
