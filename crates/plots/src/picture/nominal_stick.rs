//! The nominal half-step as stick figures (the paper's Fig. 2).

use dynamics::{Kinematics, Tree};
use gait::NominalTable;
use model::{LegReach, Mechanism};

use super::chart::{Chart, Map, Pen, maps};
use super::colours::EDGE;
use super::sticks::{draw_stick_figure, key_sticks};

/// Number of figures.
const FIGURES: usize = 7;
/// Scale of the picture of the paper's robot (px/m); others are drawn as large.
const SCALE: f64 = 380.0;

/// Draws side and front view of the nominal half-step on the right foot.
pub fn nominal_stick(table: &NominalTable, mechanism: &Mechanism) -> String {
    let tree = Tree::new(mechanism);
    let mut side_view = Chart::new("x [m], from the right side", "z [m]");
    let mut front_view = Chart::new("y [m], from the front", "z [m]");
    for index in 0..FIGURES {
        let row = &table.rows[index * table.intervals() / (FIGURES - 1)];
        let posture = Kinematics::fixed_base(&tree, &row.motion.angles);
        draw_stick_figure(&mut side_view, mechanism, &posture, |point| [point.x, point.z]);
        draw_stick_figure(&mut front_view, mechanism, &posture, |point| [point.y, point.z]);
    }
    for view in [&mut side_view, &mut front_view] {
        view.level(0.0, Pen::solid(EDGE, 1.0));
    }
    key_sticks(&mut front_view);
    let every = table.duration / (FIGURES - 1) as f64;
    let title = format!("Nominal half-step of {} s, figures every {:.0} ms", table.duration, every * 1e3);
    maps(
        &title,
        [side_view, front_view].map(|chart| Map { chart, scale: SCALE / LegReach::of(mechanism).scale() }).into(),
    )
}
