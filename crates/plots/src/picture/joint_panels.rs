//! Panels over time for joints: one for each kind of joint, with the right and the left one.

use model::{Joint, Mechanism};

use super::chart::{Pen, Point};
use super::colours::{COM, COM_PLANNED, EDGE, LEFT, LEFT_PALE, RIGHT, RIGHT_PALE};
use super::time_panel::TimePanel;
use crate::run_log::{DriveRow, RunLog};

/// Kinds of joints from the feet up: the name, and the joint on either side or in the middle.
const KINDS: [(&str, &[Joint]); 10] = [
    ("ankle roll", &[Joint::RightAnkleRoll, Joint::LeftAnkleRoll]),
    ("ankle pitch", &[Joint::RightAnklePitch, Joint::LeftAnklePitch]),
    ("knee", &[Joint::RightKnee, Joint::LeftKnee]),
    ("hip pitch", &[Joint::RightHipPitch, Joint::LeftHipPitch]),
    ("hip yaw", &[Joint::RightHipYaw, Joint::LeftHipYaw]),
    ("hip roll", &[Joint::RightHipRoll, Joint::LeftHipRoll]),
    ("waist pitch", &[Joint::WaistPitch]),
    ("waist roll", &[Joint::WaistRoll]),
    ("shoulder", &[Joint::RightShoulder, Joint::LeftShoulder]),
    ("elbow", &[Joint::RightElbow, Joint::LeftElbow]),
];

/// What is drawn of a joint.
pub(super) struct JointCurves<'c> {
    /// Unit of the values.
    pub(super) unit: &'c str,
    /// Values that are always in the range of a panel.
    pub(super) always: &'c [f64],
    /// The wide pale curve under the other one, if there is one: what it is, and its value.
    pub(super) below: Option<(&'c str, Value<'c>)>,
    /// The thin curve: what it is, and its value.
    pub(super) above: (&'c str, Value<'c>),
    /// Dashed lines, if there are any.
    pub(super) limits: Option<LimitLines<'c>>,
}

/// Limits of a joint, drawn as dashed lines.
pub(super) struct LimitLines<'c> {
    /// What they are.
    pub(super) what: &'c str,
    /// The lower and the upper one of a joint.
    pub(super) of: &'c dyn Fn(Joint) -> Option<[f64; 2]>,
    /// A limit that is further than so many times the greatest value is left out: it would flatten the curves.
    pub(super) near: f64,
}

type Value<'c> = &'c dyn Fn(&DriveRow, Joint) -> f64;

/// A panel for each kind of joint that the robot has.
pub(super) fn joint_panels(log: &RunLog, mechanism: &Mechanism, curves: &JointCurves<'_>) -> Vec<TimePanel> {
    let kinds = KINDS.iter().filter(|(_, joints)| joints.iter().all(|joint| mechanism.has(*joint)));
    kinds.map(|(name, joints)| panel(log, name, joints, curves)).collect()
}

fn panel(log: &RunLog, name: &str, joints: &[Joint], curves: &JointCurves<'_>) -> TimePanel {
    let mut panel = TimePanel::new(&format!("{name} [{}]", curves.unit), curves.always);
    let points = |value: Value<'_>, joint: Joint| -> Vec<Point> {
        log.drives.iter().map(|row| [row.time, value(row, joint)]).collect()
    };
    let sides = [("right", RIGHT, RIGHT_PALE), ("left", LEFT, LEFT_PALE)];
    let looks = if joints.len() == 1 { &[("waist", COM, COM_PLANNED)][..] } else { &sides[..] };
    if let Some((what, value)) = curves.below {
        for (joint, (side, _, pale)) in joints.iter().zip(looks) {
            panel.draw(&format!("{side}, {what}"), Pen::solid(pale, 3.2), points(value, *joint));
        }
    }
    for (joint, (side, strong, _)) in joints.iter().zip(looks) {
        let (what, value) = curves.above;
        panel.draw(&format!("{side}, {what}"), Pen::solid(strong, 1.0), points(value, *joint));
    }
    let Some(LimitLines { what, of, near }) = &curves.limits else { return panel };
    let near = near * panel.greatest().max(f64::MIN_POSITIVE);
    let bounds: Vec<Option<[f64; 2]>> = joints.iter().map(|joint| of(*joint)).collect();
    let are_alike = bounds.iter().all(|bound| *bound == bounds[0]);
    for (bound, (side, strong, _)) in bounds.into_iter().zip(looks).take(if are_alike { 1 } else { joints.len() }) {
        let drawn: Vec<f64> = bound.into_iter().flatten().filter(|bound| bound.abs() <= near).collect();
        let (label, colour) = if are_alike { (what.to_string(), EDGE) } else { (format!("{side}, {what}"), *strong) };
        if !drawn.is_empty() {
            panel.include(&drawn);
            panel.level(&label, &drawn, Pen::dashed(colour, 1.0));
        }
    }
    panel
}
