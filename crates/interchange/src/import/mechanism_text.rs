//! Writes an imported biped as the text of a mechanism file.

use model::{Servos, Side, Sole};
use nalgebra::{Isometry3, Unit, Vector3};

use crate::import::biped::{Biped, Hinge, Segment};
use crate::import::body_text::body;
use crate::import::grid::Grid;
use crate::import::held_parts::HeldParts;
use crate::import::held_text;
use crate::import::import_map::ImportMap;
use crate::import::role::JointRole;
use crate::import::toml_text::{COARSE, FINE, Keys, array, digits, number, quoted, table, vector};
use crate::import::urdf_robot::UrdfRobot;

/// What the file says beside the biped.
pub(super) struct Header<'h> {
    pub name: &'h str,
    /// File name of the URDF.
    pub urdf: &'h str,
    /// Name of the URDF's link that is the trunk.
    pub trunk_link: &'h str,
    /// Maps coordinates of the URDF's root link to those of the standing robot.
    pub root_to_stand: &'h Isometry3<f64>,
    pub sole: Sole,
    /// Servos of the drives: a URDF tells none.
    pub servos: Servos,
    /// Inertia of a rotor at its joint (kg·m²), for joints without a motor.
    pub armature: f64,
    /// Joints that are held, by index, with their angles (rad), and their links.
    pub held: &'h [(usize, f64)],
    pub held_parts: &'h HeldParts,
}

/// Writes the file's text.
pub(super) fn write(biped: &Biped, robot: &UrdfRobot, map: &ImportMap, header: &Header) -> String {
    let mut text = format!(
        "# Made by `halfstep import`. Frames, units and signs: as in Halfstep's own config/mechanism.toml.\n\n\
         name = {}\n",
        quoted(header.name)
    );
    table(&mut text, "[source]", &source(biped, header));
    write_sole(&mut text, &header.sole);
    write_motors(&mut text, map);
    for (joints, servo) in [("legs_and_waist", header.servos.legs_and_waist), ("arms", header.servos.arms)] {
        let gains = [("stiffness_n_m_per_rad", servo.stiffness), ("damping_n_m_s_per_rad", servo.damping)];
        table(&mut text, &format!("[servo.{joints}]"), &gains.map(|(key, gain)| (key, gain.to_string())));
    }

    let ankle = biped.ankle(0);
    let floor = Vector3::new(ankle.x, ankle.y, ankle.z - header.sole.ankle_height);
    let grid = Grid { floor };
    let ground = grid.at(floor);
    let foot = grid.at(floor);
    let unused = |axis: Vector3<f64>| Unit::new_unchecked(axis);
    let carrier = |name: &str| held_text::carrier(header.held_parts, robot, name);
    let mut places = vec![("foot_pitch".to_string(), foot)];
    joint(&mut text, "foot_roll", 1, "ground", &unused(Vector3::x()), ground.to(ground), Vec::new());
    let right_foot = body(&grid, &biped.legs[0][5].body, foot);
    joint(&mut text, "foot_pitch", 2, "foot_roll", &unused(Vector3::y()), ground.to(foot), right_foot);

    // Up the right leg each joint carries the body above it, down the left leg the one below it.
    let (mut parent, mut at) = ("foot_pitch".to_string(), foot);
    for (side, place) in (0..6).rev().map(|place| (0, place)).chain((0..6).map(|place| (1, place))) {
        let hinge = &biped.legs[side][place].hinge;
        let carried = match (side, place) {
            (0, 0) => &biped.pelvis,
            (0, _) => &biped.legs[0][place - 1].body,
            _ => &biped.legs[1][place].body,
        };
        let role = JointRole::Leg(Side::BOTH[side], biped.roles[place]);
        let here = grid.at(hinge.place);
        let mut keys = body(&grid, carried, here);
        keys.extend(drive(hinge, robot, map, header));
        keys.extend(carrier(&role.name()));
        joint(&mut text, &role.name(), role.number(), &parent, &hinge.axis, at.to(here), keys);
        (parent, at) = (role.name(), here);
        places.push((role.name(), here));
    }

    let pelvis = JointRole::Leg(Side::Right, biped.roles[0]).name();
    let pelvis_at = grid.at(biped.legs[0][0].hinge.place);
    let waist_at = biped.waist.map_or([biped.mount; 2], |waist| waist.map(|hinge| hinge.place));
    let [pitch_at, roll_at] = waist_at.map(|place| grid.at(place));
    let axes = biped.waist.map_or([unused(Vector3::y()), unused(Vector3::x())], |waist| waist.map(|hinge| hinge.axis));
    let drives = biped.waist.map(|waist| waist.map(|hinge| drive(&hinge, robot, map, header)));
    let [pitch_drive, roll_drive] = drives.unwrap_or_default();
    places.extend([("waist_pitch".to_string(), pitch_at), ("waist_roll".to_string(), roll_at)]);
    let keys = [body(&grid, &biped.middle, pitch_at), pitch_drive, carrier("waist_pitch")].concat();
    joint(&mut text, "waist_pitch", 15, &pelvis, &axes[0], pelvis_at.to(pitch_at), keys);
    let keys = [body(&grid, &biped.trunk, roll_at), roll_drive, carrier("waist_roll")].concat();
    joint(&mut text, "waist_roll", 16, "waist_pitch", &axes[1], pitch_at.to(roll_at), keys);
    for (side, arm) in Side::BOTH.into_iter().zip(&biped.arms) {
        let (mut parent, mut at) = (JointRole::WaistRoll.name(), roll_at);
        for (place, role) in JointRole::of_arm(side).into_iter().enumerate() {
            let (here, axis, keys) = match arm.get(place) {
                Some(Segment { hinge, body: carried }) => {
                    let here = grid.at(hinge.place);
                    let carrier = carrier(&role.name());
                    let keys = [body(&grid, carried, here), drive(hinge, robot, map, header), carrier].concat();
                    (here, hinge.axis, keys)
                }
                None => (at, unused(Vector3::y()), Vec::new()),
            };
            joint(&mut text, &role.name(), role.number(), &parent, &axis, at.to(here), keys);
            (parent, at) = (role.name(), here);
            places.push((role.name(), here));
        }
    }
    held_text::write(&mut text, header.held_parts, robot, &grid, &places, header.armature);
    text
}

