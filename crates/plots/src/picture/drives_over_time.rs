//! Torques and currents of the drives over time.

use model::{Joint, Mechanism, Motor};

use super::chart::Pen;
use super::colours::{EDGE, LEFT, RIGHT};
use super::joint_panels::{JointCurves, LimitLines, joint_panels};
use super::time_panel::{TimePanel, picture, whole_run};
use crate::run_log::{DriveRow, RunLog};

/// Height of a panel (px).
const HEIGHT: f64 = 150.0;
/// A limit of more than so many times the greatest torque of a joint is not drawn.
const LIMIT_NEAR: f64 = 3.0;

/// Torques of all joints, with the limits of their drives at standstill where they come near, and below the greatest
/// share of the voltage that the drives of a side use: with the back-EMF, that is what bounds a DC motor.
pub fn torques_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let limit = |joint| mechanism.links[joint].motor.map(|motor| [-motor.torque_max(), motor.torque_max()]);
    let curves = JointCurves {
        unit: "N·m",
        always: &[],
        below: Some(("expected by the plan", &|row, joint| row.expected_torques[joint])),
        above: ("motor torque", &|row, joint| row.torques[joint]),
        limits: Some(LimitLines { what: "limit at standstill", of: &limit, near: LIMIT_NEAR }),
    };
    let mut panels = joint_panels(log, mechanism, &curves);
    panels.extend(voltages(log, mechanism));
    picture("Torques at the joints", log, mechanism, whole_run(log), HEIGHT, panels)
}

/// The greatest share of their voltage that the DC motors of either leg use; `None` if the legs have others.
fn voltages(log: &RunLog, mechanism: &Mechanism) -> Option<TimePanel> {
    let share = |row: &DriveRow, joint: Joint| {
        let motor = mechanism.links[joint].motor.as_ref().and_then(Motor::dc)?;
        Some(motor.voltage(row.currents[joint], row.rates[joint]).abs() / motor.voltage_max)
    };
    let mut panel = TimePanel::new("voltage used [%]", &[0.0, 100.0]);
    let mut is_known = false;
    for (side, colour) in [(model::Side::Right, RIGHT), (model::Side::Left, LEFT)] {
        let name = if side == model::Side::Right { "right" } else { "left" };
        let leg = mechanism.leg(side);
        let greatest = |row: &DriveRow| leg.into_iter().filter_map(|joint| share(row, joint)).reduce(f64::max);
        let points: Vec<_> = log.drives.iter().filter_map(|row| Some([row.time, 100.0 * greatest(row)?])).collect();
        is_known |= !points.is_empty();
        panel.draw(&format!("{name} leg, most of its motors"), Pen::solid(colour, 1.0), points);
    }
    panel.level("all of the voltage", &[100.0], Pen::dashed(EDGE, 1.1));
    is_known.then_some(panel)
}

/// Measured currents of all joints with DC motors.
pub fn currents_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let curves = JointCurves {
        unit: "A",
        always: &[-1.0, 1.0],
        below: None,
        above: ("current", &|row, joint| row.currents[joint]),
        limits: None,
    };
    let panels = joint_panels(log, mechanism, &curves);
    picture("Motor currents", log, mechanism, whole_run(log), HEIGHT, panels)
}

/// Whether the robot has a motor whose current is known.
pub(super) fn has_currents(mechanism: &Mechanism) -> bool {
    mechanism.links.0.iter().filter_map(|link| link.motor).any(|motor| motor.dc().is_some())
}
