//! Makes legs fit the leg kinematics: hip and ankle turn about one point each, and a straight leg is vertical.
//!
//! Moving a joint along its own axis changes nothing. The rest changes the robot, and is done only as far as the map
//! allows: axes move, masses stay where they are.

use model::{Joint, Side};
use nalgebra::Vector3;

use crate::import::file_errors::FileErrors;
use crate::import::joint_map::Idealise;
use crate::import::straight_biped::{StraightBiped, up};

/// Rounding of a URDF's decimals (m).
const ROUNDING: f64 = 1e-9;

/// Moves the axes of both legs.
pub(super) fn straighten(
    biped: &mut StraightBiped,
    idealise: &Idealise,
    errors: &mut FileErrors,
    changes: &mut Vec<String>,
) {
    for side in Side::BOTH {
        let [ankle_roll, ankle_pitch, knee, hip_pitch, hip_yaw, hip_roll] = leg(side);
        let place = |joint: Joint| biped.hinges[joint].place;
        // The pitch axes define the leg's lengths, the hip's yaw axis its plane.
        let hip = Vector3::new(place(hip_pitch).x, place(hip_yaw).y, place(hip_pitch).z);
        let below = |joint: Joint| Vector3::new(hip.x, hip.y, place(joint).z);
        let wanted = [
            (ankle_roll, below(ankle_pitch)),
            (ankle_pitch, below(ankle_pitch)),
            (knee, below(knee)),
            (hip_pitch, hip),
            (hip_yaw, hip),
            (hip_roll, hip),
        ];
        for (joint, wanted) in wanted {
            move_axis(biped, joint, wanted, idealise, errors, changes);
        }
    }
}

fn move_axis(
    biped: &mut StraightBiped,
    joint: Joint,
    wanted: Vector3<f64>,
    idealise: &Idealise,
    errors: &mut FileErrors,
    changes: &mut Vec<String>,
) {
    let hinge = &mut biped.hinges[joint];
    let off = hinge.axis.cross(&(wanted - hinge.place)).norm();
    hinge.place = wanted;
    if off > idealise.axes_moved_max.max(ROUNDING) {
        errors.note(format!(
            "{}: its axis is {:.1} mm off; the axes of hip and ankle must meet in one point each, hip, knee and ankle \
             stand \
             above each other: allow to move it with idealise.axes_moved_max_m = {}",
            joint.name(),
            off * 1e3,
            up(off, 1e4)
        ));
    } else if off > ROUNDING {
        changes.push(format!("{}: axis moved by {:.1} mm", joint.name(), off * 1e3));
    }
}

/// The joints of a leg from the foot up.
fn leg(side: Side) -> [Joint; 6] {
    use Joint::*;
    match side {
        Side::Right => [RightAnkleRoll, RightAnklePitch, RightKnee, RightHipPitch, RightHipYaw, RightHipRoll],
        Side::Left => [LeftAnkleRoll, LeftAnklePitch, LeftKnee, LeftHipPitch, LeftHipYaw, LeftHipRoll],
    }
}