/// Where the robot came from.
fn source(biped: &Biped, header: &Header) -> Keys {
    let turn = header.root_to_stand.rotation;
    let sole = |side: usize| {
        let over_ground = biped.ankle(side) - Vector3::z() * header.sole.ankle_height;
        let in_root = header.root_to_stand.inverse_transform_point(&over_ground.into());
        vector(&in_root.coords, COARSE)
    };
    vec![
        ("urdf", quoted(header.urdf)),
        ("trunk_link", quoted(header.trunk_link)),
        ("root_to_stand_wxyz", array([turn.w, turn.i, turn.j, turn.k].map(|part| number(part, FINE)))),
        ("right_sole_m", sole(0)),
        ("left_sole_m", sole(1)),
    ]
}

/// Writes the table of the sole.
pub(super) fn write_sole(text: &mut String, sole: &Sole) {
    let keys: Vec<(&str, String)> = sole.keys().into_iter().map(|(key, value)| (key, number(value, COARSE))).collect();
    table(text, "[sole]", &keys);
}

/// Writes the tables of the map's motors.
pub(super) fn write_motors(text: &mut String, map: &ImportMap) {
    for (name, motor) in &map.motors {
        let keys = motor.keys().map(|(key, value)| (key, value.to_string()));
        table(text, &format!("[motor.{}]", quoted(name)), &keys);
    }
}

fn joint(
    text: &mut String,
    name: &str,
    number: usize,
    parent: &str,
    axis: &Unit<Vector3<f64>>,
    origin: String,
    more: Keys,
) {
    let mut keys = vec![
        ("number", number.to_string()),
        ("parent", quoted(parent)),
        ("axis", vector(axis, FINE)),
        ("origin_m", origin),
    ];
    keys.extend(more);
    table(text, &format!("[joint.{name}]"), &keys);
}

/// Range, rate and torque or motor, and which joint of the URDF it is.
fn drive(hinge: &Hinge, robot: &UrdfRobot, map: &ImportMap, header: &Header) -> Keys {
    let drive = &hinge.drive;
    let motor = drive.motor.and_then(|index| map.motors.get(index));
    let mut keys = vec![
        ("range_deg", array(drive.range.map(|angle| number(angle.to_degrees(), COARSE)))),
        ("rate_max_deg_per_s", number(drive.rate_max.to_degrees(), COARSE)),
        motor.map_or_else(|| ("effort_n_m", digits(drive.effort)), |(name, _)| ("motor", quoted(name))),
        ("urdf", quoted(&robot.joints[hinge.urdf].name)),
        ("urdf_sign", if hinge.sign < 0.0 { "-1" } else { "1" }.to_string()),
    ];
    if motor.is_none() {
        keys.insert(3, ("armature_kg_m2", digits(header.armature)));
    }
    keys
}
