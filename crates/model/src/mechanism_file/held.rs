//! The held joints: `[[held]]`, and `parent_held` of the joints that they carry.
//!
//! With `urdf` and `at_deg` alone a joint is welded, as all held ones were until 0.1.0.

use config::Table;

use super::{body, joint_frame};
use crate::{Body, HeldJoint, HeldLink, Joint, Mechanism, PerJoint, TorqueSource};

/// Largest torque of a drive (N·m).
const EFFORT: (f64, f64) = (1e-6, 1e5);
/// Smallest and largest inertia of a rotor at its joint (kg·m²): without any, a joint without mass beyond it has no
/// dynamics.
const ARMATURE: (f64, f64) = (1e-9, 100.0);

/// Reads the held joints.
pub(super) fn read(root: &Table, joints: &PerJoint<Table>) -> Vec<HeldJoint> {
    let tables = root.tables("held");
    let names: Vec<&str> = tables.iter().map(|table| table.text("urdf")).collect();
    let mut held: Vec<HeldJoint> = Vec::new();
    let driven: Vec<(Joint, &str)> = joints
        .iter()
        .filter(|(_, table)| table.has("urdf"))
        .map(|(joint, table)| (joint, table.text("urdf")))
        .collect();
    for (index, (table, name)) in tables.iter().zip(&names).enumerate() {
        if let Some(other) = names[..index].iter().position(|other| other == name) {
            table.refuse("urdf", &format!("must be held once, and held[{other}] is that joint already"));
        } else if let Some((joint, _)) = driven.iter().find(|(_, driven)| driven == name) {
            table.refuse("urdf", &format!("must have no role, and joint.{} is that joint already", joint.name()));
        }
        let angle = table.angle("at_deg").between(-720.0, 720.0);
        let link = table.has("parent").then(|| link(table, &names, &tables, &held)).flatten();
        held.push(HeldJoint { name: (*name).to_string(), angle, link });
    }
    let links = held.iter().filter(|held| held.link.is_some()).count();
    if links > HeldLink::COUNT_MAX {
        root.refuse("held", &format!("must be at most {} with a parent, not {links}", HeldLink::COUNT_MAX));
    }
    for (joint, table) in joints.iter().filter(|(_, table)| table.has("parent_held")) {
        let carrier = carrier(table, &names, &tables);
        if let Some(link) = carrier.and_then(|place| held[place].link.as_mut()) {
            if table.has("parent") && table.text("parent") != link.mount.name() {
                table.refuse("parent_held", &format!("must be a held joint with the parent {}", table.text("parent")));
            }
            link.carries.push(joint);
        }
    }
    held
}

/// Notes links of the mechanism that are no bodies any more without those that are held, at the heaviest of these.
pub(super) fn check(root: &Table, mechanism: &Mechanism) {
    let Some(source) = mechanism.source.as_ref().filter(|source| !source.held.is_empty()) else { return };
    let tables = root.tables("held");
    if source.held.iter().zip(&tables).any(|(held, table)| held.link.is_none() && table.has("parent")) {
        // What is wrong about a link is told there.
        return;
    }
    let rest = mechanism.unlumped().mechanism;
    for joint in Joint::ALL {
        let mass_in =
            |held: &HeldJoint| held.link.as_ref().filter(|link| link.lumped_into == joint).map(|link| link.body.mass);
        let lumped = source.held.iter().zip(&tables).filter_map(|(held, table)| Some((mass_in(held)?, table)));
        let Some((_, table)) = lumped.max_by(|(one, _), (other, _)| one.total_cmp(other)) else { continue };
        let Body { mass, inertia, .. } = rest.links[joint].body;
        // What is no number is told where it stands.
        let is_known = mass.is_finite() && inertia.iter().all(|moment| moment.is_finite());
        let is_changed = is_known && mass != mechanism.links[joint].body.mass;
        if is_changed && mass != 0.0 && (mass < 0.0 || !body::is_possible(&inertia)) {
            let [x, y, z] = inertia.into();
            let left = format!("{mass:.3} kg, [{x:.3e}, {y:.3e}, {z:.3e}] kg·m²");
            let must = format!("must leave a body of joint.{} without those of held joints, not {left}", joint.name());
            table.refuse("mass_kg", &must);
        }
    }
}

fn link(table: &Table, names: &[&str], tables: &[Table], held: &[HeldJoint]) -> Option<HeldLink> {
    let joints = || Joint::ALL[1..].iter().map(|joint| (joint.name(), *joint));
    let mount = table.choice("parent", joints());
    let lumped_into = if table.has("lumped_into") { table.choice("lumped_into", joints()) } else { mount };
    let below = table.has("parent_held").then(|| carrier(table, names, &tables[..held.len()])).flatten();
    let (axis, origin) = joint_frame::read(table);
    let body = body::read(table);
    let effort = table.number("effort_n_m").between(EFFORT.0, EFFORT.1);
    let armature = table.number("armature_kg_m2").between(ARMATURE.0, ARMATURE.1);
    let (mount, lumped_into) = (mount?, lumped_into?);
    // What is wrong about the other one is told there.
    let other_mount = |place: usize| held[place].link.as_ref().map_or(mount, |link| link.mount);
    if below.is_some_and(|place| other_mount(place) != mount) {
        table.refuse("parent_held", &format!("must be a held joint with the parent {}", mount.name()));
    }
    Some(HeldLink {
        mount,
        below: below.filter(|place| other_mount(*place) == mount),
        axis,
        origin,
        body,
        lumped_into,
        carries: Vec::new(),
        drive: TorqueSource { effort, armature },
    })
}

/// The held joint that `parent_held` names: one of those tables that have a link.
fn carrier(table: &Table, names: &[&str], tables: &[Table]) -> Option<usize> {
    let with_link = tables.iter().enumerate().filter(|(_, table)| table.has("parent"));
    table.choice("parent_held", with_link.map(|(place, _)| (names[place], place)))
}
