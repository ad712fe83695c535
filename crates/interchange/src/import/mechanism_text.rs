//! Writes an imported biped as the text of a mechanism file.

use std::fmt::Write;

use model::{DcMotor, Joint};
use nalgebra::Vector3;

use crate::import::JointMap;
use crate::import::straight_biped::StraightBiped;

/// Steps per unit to which lengths and masses are rounded: less is noise, and would make mirrored numbers differ.
const PER_UNIT: f64 = 1e9;
/// Steps per unit to which moments of inertia, which are small for small robots, and axes are rounded.
const PER_FINE_UNIT: f64 = 1e12;

/// Writes the file's text.
pub(super) fn write(biped: &StraightBiped, map: &JointMap, urdf_file: &str) -> String {
    let mut text = format!(
        "# Made by `halfstep import` from {urdf_file}.\n# Frames, units and signs: as in Halfstep's own \
         config/mechanism.toml.\n\nname = {}\n",
        quoted(&map.name)
    );
    let sole = map.sole;
    let ankle = biped.hinges[Joint::RightAnkleRoll].place;
    // O is on the floor under the right ankle.
    let floor = Vector3::new(ankle.x, ankle.y, ankle.z - sole.ankle_height);
    // Rounded from the plane of symmetry, y = 0, so that mirrored points stay mirrored.
    let rounded = |point: Vector3<f64>| point.map(|value| (value * PER_UNIT).round() / PER_UNIT);
    let on_grid = |point: Vector3<f64>| {
        rounded(point - Vector3::new(floor.x, 0.0, floor.z)) - rounded(Vector3::new(0.0, floor.y, 0.0))
    };

    let keys = [
        ("behind_m", sole.behind),
        ("ahead_m", sole.ahead),
        ("width_m", 2.0 * sole.half_width),
        ("ankle_height_m", sole.ankle_height),
    ];
    table(&mut text, "sole", &keys.map(|(key, value)| (key, number(value, PER_UNIT))));
    for (name, motor) in map.motors.iter().filter_map(|(name, motor)| Some((name, motor.dc()?))) {
        table(&mut text, &format!("motor.{}", quoted(name)), &motor_keys(motor));
    }
    for joint in Joint::ALL {
        let hinge = &biped.hinges[joint];
        let place = if joint.is_powered() { on_grid(hinge.place) } else { Vector3::zeros() };
        let mut keys = vec![("number", joint.number().to_string())];
        let (parent, axis, origin) = match joint {
            Joint::FootRoll => ("ground", Vector3::x(), Vector3::zeros()),
            Joint::FootPitch => (Joint::FootRoll.name(), Vector3::y(), Vector3::zeros()),
            _ => {
                let parent = hinge.parent;
                let mounted = if parent.is_powered() { on_grid(biped.hinges[parent].place) } else { Vector3::zeros() };
                (parent.name(), *hinge.axis, place - mounted)
            }
        };
        keys.push(("parent", quoted(parent)));
        keys.push(("axis", list(&axis, PER_FINE_UNIT)));
        keys.push(("origin_m", list(&origin, PER_UNIT)));
        let body = &biped.bodies[joint];
        if body.mass > 0.0 {
            keys.push(("mass_kg", number(body.mass, PER_UNIT)));
            keys.push(("com_m", list(&(on_grid(body.com) - place), PER_UNIT)));
            keys.push(("inertia_kg_m2", list(&body.inertia.diagonal(), PER_FINE_UNIT)));
        }
        if let Some(mapped) = &map.joints[joint] {
            let [min, max] = hinge.range.map(|angle| number(angle.to_degrees(), PER_UNIT));
            keys.push(("range_deg", format!("[{min}, {max}]")));
            keys.push(("rate_max_deg_per_s", number(hinge.rate_max.to_degrees(), PER_UNIT)));
            keys.push(("motor", quoted(&map.motors[mapped.motor].0)));
        }
        table(&mut text, &format!("joint.{}", joint.name()), &keys);
    }
    text
}

fn motor_keys(motor: &DcMotor) -> Vec<(&'static str, String)> {
    vec![
        ("resistance_ohm", motor.resistance.to_string()),
        ("torque_constant_n_m_per_a", motor.torque_constant.to_string()),
        ("rotor_inertia_kg_m2", motor.rotor_inertia.to_string()),
        ("gear_ratio", motor.gear_ratio.to_string()),
        ("voltage_max_v", motor.voltage_max.to_string()),
    ]
}

fn table(text: &mut String, name: &str, keys: &[(&str, String)]) {
    // Writing into a text cannot fail.
    let _ = writeln!(text, "\n[{name}]");
    for (key, value) in keys {
        let _ = writeln!(text, "{key} = {value}");
    }
}

fn list(vector: &Vector3<f64>, per_unit: f64) -> String {
    let [x, y, z] = [vector.x, vector.y, vector.z].map(|value| number(value, per_unit));
    format!("[{x}, {y}, {z}]")
}

/// A rounded number; zero has no sign.
fn number(value: f64, per_unit: f64) -> String {
    ((value * per_unit).round() / per_unit + 0.0).to_string()
}

/// A TOML string.
fn quoted(text: &str) -> String {
    format!("{text:?}")
}
