//! Joints over time: where they were to be, where they were, and how far they may go.

use model::Mechanism;

use super::joint_panels::{JointCurves, LimitLines, joint_panels};
use super::time_panel::{picture, whole_run};
use crate::run_log::RunLog;

/// Height of a panel (px).
const HEIGHT: f64 = 150.0;
/// Height of a panel of errors, which has no ranges (px).
const ERROR_HEIGHT: f64 = 110.0;

/// Angles of all joints: asked for, measured, and the ends of their ranges.
pub fn joints_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let range = |joint| {
        let limits = mechanism.links[joint].limits?;
        Some([limits.angle_min, limits.angle_max].map(f64::to_degrees))
    };
    let curves = JointCurves {
        unit: "°",
        always: &[],
        below: Some(("setpoint", &|row, joint| row.asked_angles[joint].to_degrees())),
        above: ("measured", &|row, joint| row.angles[joint].to_degrees()),
        limits: Some(LimitLines { what: "end of the range", of: &range, near: f64::INFINITY }),
    };
    let panels = joint_panels(log, mechanism, &curves);
    picture("Joint angles, physical signs", log, mechanism, whole_run(log), HEIGHT, panels)
}

/// How far the joints are from where they were to be.
pub fn joint_errors_over_time(log: &RunLog, mechanism: &Mechanism) -> String {
    let curves = JointCurves {
        unit: "°",
        always: &[-0.1, 0.1],
        below: None,
        above: ("setpoint less measured", &|row, joint| (row.asked_angles[joint] - row.angles[joint]).to_degrees()),
        limits: None,
    };
    let panels = joint_panels(log, mechanism, &curves);
    picture("Errors of the joint angles", log, mechanism, whole_run(log), ERROR_HEIGHT, panels)
}
