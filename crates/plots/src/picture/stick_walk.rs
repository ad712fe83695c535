//! The walk as stick figures, from the side and from the front.

use dynamics::{Kinematics, Tree};
use model::{LegReach, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

use super::chart::{Chart, Map, Pen, Point, maps};
use super::colours::EDGE;
use super::fall_marks::FallMarks;
use super::floor::FloorHeights;
use super::sticks::{draw_stick_figure, key_sticks};
use super::stretch::{rows_between, stretch};
use crate::run_log::{PlantRow, RunLog};

/// Time between two figures of the side view (s); the front view has every other one.
const INTERVAL: f64 = 0.2;
/// Most figures; a longer part of a walk has them further apart.
const FIGURES_MAX: f64 = 40.0;
/// The floor.
const FLOOR: Pen = Pen::solid(EDGE, 1.2);
/// Distance of the points between which the floor is drawn straight along the walk (m), and their number under a figure
/// seen from the front.
const FLOOR_DISTANCE: f64 = 0.005;
const FLOOR_POINTS: i32 = 60;
// The following are for the paper's robot; others are drawn in proportion.
/// Distance between two figures of the front view (m).
const APART: f64 = 0.7;
/// How far the floor is drawn beyond the walk (m).
const BEYOND: f64 = 0.3;
/// Height of the times over the front view, and its height (m).
const TIMES: [f64; 2] = [1.78, 1.84];
/// Scales of the side view and of the front view (px/m).
const SCALES: [f64; 2] = [520.0, 190.0];

/// The robot at an instant, with the line along which it walks.
struct Posture {
    time: f64,
    kinematics: Kinematics,
    /// Middle between the soles on the floor (m).
    place: Vector2<f64>,
    /// Mean direction of the soles, a unit vector.
    forward: Vector2<f64>,
    /// Length of the line up to this instant (m).
    travelled: f64,
}

/// Draws figures over some seconds in the middle of the walk, or up to its first fall, on the floor as it is along the
/// way. A turning walk is unrolled along the line through the middles between the feet, and viewed across it.
pub fn stick_walk(log: &RunLog, mechanism: &Mechanism, floor: &FloorHeights) -> String {
    let rows = rows_between(log, stretch(log));
    // What follows a fall is not simulated well: only the soles touch the ground.
    let rows = rows.iter().position(|row| row.fallen).map_or(rows, |fell| &rows[..=fell]);
    let (postures, interval) = postures(rows, mechanism);
    let size = LegReach::of(mechanism).scale();

    let mut side_view = Chart::new("along the walk [m]", "z [m]");
    for posture in &postures {
        draw_stick_figure(&mut side_view, mechanism, &posture.kinematics, |point| {
            [posture.travelled + posture.forward.dot(&(point.xy() - posture.place)), point.z]
        });
    }
    side_view.line(floor_along(&postures, floor, size), FLOOR);
    key_sticks(&mut side_view);
    side_view.key_line("floor in the middle of the way", FLOOR);

    let mut front_view = Chart::new(
        format!("across the walk, seen from the front [m]; figures every {:.1} s, moved apart", 2.0 * interval),
        "z [m]",
    );
    for (index, posture) in postures.iter().step_by(2).enumerate() {
        let left = Vector2::new(-posture.forward.y, posture.forward.x);
        let moved = size * APART * index as f64;
        draw_stick_figure(&mut front_view, mechanism, &posture.kinematics, |point| {
            [moved + left.dot(&(point.xy() - posture.place)), point.z]
        });
        let reach = size * APART / 2.0;
        let heights = (0..=FLOOR_POINTS).map(|point| {
            let aside = reach * (2.0 * f64::from(point) / f64::from(FLOOR_POINTS) - 1.0);
            [moved + aside, floor.at(posture.place + left * aside)]
        });
        front_view.line(heights, FLOOR);
        let stands = floor.at(posture.place);
        front_view.text(format!("{:.1} s", posture.time), [moved, stands + size * TIMES[0]]);
        front_view.include(&[[moved, stands + size * TIMES[1]]]);
    }

    let shown = rows.first().zip(rows.last()).map_or((0.0, 0.0), |(first, last)| (first.time, last.time));
    let title = format!("The walk from {:.1} to {:.1} s, figures every {interval:.1} s", shown.0, shown.1);
    let title = title + log.estimated_text() + &FallMarks::of(log, mechanism).title();
    let charts = [(side_view, SCALES[0]), (front_view, SCALES[1])];
    maps(&title, charts.map(|(chart, scale)| Map { chart, scale: scale / size }).into())
}

/// The floor under the line along which the robot walks, and half a step beyond either end.
fn floor_along(postures: &[Posture], floor: &FloorHeights, size: f64) -> Vec<Point> {
    let beyond =
        |posture: &Posture, distance: f64| (posture.travelled + distance, posture.place + posture.forward * distance);
    let (Some(first), Some(last)) = (postures.first(), postures.last()) else { return Vec::new() };
    let way = postures.iter().map(|posture| (posture.travelled, posture.place));
    let reach = size * BEYOND;
    let way = std::iter::once(beyond(first, -reach)).chain(way).chain(std::iter::once(beyond(last, reach)));
    let way: Vec<(f64, Vector2<f64>)> = way.collect();
    let pieces = way.windows(2).flat_map(|ends| {
        let [(from, start), (to, end)] = [ends[0], ends[1]];
        let points = ((end - start).norm() / FLOOR_DISTANCE).ceil().clamp(1.0, 200.0);
        (0..=points as u32).map(move |point| {
            let share = f64::from(point) / points;
            [from + (to - from) * share, floor.at(start + (end - start) * share)]
        })
    });
    pieces.collect()
}

/// Figures at equal intervals of time, and the interval (s).
fn postures(rows: &[PlantRow], mechanism: &Mechanism) -> (Vec<Posture>, f64) {
    let tree = Tree::new(mechanism);
    let lasts = rows.first().zip(rows.last()).map_or(0.0, |(first, last)| last.time - first.time);
    let interval = INTERVAL * (lasts / INTERVAL / FIGURES_MAX).ceil().max(1.0);
    let mut postures: Vec<Posture> = Vec::new();
    for row in rows {
        let due = postures.last().map_or(row.time, |last| last.time + interval - 1e-9);
        if row.time < due {
            continue;
        }
        let kinematics = row.kinematics(&tree);
        let soles = Side::BOTH.map(|side| kinematics.sole_to_world(mechanism, side));
        let place = (soles[0].translation.vector.xy() + soles[1].translation.vector.xy()) / 2.0;
        let forward = soles.iter().map(|sole| (sole.rotation * Vector3::x()).xy()).sum::<Vector2<f64>>().normalize();
        let travelled = postures.last().map_or(0.0, |last| {
            let moved = place - last.place;
            last.travelled + moved.norm() * moved.dot(&forward).signum()
        });
        postures.push(Posture { time: row.time, kinematics, place, forward, travelled });
    }
    (postures, interval)
}
