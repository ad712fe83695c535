//! Imports another biped from its URDF: see `docs/import.md`.
//!
//! A URDF has a zero posture in which the robot stands straight. There, joints are points and axes, and links are
//! masses, in one frame; what each joint does follows from its axis and its place in the tree, not from its name.
//! Whichever link the URDF's tree is rooted at, the mechanism's is rooted at the right foot.
//!
//! ```text
//! URDF ─▶ links, joints ─▶ two legs ─▶ facing ─▶ roles, waist, arms ─▶ biped ─▶ symmetry ─▶ mechanism file
//! map (optional): name, sole, motors, other roles, held angles
//! ```

mod arm;
mod arm_chain;
mod arm_pair;
mod biped;
mod body;
mod body_graph;
mod body_text;
mod drive;
mod facing;
mod file_errors;
mod grid;
mod held_bodies;
mod held_parts;
mod held_search;
mod held_text;
mod import_map;
mod leg_pair;
mod leg_roles;
mod map_text;
mod mechanism_link;
mod mechanism_text;
mod parts;
mod plausibility;
mod possible_moments;
mod posture;
mod range_pair;
mod report;
mod role;
mod sole;
mod symmetry;
mod toml_text;
mod urdf_format;
mod urdf_numbers;
mod urdf_reader;
mod urdf_robot;
mod urdf_tree;
mod waist;
mod xml_tree;

pub use file_errors::{ImportError, NamedText};
pub use role::{JointRole, LegRole};

use arm::ArmSearch;
use body_graph::BodyGraph;
use drive::Scale;
use file_errors::FileErrors;
use import_map::ImportMap;
use mechanism_text::Header;
use parts::Parts;
use posture::{Poses, held_angles};
use sole::contact_points;
use urdf_robot::UrdfRobot;

use crate::scaled_parameters::servos;

/// A biped imported from a URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Name of the robot.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Length of a stretched leg from hip to ankle (m).
    pub leg: f64,
    /// Height of the ankle above the sole (m).
    pub ankle_height: f64,
    /// The text of the mechanism file.
    pub text: String,
    /// The text of a complete map, with everything that was found.
    pub map: String,
    /// The joints that have a role, with their names in the URDF, in the order of the mechanism's numbers.
    pub roles: Vec<(JointRole, String)>,
    /// What was taken, assumed, held and changed, one text each, for users.
    pub lines: Vec<String>,
}

/// Imports a biped from its URDF; `map` adds what a URDF lacks, such as soles, and may overrule what is found.
///
/// # Errors
/// All mistakes in the URDF's links and joints with their lines; else all mistakes in the map; else everything that a
/// biped cannot have, with joint, value, and remedy.
pub fn import(urdf: NamedText, map: Option<NamedText>) -> Result<Imported, ImportError> {
    let robot = urdf_reader::read(urdf)?;
    let read = map.map(|map| ImportMap::read(map, &robot)).transpose().map_err(ImportError::new)?;
    let map = read.unwrap_or_default();
    let mut errors = FileErrors::new(urdf.file);
    let imported = import_robot(&robot, &map, urdf.file, &mut errors);
    errors.finish(imported)
}

/// The text of a complete map, with everything that an import finds: to be edited and given back.
///
/// # Errors
/// Those of [`import`].
pub fn print_map(urdf: NamedText, map: Option<NamedText>) -> Result<String, ImportError> {
    import(urdf, map).map(|imported| imported.map)
}

