//! The walk as stick figures, from the side and from the front.

use dynamics::{Kinematics, Tree};
use model::{LegReach, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

use super::chart::{Chart, Map, Pen, maps};
use super::colours::EDGE;
use super::sticks::{draw_stick_figure, key_sticks};
use super::stretch::{rows_between, stretch};
use crate::run_log::{PlantRow, RunLog};

/// Time between two figures of the side view, and of the front view (s).
const INTERVALS: [f64; 2] = [0.2, 0.4];
// The following are for the paper's robot; others are drawn in proportion.
/// Distance between two figures of the front view (m).
const APART: f64 = 0.7;
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

/// Draws figures over some seconds in the middle of the walk, or before its first fall. A turning walk is unrolled
/// along the line through the middles between the feet, and viewed across it.
pub fn stick_walk(log: &RunLog, mechanism: &Mechanism) -> String {
    let rows = rows_between(log, stretch(log));
    let postures = postures(rows, mechanism);
    let size = LegReach::of(mechanism).scale();

    let mut side_view = Chart::new("along the walk [m]", "z [m]");
    for posture in &postures {
        draw_stick_figure(&mut side_view, mechanism, &posture.kinematics, |point| {
            [posture.travelled + posture.forward.dot(&(point.xy() - posture.place)), point.z]
        });
    }
    floor(&mut side_view);
    key_sticks(&mut side_view);

    let every = (INTERVALS[1] / INTERVALS[0]).round() as usize;
    let mut front_view = Chart::new(
        format!("across the walk, seen from the front [m]; figures every {} s, moved apart", INTERVALS[1]),
        "z [m]",
    );
    for (index, posture) in postures.iter().step_by(every).enumerate() {
        let left = Vector2::new(-posture.forward.y, posture.forward.x);
        let moved = size * APART * index as f64;
        draw_stick_figure(&mut front_view, mechanism, &posture.kinematics, |point| {
            [moved + left.dot(&(point.xy() - posture.place)), point.z]
        });
        front_view.text(format!("{:.1} s", posture.time), [moved, size * TIMES[0]]);
        front_view.include(&[[moved, size * TIMES[1]]]);
    }
    floor(&mut front_view);

    let shown = rows.first().zip(rows.last()).map_or((0.0, 0.0), |(first, last)| (first.time, last.time));
    let mut title = format!("The walk from {:.1} to {:.1} s, figures every {} s", shown.0, shown.1, INTERVALS[0]);
    if let Some(fall) = log.falls().next() {
        title += &format!("; it fell at {fall:.1} s");
    }
    let charts = [(side_view, SCALES[0]), (front_view, SCALES[1])];
    maps(&title, charts.map(|(chart, scale)| Map { chart, scale: scale / size }).into())
}

fn floor(chart: &mut Chart) {
    chart.level(0.0, Pen::solid(EDGE, 1.0));
}

/// Figures at equal intervals of time.
fn postures(rows: &[PlantRow], mechanism: &Mechanism) -> Vec<Posture> {
    let tree = Tree::new(mechanism);
    let mut postures: Vec<Posture> = Vec::new();
    for row in rows {
        let due = postures.last().map_or(row.time, |last| last.time + INTERVALS[0] - 1e-9);
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
    postures
}
