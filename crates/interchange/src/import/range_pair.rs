//! Range, rate and torque that both sides share.

use crate::import::drive::JointDrive;
use crate::import::file_errors::FileErrors;
use crate::import::role::{JointRole, LegRole};

/// Rounding of a URDF's angles (rad).
const ROUNDING: f64 = 2e-4;
/// How far two ranges that are each other's reverse may differ (rad).
const SAME: f64 = 0.02;

/// The range of the mirrored joint on the other side. Up the right leg and down the left one, pitch changes its sign,
/// roll and yaw keep it; in the arms, which both lead outward, pitch keeps it.
pub(super) fn mirrored(role: JointRole, range: [f64; 2]) -> [f64; 2] {
    if role.axis() == 1 && !role.is_in_arm() { reversed(range) } else { range }
}

fn reversed([low, high]: [f64; 2]) -> [f64; 2] {
    [-high, -low]
}

/// What both sides can do, in the right one's sign: the range that they share, the smaller rate, the smaller torque.
pub(super) fn mean(
    role: JointRole,
    right: &JointDrive,
    left: &JointDrive,
    errors: &mut FileErrors,
    lines: &mut Vec<String>,
) -> JointDrive {
    let name = role.name_of_both();
    let (own, image) = (right.range, mirrored(role, left.range));
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < SAME;
    let shared = [own[0].max(image[0]), own[1].min(image[1])];
    let words = |[low, high]: [f64; 2]| format!("{:.1}° to {:.1}°", low.to_degrees(), high.to_degrees());
    let range = if !near(own, image) && near(own, reversed(image)) && bends(role) != 0.0 {
        // One side's signs are wrong.
        let natural = bends(role) * (own[0] + own[1]) > 0.0;
        let (taken, wrong) = if natural { (own, "left") } else { (image, "right") };
        lines.push(format!(
            "{name}: the URDF's ranges of right and left contradict each other, as if the {wrong} one's axis had the \
             wrong sign; taken {} for the right one, the way such a joint bends",
            words(taken)
        ));
        taken
    } else {
        if is_empty(shared) {
            let (own, image) = (words(own), words(image));
            errors.note(format!("{name}: right and left share no range: right {own}, left, mirrored, {image}"));
        } else if !near_exactly(own, image) {
            let (own, image, shared) = (words(own), words(image), words(shared));
            lines
                .push(format!("{name}: range {shared}, which both sides share (right {own}, left, mirrored, {image})"));
        }
        shared
    };
    let differ = |a: f64, b: f64| (a - b).abs() > 1e-6 * a.max(b);
    let (rate_max, effort) = (right.rate_max.min(left.rate_max), right.effort.min(left.effort));
    if differ(right.rate_max, left.rate_max) {
        lines.push(format!("{name}: rate {:.1} °/s, the smaller one of both sides", rate_max.to_degrees()));
    }
    if differ(right.effort, left.effort) && right.motor.is_none() {
        lines.push(format!("{name}: torque {effort} N·m, the smaller one of both sides"));
    }
    if right.motor != left.motor {
        errors.note(format!("{name}: right and left must have the same motor in the map, or both none"));
    }
    JointDrive { range, rate_max, effort, motor: right.motor }
}

/// The part of a range in the middle of the robot that is the same to both sides.
pub(super) fn of_both_sides(own: [f64; 2], name: &str, errors: &mut FileErrors, lines: &mut Vec<String>) -> [f64; 2] {
    let shared = [own[0].max(-own[1]), own[1].min(-own[0])];
    let words = |[low, high]: [f64; 2]| format!("{:.1}° to {:.1}°", low.to_degrees(), high.to_degrees());
    if is_empty(shared) {
        errors.note(format!("{name}: must move to both sides; its range is {}", words(own)));
    } else if !near_exactly(own, shared) {
        lines.push(format!("{name}: range {}, the same to both sides (told: {})", words(shared), words(own)));
    }
    shared
}

/// Whether nothing remains of a range but rounding.
fn is_empty([low, high]: [f64; 2]) -> bool {
    high - low < ROUNDING
}

fn near_exactly(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < ROUNDING
}

/// To which side a joint of the right leg bends farther: knees backward (negative), hips forward and outward, ankles
/// with the toes up; 0 if nobody can tell.
fn bends(role: JointRole) -> f64 {
    match role {
        JointRole::Leg(_, LegRole::Knee) => -1.0,
        JointRole::Leg(_, LegRole::HipPitch | LegRole::HipRoll | LegRole::AnklePitch) => 1.0,
        _ => 0.0,
    }
}