fn import_robot(robot: &UrdfRobot, map: &ImportMap, file: &str, errors: &mut FileErrors) -> Option<Imported> {
    let mut lines = Vec::new();
    let is_held = |joint: usize| map.held.iter().any(|(held, _)| *held == joint);
    let graph = BodyGraph::new(robot, |joint| robot.joints[joint].turns() && !is_held(joint));

    // where are the legs, and where does it face?
    let mut zero = vec![0.0; robot.joints.len()];
    map.held.iter().for_each(|(joint, angle)| zero[*joint] = *angle);
    let poses = Poses::at(robot, &zero);
    let legs = leg_pair::find(robot, map, &graph, &poses, errors)?;
    let (graph, legs) = legs.with_upper_body(robot, &graph);
    let facing = facing::find(robot, map, &legs, &graph.body_of, &poses, errors, &mut lines)?;
    let sides = [facing.right, 1 - facing.right];

    // what does each joint do?
    let standing = poses.seen_from(&facing.root_to_stand);
    let roles = leg_roles::find(robot, map, &legs, sides, &standing, errors);
    let waist = waist::find(robot, map, &graph, &legs, &standing, errors);
    let mut parts =
        Parts { robot, map, legs: &legs, sides, roles: roles?, waist: &waist, arms: None, poses: &standing };
    let scale = Scale { leg: parts.leg_length(), mass: robot.links.iter().map(|link| link.body.mass).sum() };
    let trunk = waist.joints.last().map_or(legs.pelvis, |(_, trunk)| *trunk);

    // and how is the rest held?
    let posture = |used: &[(JointRole, usize)], held: &[(usize, f64)]| {
        let mut angles = held_angles(robot, held);
        used.iter().for_each(|(_, joint)| angles[*joint] = 0.0);
        angles
    };
    let angles = posture(&parts.roles(), &map.held);
    let poses_at = |angles: &[f64]| Poses::at(robot, angles).seen_from(&facing.root_to_stand);
    let closed: Vec<usize> =
        waist.joints.iter().map(|(joint, _)| *joint).chain(legs.joints.map(|leg| leg[0])).collect();
    let chains = arm_chain::find(robot, &graph, trunk, &closed, &poses_at(&angles), scale.leg);
    let search = ArmSearch { robot, map, graph: &graph, poses: &poses_at, leg: scale.leg };
    let arms = arm_pair::find(search, &chains, &angles, scale, errors);
    parts.arms = arms.as_ref().ok();
    let of_arms = arms.iter().flatten().flat_map(|arm| &arm.held);
    let told: Vec<(usize, f64)> = map.held.iter().chain(of_arms).copied().collect();
    let used = parts.roles();
    let angles = posture(&used, &told);
    let poses = poses_at(&angles);
    parts.poses = &poses;
    let is_used = |joint: usize| used.iter().any(|(_, own)| *own == joint);
    let held: Vec<(usize, f64)> =
        (0..robot.joints.len()).filter(|j| robot.joints[*j].turns() && !is_used(*j)).map(|j| (j, angles[j])).collect();
    report::roles(robot, &used, sides.map(|leg| legs.joints[leg]), &waist, &mut lines);
    report::arms(robot, &arms, &mut lines);
    report::held(robot, map, &held, &used, &mut lines);

    // the robot itself
    parts.check_straight(errors);
    let biped = parts.biped(scale, errors, &mut lines);
    plausibility::check(scale, robot, &biped.as_ref().map_or(Vec::new(), report::bodies), errors);
    let mut biped = biped?;
    symmetry::symmetrise(&mut biped, robot, errors, &mut lines);
    possible_moments::repair(&mut biped, scale.leg, &mut lines);
    let held_parts = parts.held(&held, &biped, scale, &mut lines);
    let feet = sides.map(|leg| legs.bodies[leg][5]);
    let sole = map.sole.or_else(|| {
        let points = feet.map(|foot| contact_points(robot, &graph.body_of, foot, &poses.links));
        sole::read_off(&points, [0, 1].map(|side| biped.ankle(side)), &robot.links[feet[0]].name, errors, &mut lines)
    })?;
    let name = name(robot, map, file, &mut lines);
    if !errors.is_empty() {
        return None;
    }

    let of_trunk = robot.links.iter().zip(&graph.body_of).filter(|(_, body)| **body == trunk);
    let heaviest = of_trunk.max_by(|(one, _), (other, _)| one.body.mass.total_cmp(&other.body.mass));
    let header = Header {
        name: &name,
        urdf: base_name(file),
        trunk_link: heaviest.map_or("", |(link, _)| link.name.as_str()),
        root_to_stand: &facing.root_to_stand,
        sole,
        servos: servos(biped.mass(), scale.leg),
        armature: scale.armature(),
        held: &held,
        held_parts: &held_parts,
    };
    if map.motors.is_empty() {
        lines.push(format!("no rotor is told: an inertia of {:.3e} kg·m² is assumed at every joint", header.armature));
    }
    lines.insert(0, format!("{name}: {:.3} kg, legs of {:.3} m", biped.mass(), scale.leg));
    Some(Imported {
        mass: biped.mass(),
        leg: scale.leg,
        ankle_height: sole.ankle_height,
        text: mechanism_text::write(&biped, robot, map, &header),
        map: map_text::write(robot, map, &used, &header),
        roles: used.iter().map(|(role, joint)| (*role, robot.joints[*joint].name.clone())).collect(),
        name,
        lines,
    })
}

/// The map's name of the robot, else the URDF's, else the file's.
fn name(robot: &UrdfRobot, map: &ImportMap, file: &str, lines: &mut Vec<String>) -> String {
    if let Some(name) = &map.name {
        return name.clone();
    }
    let name = if robot.name.trim().is_empty() { base_name(file) } else { &robot.name };
    lines.push(format!("the map tells no name: called {name}"));
    name.to_string()
}

fn base_name(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}
