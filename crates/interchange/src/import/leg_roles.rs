//! What each joint of a leg does, by its axis and its place between pelvis and foot.

use model::Side;
use nalgebra::{Matrix3, Unit, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::import_map::ImportMap;
use crate::import::leg_pair::LegPair;
use crate::import::posture::Poses;
use crate::import::role::{JointRole, LegRole};
use crate::import::urdf_robot::UrdfRobot;
use crate::side_name::side_name;

/// Least cosine between an axis and the direction of its role.
const ALONG: f64 = 0.5;
/// Least volume that the three hip axes span, of 1.
const SPAN: f64 = 0.25;

/// The roles of both legs' joints from the pelvis down, which are the same on both sides; notes why there are none.
///
/// `sides` are the legs' indices in `legs`, right and left; `poses` those of the standing robot.
pub(super) fn find(
    robot: &UrdfRobot,
    map: &ImportMap,
    legs: &LegPair,
    sides: [usize; 2],
    poses: &Poses,
    errors: &mut FileErrors,
) -> Option<[LegRole; 6]> {
    let mut found = Vec::new();
    for (side, leg) in Side::BOTH.into_iter().zip(sides) {
        let joints = legs.joints[leg];
        let axes = joints.map(|joint| poses.joints[joint].1);
        let names = joints.map(|joint| robot.joints[joint].name.as_str());
        // What the map says is tried first; if it cannot be, it is told what there is instead.
        let roles = of_leg(&axes, &told_roles(map, side, &joints)).or_else(|_| of_leg(&axes, &[None; 6]));
        let roles =
            match roles {
                Ok(roles) => roles,
                Err(what) => {
                    errors.note_at(robot.joints[joints[0]].line, format!(
                    "{} leg, from the pelvis down {}: {what}; this is so at the URDF's zero, where the robot must \
                     stand straight, z up",
                    side_name(side),
                    names.join(", ")
                ));
                    continue;
                }
            };
        for (role, joint) in leg_joints(map, side) {
            let is = joints.iter().position(|other| *other == joint).map(|place| roles[place]);
            if is != Some(role) {
                let is =
                    is.map_or("not in that leg".to_string(), |is| format!("the {}_{}", side_name(side), is.name()));
                let name = &robot.joints[joint].name;
                let must = "by its axis and its place between pelvis and foot; map it so, or leave it out of the map";
                let role = JointRole::Leg(side, role).name();
                let line = robot.joints[joint].line;
                errors.note_at(line, format!("joint {name} as {role}: it is {is} {must}"));
            }
        }
        found.push(roles);
    }
    let &[right, left] = found.as_slice() else { return None };
    if right != left {
        let names = |roles: [LegRole; 6]| roles.map(LegRole::name).join(", ");
        errors.note(format!(
            "both legs must have their joints in the same order, from the pelvis down: the right one has {}, the left \
             one {}",
            names(right),
            names(left)
        ));
        return None;
    }
    Some(right)
}

/// The roles that the map gives to joints of the URDF in one leg.
fn leg_joints(map: &ImportMap, side: Side) -> impl Iterator<Item = (LegRole, usize)> {
    map.joints.iter().filter_map(move |(role, joint)| match role {
        JointRole::Leg(of, role) if *of == side => Some((*role, joint.urdf?)),
        _ => None,
    })
}

fn told_roles(map: &ImportMap, side: Side, joints: &[usize; 6]) -> [Option<LegRole>; 6] {
    joints.map(|joint| leg_joints(map, side).find(|(_, other)| *other == joint).map(|(role, _)| role))
}

/// The roles of one leg's joints; the map's come first.
fn of_leg(axes: &[Unit<Vector3<f64>>; 6], told: &[Option<LegRole>; 6]) -> Result<[LegRole; 6], String> {
    use LegRole::*;
    let hips = [
        [HipYaw, HipRoll, HipPitch],
        [HipYaw, HipPitch, HipRoll],
        [HipRoll, HipYaw, HipPitch],
        [HipRoll, HipPitch, HipYaw],
        [HipPitch, HipYaw, HipRoll],
        [HipPitch, HipRoll, HipYaw],
    ];
    let ankles = [[AnklePitch, AnkleRoll], [AnkleRoll, AnklePitch]];
    let hip = best(&axes[..3], &told[..3], &hips);
    let ankle = best(&axes[4..], &told[4..], &ankles);
    let axis = |place: usize| {
        let axis = axes[place];
        format!("[{:.3}, {:.3}, {:.3}]", axis.x, axis.y, axis.z)
    };
    let Some(hip) = hip.filter(|_| {
        Matrix3::from_columns(&[axes[0].into_inner(), axes[1].into_inner(), axes[2].into_inner()]).determinant().abs()
            > SPAN
    }) else {
        let [first, second, third] = [0, 1, 2].map(axis);
        return Err(format!(
            "the first three must be the hip's, one about each of x, y and z (x ahead, y left, z up), in any order, at \
             most 60° off; their axes are {first}, {second}, {third}"
        ));
    };
    if axes[3].y.abs() < 0.85 {
        return Err(format!("the fourth must be the knee, and turn about y (left); its axis is {}", axis(3)));
    }
    let Some(ankle) = ankle else {
        let [first, second] = [4, 5].map(axis);
        return Err(format!(
            "the last two must be the ankle's, one about y (left) and one about x (ahead), in any order; their axes \
             are {first}, {second}"
        ));
    };
    Ok([hip[0], hip[1], hip[2], Knee, ankle[0], ankle[1]])
}

/// The order of roles that matches axes best, of those that the map allows.
fn best<const N: usize>(
    axes: &[Unit<Vector3<f64>>],
    told: &[Option<LegRole>],
    orders: &[[LegRole; N]],
) -> Option<[LegRole; N]> {
    let along = |order: &[LegRole; N]| -> Vec<f64> {
        axes.iter().zip(order).map(|(axis, role)| axis[role.axis()].abs()).collect()
    };
    let sum = |order: &[LegRole; N]| -> f64 { along(order).iter().sum() };
    let allowed = |order: &&[LegRole; N]| {
        let fits = told.iter().zip(order.iter()).all(|(told, role)| told.is_none_or(|told| told == *role));
        fits && along(order).iter().all(|along| *along >= ALONG)
    };
    orders.iter().filter(allowed).max_by(|a, b| sum(a).total_cmp(&sum(b))).copied()
}
