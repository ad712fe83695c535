//! Reading a mechanism from its file (`config/mechanism.toml`), strictly.
//!
//! All mistakes are reported at once, each with line, key, value and what would be right: see [`config`].

mod body;
mod drive;
mod fingerprint;
mod held;
mod joint_frame;
mod servo;
mod sole;
mod source;
mod symmetry;

use config::{Config, Table};
use nalgebra::Vector3;

use crate::{Body, DcMotor, Joint, JointOrder, Link, Mechanism, PerJoint, Side, Sole};

/// Beside keys and values that are wrong by themselves, a file is refused for a broken tree, axes that are not unit
/// vectors, impossible inertias, joints faster than their motors, and a robot that is not left–right symmetric.
impl Config for Mechanism {
    fn read(root: &Table) -> Self {
        let name = root.text("name").to_string();
        let sole = Sole::read(&root.table("sole"));
        let motors = DcMotor::read_all(root);
        let joint_table = root.table("joint");
        let tables = PerJoint::from_fn(|joint| joint_table.table(joint.name()));
        let links = PerJoint::from_fn(|joint| link(joint, &tables[joint], &motors));
        let order = order(&tables, &links);
        let servos = servo::read(root);
        let source = source::read(root, &tables);

        let mut mechanism = Mechanism { name, links, order, sole, servos, source, fingerprint: 0, body_fingerprint: 0 };
        if stands_on_its_sole(&tables, &mechanism) {
            symmetry::check(&tables, &mechanism);
            held::check(root, &mechanism);
        }
        (mechanism.fingerprint, mechanism.body_fingerprint) = fingerprint::of(&mechanism);
        mechanism
    }
}

fn link(joint: Joint, table: &Table, motors: &[(&str, DcMotor)]) -> Link {
    let number = f64::from(joint.number());
    table.number("number").that(|value| value == number, &format!("must be {number}, the number of {}", joint.name()));
    let parent = parent(joint, table);
    let (axis, origin) = joint_frame::read(table);

    // Between foot and ground there is no body, only an axis.
    let body = if joint == Joint::FootRoll { Body::NONE } else { body::read(table) };
    let (limits, motor) = if drive::is_present(joint, table) { drive::read(table, motors) } else { (None, None) };
    Link { parent, axis, origin, body, limits, motor }
}

/// The joint's parent; `None` for the ground.
fn parent(joint: Joint, table: &Table) -> Option<Joint> {
    let name = table.text("parent");
    let parent = Joint::from_name(name);
    let (right, must) = match neighbours(joint) {
        _ if joint == Joint::FootRoll => {
            (name == "ground", "must be \"ground\": the tree stands on this joint".to_string())
        }
        Some(neighbours) => {
            let others: Vec<String> = neighbours
                .iter()
                .filter(|other| **other != joint)
                .map(|other| format!("\"{}\"", other.name()))
                .collect();
            (
                parent.is_some_and(|parent| parent != joint && neighbours.contains(&parent)),
                format!("must be {}: the legs are one chain from foot to foot", others.join(" or ")),
            )
        }
        // A waist may roll first.
        None if joint == Joint::WaistPitch && parent == Some(Joint::WaistRoll) => (true, String::new()),
        None => (
            parent.is_some_and(|parent| parent < joint),
            format!("must name a joint that comes before this one (numbers 1 to {})", joint.index()),
        ),
    };
    if !right && !name.is_empty() {
        table.refuse("parent", &must);
    }
    parent.filter(|_| right)
}

/// The joints of a leg that a joint of a leg may be next to on the side of the right foot: hips and ankles have their
/// joints in any order.
fn neighbours(joint: Joint) -> Option<&'static [Joint]> {
    use Joint::*;
    Some(match joint {
        FootRoll | FootPitch => &[FootRoll],
        RightAnkleRoll | RightAnklePitch => &[FootPitch, RightAnkleRoll, RightAnklePitch],
        RightKnee => &[RightAnkleRoll, RightAnklePitch],
        RightHipPitch | RightHipYaw | RightHipRoll => &[RightKnee, RightHipPitch, RightHipYaw, RightHipRoll],
        LeftHipRoll | LeftHipYaw | LeftHipPitch => {
            &[RightHipPitch, RightHipYaw, RightHipRoll, LeftHipRoll, LeftHipYaw, LeftHipPitch]
        }
        LeftKnee => &[LeftHipRoll, LeftHipYaw, LeftHipPitch],
        LeftAnklePitch | LeftAnkleRoll => &[LeftKnee, LeftAnklePitch, LeftAnkleRoll],
        WaistPitch | WaistRoll | RightShoulder | RightElbow | LeftShoulder | LeftElbow => return None,
    })
}

/// The joints with parents first; that of the paper's robot after noting what is no tree.
fn order(tables: &PerJoint<Table>, links: &PerJoint<Link>) -> JointOrder {
    let parents = PerJoint::from_fn(|joint| links[joint].parent);
    let found = JointOrder::from_parents(&parents);
    // A parent that is missing or wrong by itself has been noted already.
    if found.is_none() && Joint::ALL[1..].iter().all(|joint| parents[*joint].is_some()) {
        let legs = &Joint::ALL[1..JointOrder::UP_TO_LEFT_FOOT];
        let twice = legs.iter().rev().find_map(|joint| {
            let same = legs.iter().find(|other| *other < joint && parents[**other] == parents[*joint])?;
            Some((*joint, format!("is that of {}, too: the legs must be one chain from foot to foot", same.name())))
        });
        let (joint, must) = twice.unwrap_or((Joint::WaistPitch, "must lead to the pelvis".to_string()));
        tables[joint].refuse("parent", &must);
    }
    found.unwrap_or(JointOrder::OF_THE_PAPER)
}

/// Whether the robot stands with its right ankle above O: the unpowered joints at O, the ankle at the sole's height.
/// Notes what is not so.
fn stands_on_its_sole(tables: &PerJoint<Table>, mechanism: &Mechanism) -> bool {
    for joint in [Joint::FootRoll, Joint::FootPitch] {
        if mechanism.links[joint].origin.norm() > 0.0 {
            tables[joint].refuse("origin_m", "must be [0, 0, 0]: the foot tips about O, under the ankle");
        }
    }
    let (height, ankle) = (mechanism.sole.ankle_height, ankle_over_sole(mechanism));
    let is_over = (ankle - Vector3::new(0.0, 0.0, height)).norm() <= 1e-8;
    if !is_over && ankle.iter().all(|place| place.is_finite()) && height.is_finite() {
        let must = if mechanism.leg(Side::Right)[0] == Joint::RightAnkleRoll {
            format!("must be [0, 0, {height}]: sole.ankle_height_m above the sole")
        } else {
            format!("must put the ankle at [0, 0, {height}], not at [{}, {}, {}]", ankle.x, ankle.y, ankle.z)
        };
        tables[mechanism.leg(Side::Right)[0]].refuse("origin_m", &must);
        return false;
    }
    true
}

/// The right ankle over O: where the pitch axis is along x and z, and the roll axis across (m).
fn ankle_over_sole(mechanism: &Mechanism) -> Vector3<f64> {
    let [first, second, ..] = mechanism.leg(Side::Right);
    let near = mechanism.links[first].origin;
    let far = near + mechanism.links[second].origin;
    let (pitch, roll) = if first == Joint::RightAnklePitch { (near, far) } else { (far, near) };
    Vector3::new(pitch.x, roll.y, pitch.z)
}
