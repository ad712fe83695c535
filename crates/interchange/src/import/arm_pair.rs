//! Finds both arms, and whether they are each other's mirror image: one arm does not swing alone.

use model::Side;
use nalgebra::Vector3;

use crate::import::arm::{Arm, ArmSearch};
use crate::import::arm_chain::ArmChain;
use crate::import::drive::{self, DriveNotes, Scale};
use crate::import::file_errors::FileErrors;
use crate::import::posture::Poses;
use crate::import::role::JointRole;
use crate::import::symmetry::{ANGLE_MAX, DISTANCE_MAX};
use crate::side_name::side_name;

/// A smaller range that both sides share is none (rad).
const RANGE_MIN: f64 = 0.0175;

/// The right and the left arm, or in words why arms are held: an error, too, if the map names their joints.
///
/// * `chains` – the joints to the right and to the left of the trunk
/// * `angles` – of each joint of the URDF if no arm is found (rad)
pub(super) fn find(
    search: ArmSearch,
    chains: &[Option<ArmChain>; 2],
    angles: &[f64],
    scale: Scale,
    errors: &mut FileErrors,
) -> Result<[Arm; 2], String> {
    let told =
        search.map.joints.iter().find_map(|(role, joint)| Some((role, joint.urdf.filter(|_| role.is_in_arm())?)));
    both(search, chains, angles, scale).inspect_err(|why| {
        if let Some((role, joint)) = told {
            let joint = &search.robot.joints[joint];
            errors.note_at(joint.line, format!("joint {} as {}: {why}", joint.name, role.name()));
        }
    })
}

fn both(search: ArmSearch, chains: &[Option<ArmChain>; 2], angles: &[f64], scale: Scale) -> Result<[Arm; 2], String> {
    if *chains == [None, None] {
        return Err("nothing that turns branches off the trunk to either side".to_string());
    }
    let mut arms: Vec<Arm> = Vec::new();
    for (side, chain) in Side::BOTH.into_iter().zip(chains) {
        let name = side_name(side);
        let chain = chain.as_ref().ok_or_else(|| format!("there is no {name} arm"))?;
        let arm = search.arm(side, chain, angles, arms.first()).map_err(|why| format!("{name} arm: {why}"))?;
        check_drives(search, side, &arm, scale)?;
        arms.push(arm);
    }
    let Ok([right, left]) = <[Arm; 2]>::try_from(arms) else { return Err(String::new()) };
    let mut angles = angles.to_vec();
    right.held.iter().chain(&left.held).for_each(|(joint, angle)| angles[*joint] = *angle);
    let poses = (search.poses)(&angles);
    check_images(search, "shoulders", right.shoulder, left.shoulder, &poses)?;
    match (right.elbow, left.elbow) {
        (Some(right), Some(left)) => check_images(search, "elbows", right, left, &poses)?,
        (None, None) => {}
        (Some((joint, _)), None) | (None, Some((joint, _))) => {
            return Err(format!("only one has an elbow, {}", search.robot.joints[joint].name));
        }
    }
    Ok([right, left])
}

/// Checks that the limits of an arm's joints make sense.
fn check_drives(search: ArmSearch, side: Side, arm: &Arm, scale: Scale) -> Result<(), String> {
    let ArmSearch { robot, map, .. } = search;
    let elbow = arm.elbow.map(|(joint, _)| (JointRole::Elbow(side), joint));
    for (role, joint) in [(JointRole::Shoulder(side), arm.shoulder.0)].into_iter().chain(elbow) {
        let joint = &robot.joints[joint];
        drive::drive(joint, map.joint(role), &map.motors, scale, &mut DriveNotes::default())
            .map_err(|what| format!("joint {} as {}: {what}", joint.name, role.name()))?;
    }
    Ok(())
}

/// Checks that a joint of the right arm and one of the left are mirror images and share a range.
fn check_images(
    search: ArmSearch,
    name: &str,
    right: (usize, usize),
    left: (usize, usize),
    poses: &Poses,
) -> Result<(), String> {
    let joints = [right, left].map(|(joint, _)| &search.robot.joints[joint].name);
    let [(place, axis), (other_place, other_axis)] = [right, left].map(|(joint, _)| poses.joints[joint]);
    let image = Vector3::new(-other_axis.x, other_axis.y, -other_axis.z) * (axis.y * other_axis.y).signum();
    let angle = axis.angle(&image);
    let off = axis.cross(&(place - Vector3::new(other_place.x, -other_place.y, other_place.z))).norm();
    if angle > ANGLE_MAX || off > DISTANCE_MAX {
        return Err(format!(
            "the {name} {} and {} are no mirror images: their axes differ by {:.2}° and {:.1} mm, and may by 2° and 20 \
             mm",
            joints[0],
            joints[1],
            angle.to_degrees(),
            off * 1e3
        ));
    }
    let [own, other] = [right, left].map(|joint| search.range_about_y(joint, poses));
    if own[1].min(other[1]) - own[0].max(other[0]) < RANGE_MIN {
        return Err(format!("the {name} {} and {} share no range", joints[0], joints[1]));
    }
    Ok(())
}
