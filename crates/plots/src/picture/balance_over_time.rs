//! Balance over time: zero-moment point, centre of mass and divergent component of motion, planned and measured, with
//! the soles on the ground.

use dynamics::Tree;
use model::{Mechanism, Side};
use nalgebra::{Point3, Rotation2, Vector2};

use super::chart::{Pen, Point};
use super::colours::{COM, COM_PLANNED, DIVERGENT, DIVERGENT_PLANNED, ZMP, colour};
use super::stretch::{rows_between, stretch};
use super::thinning::thinned;
use super::time_panel::{TimePanel, picture};
use crate::run_log::{ControllerRow, FootPlacement, RunLog};

/// Height of a panel (px).
const HEIGHT: f64 = 370.0;
/// Time between two points of a curve (s).
const BETWEEN: f64 = 0.005;

/// A curve: its name, its pen, and the point at a tick in support coordinates (m).
type Curve = (&'static str, Pen, fn(&ControllerRow) -> Option<Vector2<f64>>);

/// The curves in drawing order: planned ones are wide and pale, under the measured ones.
const CURVES: [Curve; 6] = [
    ("ZMP planned", Pen::solid("#B5B5B5", 3.6), |row| row.zmp_planned),
    ("ZMP measured", Pen::solid(ZMP, 1.1), |row| row.zmp_measured),
    ("centre of mass planned", Pen::solid(COM_PLANNED, 3.6), |row| row.com_planned.map(|com| com.position.xy())),
    ("centre of mass measured", Pen::solid(COM, 1.2), |row| row.com_measured.map(|com| com.position.xy())),
    ("divergent comp. planned", Pen::solid(DIVERGENT_PLANNED, 3.6), |row| {
        row.com_planned.map(|com| com.divergent_component())
    }),
    ("divergent comp. measured", Pen::solid(DIVERGENT, 1.2), |row| {
        row.com_measured.map(|com| com.divergent_component())
    }),
];

/// Two panels over some seconds: along the walk and across it. Support coordinates are converted to the floor with the
/// support foot's true pose.
pub fn balance_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let tree = Tree::new(mechanism);
    let shown = stretch(log);
    let floor = FloorView::of(log, mechanism, &tree, shown);
    let mut panels = [("along [m]", 0), ("across, to the left [m]", 1)].map(|(label, axis)| {
        let mut panel = TimePanel::usual(label, &[]);
        draw_soles(&mut panel, log, mechanism, &tree, &floor, shown, axis);
        panel
    });

    if log.controller.is_empty() {
        draw_truth(&mut panels, log, &floor, shown);
        return picture("Balance over the feet", log, mechanism, shown, HEIGHT, panels.into());
    }
    let from = log.controller.partition_point(|row| row.time < shown.0);
    let to = log.controller.partition_point(|row| row.time <= shown.1);
    let rows: Vec<(&ControllerRow, FootPlacement)> = thinned(&log.controller[from..to], BETWEEN, |row| row.time)
        .filter_map(|row| Some((row, log.plant_at(row.time)?.footprint(mechanism, &tree, row.support))))
        .collect();
    for (label, pen, point) in CURVES {
        let on_floor: Vec<(f64, Vector2<f64>)> = rows
            .iter()
            .map(|(row, foot)| {
                let seen = point(row).map(|point| floor.point(foot.to_world(point)));
                (row.time, seen.unwrap_or(Vector2::repeat(f64::NAN)))
            })
            .collect();
        for (axis, panel) in panels.iter_mut().enumerate() {
            panel.draw(label, pen, on_floor.iter().map(|(time, point)| [*time, point[axis]]).collect());
        }
    }
    let title = format!("Balance over the feet, planned and measured{}", log.estimated_text());
    picture(&title, log, mechanism, shown, HEIGHT, panels.into())
}

/// Draws what is known without the controller: the true curves.
fn draw_truth(panels: &mut [TimePanel; 2], log: &RunLog, floor: &FloorView, (from, to): (f64, f64)) {
    let first = log.plant.partition_point(|row| row.time < from);
    let end = log.plant.partition_point(|row| row.time <= to);
    type Truth = fn(&RunLog, usize) -> Option<Vector2<f64>>;
    let curves: [(&str, Pen, Truth); 3] = [
        ("ZMP of the ground", Pen::solid(ZMP, 1.1), |log, row| log.plant[row].zmp_in_world),
        ("centre of mass", Pen::solid(COM, 1.2), |log, row| Some(log.plant[row].com_in_world.xy())),
        ("divergent component", Pen::solid(DIVERGENT, 1.2), RunLog::divergent_component),
    ];
    for (label, pen, point) in curves {
        let at = |row: usize| point(log, row).map_or(Vector2::repeat(f64::NAN), |point| floor.point(point));
        let points: Vec<(f64, Vector2<f64>)> = (first..end).map(|row| (log.plant[row].time, at(row))).collect();
        for (axis, panel) in panels.iter_mut().enumerate() {
            panel.draw(label, pen, points.iter().map(|(time, point)| [*time, point[axis]]).collect());
        }
    }
}

/// Axes of the picture on the floor: along the mean direction of the soles in the middle of the shown time, and across
/// it.
struct FloorView {
    origin: Vector2<f64>,
    world_to_floor: Rotation2<f64>,
}

impl FloorView {
    fn of(log: &RunLog, mechanism: &Mechanism, tree: &Tree, (from, to): (f64, f64)) -> Self {
        let soles =
            |time: f64| log.plant_at(time).map(|row| Side::BOTH.map(|side| row.footprint(mechanism, tree, side)));
        let middle = |soles: [FootPlacement; 2]| {
            (soles[0].sole_to_world.translation.vector + soles[1].sole_to_world.translation.vector).xy() / 2.0
        };
        let forward = soles((from + to) / 2.0).map_or(Vector2::x(), |soles| {
            soles.iter().map(|sole| Vector2::new(sole.heading().cos(), sole.heading().sin())).sum()
        });
        Self {
            origin: soles(from).map_or(Vector2::zeros(), middle),
            world_to_floor: Rotation2::new(-forward.y.atan2(forward.x)),
        }
    }

    fn point(&self, point_in_world: Vector2<f64>) -> Vector2<f64> {
        self.world_to_floor * (point_in_world - self.origin)
    }
}

/// Draws a band for every time that a foot is on the ground, as wide as the sole along the axis.
fn draw_soles(
    panel: &mut TimePanel,
    log: &RunLog,
    mechanism: &Mechanism,
    tree: &Tree,
    floor: &FloorView,
    shown: (f64, f64),
    axis: usize,
) {
    let rows = rows_between(log, shown);
    for side in Side::BOTH {
        let label = match side {
            Side::Right => "right sole loaded",
            Side::Left => "left sole loaded",
        };
        for stance in rows.chunk_by(|before, after| before.bears(side) == after.bears(side)) {
            let (first, last) = (&stance[0], &stance[stance.len() - 1]);
            if !first.bears(side) {
                continue;
            }
            let sole_to_world = stance[stance.len() / 2].footprint(mechanism, tree, side).sole_to_world;
            let edges = mechanism.sole.corners(side).map(|corner| {
                let corner: Point = floor.point((sole_to_world * Point3::from(corner)).coords.xy()).into();
                corner[axis]
            });
            let (least, greatest) = edges
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), edge| (min.min(*edge), max.max(*edge)));
            panel.band(label, colour(side), (first.time, last.time), (least, greatest));
        }
    }
}
