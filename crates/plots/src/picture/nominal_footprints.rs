//! The nominal half-step from above: soles, zero-moment point, centre of mass (the paper's Fig. 3).

use dynamics::{Kinematics, NewtonEuler, Tree, zmp};
use gait::NominalTable;
use model::{Mechanism, Side};

use super::chart::{Chart, Map, Pen, Point, maps};
use super::colours::{COM, LEFT, RIGHT, ZMP};
use super::sole_outline::{draw_arrow_head, draw_sole};
use super::sticks::circle;

/// Radius of the ring around the zero-moment point (m).
const ZMP_RING: f64 = 0.005;
/// Scale of the picture (px/m).
const SCALE: f64 = 1000.0;

/// Draws the support sole at O with the left sole before and after its swing, to scale. The zero-moment point is
/// computed from the table's motion by inverse dynamics.
pub fn nominal_footprints(table: &NominalTable, mechanism: &Mechanism) -> String {
    let tree = Tree::new(mechanism);
    let mut chart = Chart::new("x [m]", "y [m]");
    let poses: Vec<Kinematics> =
        table.rows.iter().map(|row| Kinematics::fixed_base(&tree, &row.motion.angles)).collect();
    for pose in poses.first().into_iter().chain(poses.last()) {
        draw_sole(&mut chart, mechanism, Side::Left, &pose.sole_to_world(mechanism, Side::Left));
    }
    if let Some(pose) = poses.first() {
        draw_sole(&mut chart, mechanism, Side::Right, &pose.sole_to_world(mechanism, Side::Right));
    }

    let ankle = |pose: &Kinematics| pose.sole_to_world(mechanism, Side::Left).translation.vector;
    let swing = Pen::dashed(LEFT, 1.0);
    draw_path(&mut chart, poses.iter().map(|pose| [ankle(pose).x, ankle(pose).y]).collect(), swing, 0.02);
    let com = Pen::solid(COM, 1.6);
    draw_path(&mut chart, poses.iter().map(|pose| [pose.com(&tree).x, pose.com(&tree).y]).collect(), com, 0.015);

    let mut newton_euler = NewtonEuler::default();
    let zmps = table.rows.iter().filter_map(|row| {
        newton_euler.compute_fixed_base(&tree, &row.motion);
        zmp(&newton_euler.ground)
    });
    let zmps: Vec<Point> = zmps.map(|zmp| [zmp.x, zmp.y]).collect();
    let residual = zmps.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    let pen = Pen::solid(ZMP, 1.0);
    chart.line(zmps, pen);
    // The path stays in one spot: a ring shows where it is.
    chart.line(circle([0.0; 2], ZMP_RING), pen);

    chart.key_area("right sole, support", RIGHT);
    chart.key_area("left sole, before and after", LEFT);
    chart.key_line("swing ankle", swing);
    chart.key_line("ZMP, inside the ring", pen);
    chart.key_line("centre of mass", com);
    let title = format!("Nominal half-step: |ZMP − O| ≤ {:.4} mm", residual * 1e3);
    maps(&title, vec![Map { chart, scale: SCALE }])
}

fn draw_path(chart: &mut Chart, path: Vec<Point>, pen: Pen, arrow: f64) {
    let middle = path.len() / 2;
    if let (Some(&tip), Some(&before)) = (path.get(middle), path.get(middle.saturating_sub(1))) {
        draw_arrow_head(chart, tip, [tip[0] - before[0], tip[1] - before[1]], arrow, pen.colour);
    }
    chart.line(path, pen);
}
