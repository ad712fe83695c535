//! Zero-moment point and commands over time.

use model::Mechanism;

use super::chart::Pen;
use super::colours::{COM, EDGE, LEFT, PLANNED, RIGHT, ZMP};
use super::time_panel::{TimePanel, picture, whole_run};
use crate::run_log::{ControllerRow, RunLog};

/// Height of a panel (px).
const HEIGHT: f64 = 175.0;

/// Draws four panels over one time axis: the point in support coordinates, and the commands.
pub fn zmp_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let sole = &mechanism.sole;
    let rows = &log.controller;
    let edge = Pen::dashed(EDGE, 1.2);
    let (planned, measured) = (Pen::solid(PLANNED, 2.0), Pen::solid(ZMP, 0.8));

    let on_sole = |row: &ControllerRow| row.zmp_planned.filter(|_| row.is_off_support_changes());
    let mut zmp_x = TimePanel::usual("ZMP x [m]", &[-sole.behind, sole.ahead]);
    zmp_x.draw_of("planned, off the swaps", planned, rows, |row| on_sole(row).map(|zmp| zmp.x));
    zmp_x.draw_of("measured", measured, rows, |row| row.zmp_measured.map(|zmp| zmp.x));
    zmp_x.level("sole's edges", &[-sole.behind, sole.ahead], edge);

    // Both soles have the same edges where these are as far from the ankle on both sides.
    let mut edges_aside = vec![-sole.outside, -sole.inside, sole.inside, sole.outside];
    edges_aside.sort_by(f64::total_cmp);
    edges_aside.dedup();
    let mut zmp_y = TimePanel::usual("ZMP y, to the left [m]", &edges_aside);
    zmp_y.draw_of("planned, off the swaps", planned, rows, |row| on_sole(row).map(|zmp| zmp.y));
    zmp_y.draw_of("measured", measured, rows, |row| row.zmp_measured.map(|zmp| zmp.y));
    zmp_y.level("sole's edges", &edges_aside, edge);

    let mut angles = TimePanel::new("command [°]", &[-5.0, 5.0]);
    angles.draw_of("turn [°]", Pen::solid(RIGHT, 2.0), rows, |row| Some(row.turn_command.to_degrees()));
    angles.draw_of("extension [°]", Pen::solid(LEFT, 2.0), rows, |row| Some(row.extension_command.to_degrees()));
    angles.draw_of("sidestep [°]", Pen::solid(COM, 2.0), rows, |row| Some(row.sidestep_command.to_degrees()));

    let mut speed = TimePanel::new("speed c [1]", &[0.9, 1.1]);
    speed.draw_of("speed in force", Pen::dashed(PLANNED, 1.4), rows, |row| Some(row.speed_command));
    speed.draw_of("speed now", Pen::solid(COM, 2.0), rows, |row| Some(row.speed));

    let panels = vec![zmp_x, zmp_y, angles, speed];
    picture("ZMP in the support sole, and commands", log, mechanism, whole_run(log), HEIGHT, panels)
}
