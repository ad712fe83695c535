//! Compensation over time: angles that plan and feedback add to the sum of the modifications, at the joints at which
//! the paper adds its leans.

use model::Mechanism;

use super::chart::Pen;
use super::colours::DIVERGENT;
use super::time_panel::{TimePanel, picture, whole_run};
use crate::run_log::RunLog;

/// Height of a panel (px).
const HEIGHT: f64 = 190.0;

/// Three panels: the support ankle about x and about y, and the waist.
pub fn compensation_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let rows = &log.controller;
    let (plan, feedback) = (Pen::solid("#333333", 2.0), Pen::solid(DIVERGENT, 0.7));
    let always = [-1.0, 1.0];

    let mut roll = TimePanel::new("ankle roll [°]", &always);
    roll.draw_of("added by feedback", feedback, rows, |row| Some(row.lean_roll.to_degrees()));
    roll.draw_of("added by the plan", plan, rows, |row| row.added.map(|added| added.ankle.x.to_degrees()));

    let mut pitch = TimePanel::new("ankle pitch [°]", &always);
    pitch.draw_of("added by feedback", feedback, rows, |row| Some(row.lean_pitch.to_degrees()));
    pitch.draw_of("added by the plan", plan, rows, |row| row.added.map(|added| added.ankle.y.to_degrees()));

    let mut waist = TimePanel::new("waist [°]", &always);
    waist.draw_of("waist: roll", plan, rows, |row| row.added.map(|added| added.waist.x.to_degrees()));
    let dashed = Pen::dashed("#333333", 2.0);
    waist.draw_of("waist: pitch", dashed, rows, |row| row.added.map(|added| added.waist.y.to_degrees()));

    let panels = vec![roll, pitch, waist];
    picture("Angles added at support ankle and waist", log, mechanism, whole_run(log), HEIGHT, panels)
}
