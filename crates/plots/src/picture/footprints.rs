//! The floor from above, in the style of the paper's figures: footprints, and the paths of zero-moment point, centre of
//! mass and divergent component of motion.

use model::{Mechanism, Side};

use super::chart::{Chart, Map, Pen, Point, maps};
use super::colours::{COM, DIVERGENT, LEFT, RIGHT, ZMP};
use super::fall_marks::FallMarks;
use super::sole_outline::{draw_arrow_head, draw_sole};
use super::thinning::thinned;
use crate::run_log::{Measures, PlantRow, RunLog};

/// Time between two points of a path (s): less than 1 cm of the fastest walk.
const BETWEEN: f64 = 0.01;
/// Most points of a path; a long walk has fewer per second.
const POINTS: f64 = 6000.0;
/// Size of a path below which it has no arrow (m).
const SPOT: f64 = 0.02;
/// Size to which short walks are enlarged (px).
const CANVAS: f64 = 1500.0;
/// Least and greatest scale, for long and for short walks (px/m).
const SCALE: std::ops::RangeInclusive<f64> = 110.0..=420.0;

/// Footprints to scale in the world, with the path of the ground's zero-moment point in single support and the
/// projections of centre of mass and divergent component. Nothing after a fall is drawn.
pub fn footprints(log: &RunLog, mechanism: &Mechanism) -> String {
    let time = |row: &PlantRow| row.time;
    let (mut chart, com, zmp) = (Chart::new("x [m]", "y [m]"), Pen::solid(COM, 1.1), Pen::solid(ZMP, 0.9));
    let prints = log.footprints(mechanism);
    for print in &prints {
        draw_sole(&mut chart, mechanism, print.side, &print.sole_to_world);
    }
    let upright = log.plant.iter().position(|row| row.fallen).map_or(&log.plant[..], |fell| &log.plant[..=fell]);
    let divergent: Vec<(f64, Point)> =
        (0..upright.len()).filter_map(|row| Some((upright[row].time, log.divergent_component(row)?.into()))).collect();
    let duration = upright.first().zip(upright.last()).map_or(0.0, |(first, last)| last.time - first.time);
    let between = BETWEEN.max(duration / POINTS);
    let ahead = Pen::solid(DIVERGENT, 0.9);
    chart.line(thinned(&divergent, between, |(time, _)| *time).map(|(_, point)| *point), ahead);
    chart.line(thinned(upright, between, time).map(|row| [row.com_in_world.x, row.com_in_world.y]), com);

    let lone = |row: &PlantRow| Side::BOTH.into_iter().find(|side| row.bears_alone(*side));
    for support in upright.chunk_by(|row, next| lone(row) == lone(next)).filter(|rows| lone(&rows[0]).is_some()) {
        let path: Vec<Point> =
            thinned(support, between, time).filter_map(|row| row.zmp_in_world.map(|zmp| [zmp.x, zmp.y])).collect();
        draw_path(&mut chart, &path, zmp);
    }

    chart.key_area("right sole", RIGHT);
    chart.key_area("left sole", LEFT);
    chart.key_line("ZMP, single support", zmp);
    chart.key_line("centre of mass", com);
    chart.key_line("divergent component", ahead);
    let fall = FallMarks::of(log, mechanism);
    fall.draw_on_floor(&mut chart, log);
    fall.key_on_floor(&mut chart);
    let measures = log.measures(mechanism);
    let heading = measures.truth.unwrap_or(measures.estimated).heading_deg.round() + 0.0;
    let title = if log.controller.is_empty() {
        format!("Footprints: {:.1} m, heading {heading:+.0}°", measures.distance_m)
    } else {
        let Measures { half_steps, distance_m, .. } = measures;
        format!("Footprints: {half_steps} half-steps, {distance_m:.1} m, heading {heading:+.0}°")
    };
    let title = title + log.estimated_text() + &fall.title();
    let scale = map_scale(&chart);
    maps(&title, vec![Map { chart, scale }])
}

/// The scale of a map of footprints (px/m).
pub(super) fn map_scale(chart: &Chart) -> f64 {
    (CANVAS / chart.span().max(0.1)).clamp(*SCALE.start(), *SCALE.end())
}

/// Draws a path, with an arrow head at its end unless it stays in one spot.
fn draw_path(chart: &mut Chart, path: &[Point], pen: Pen) {
    chart.line(path.iter().copied(), pen);
    // Far enough before the tip that noise does not reverse the arrow.
    let Some((&tip, &before)) = path.last().zip(path.get(path.len() * 4 / 5)) else { return };
    let reach = path.iter().map(|point| (point[0] - tip[0]).hypot(point[1] - tip[1])).fold(0.0, f64::max);
    if reach > SPOT {
        draw_arrow_head(chart, tip, [tip[0] - before[0], tip[1] - before[1]], 0.018, pen.colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::synthetic;

    #[test]
    fn footprints_picture_has_every_footprint_once() {
        let svg = footprints(&synthetic::log(7, 0.1), &synthetic::mechanism());
        let soles = |colour: &str| {
            let fill = format!("fill=\"{}\"", colour.to_lowercase());
            svg.split("<path").filter(|path| path.contains(&fill) && path.contains(" Z")).count()
        };
        // It begins on both feet; then left and right land in turn, the left one first.
        assert_eq!((soles(RIGHT), soles(LEFT)), (4, 5));
    }

    #[test]
    fn footprints_picture_of_an_empty_run_is_valid() {
        assert!(footprints(&RunLog::default(), &synthetic::mechanism()).starts_with("<svg"));
    }
}
