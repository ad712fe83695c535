//! Writes the held joints as tables of a mechanism file.

use crate::import::body_text::body;
use crate::import::grid::{Grid, OnGrid};
use crate::import::held_parts::{HeldPart, HeldParts};
use crate::import::toml_text::{COARSE, FINE, Keys, digits, number, quoted, table, vector};
use crate::import::urdf_robot::UrdfRobot;

/// Writes a table for each; `places` are those of the mechanism's joints by name, `armature` is the inertia of a rotor
/// at its joint (kg·m²).
pub(super) fn write(
    text: &mut String,
    held: &HeldParts,
    robot: &UrdfRobot,
    grid: &Grid,
    places: &[(String, OnGrid)],
    armature: f64,
) {
    for part in &held.parts {
        let name = |part: &HeldPart| quoted(&robot.joints[part.urdf].name);
        let mut keys = vec![("urdf", name(part)), ("at_deg", number(part.angle.to_degrees(), COARSE))];
        let mount = places.iter().find(|(joint, _)| *joint == part.mount);
        if let Some((_, mount)) = mount.filter(|_| !part.is_welded) {
            let below = held.below(part);
            let here = grid.at(part.place);
            let carrier = below.map_or(*mount, |below| grid.at(below.place));
            keys.push(("parent", quoted(&part.mount)));
            keys.extend(below.map(|below| ("parent_held", name(below))));
            keys.push(("axis", vector(&part.axis, FINE)));
            keys.push(("origin_m", carrier.to(here)));
            let lumped_into = &held.links[part.lumped_into].name;
            if part.body.mass > 0.0 && *lumped_into != part.mount {
                keys.push(("lumped_into", quoted(lumped_into)));
            }
            keys.extend(body(grid, &part.body, here));
            keys.extend([("effort_n_m", digits(part.effort)), ("armature_kg_m2", digits(armature))]);
        }
        table(text, "[[held]]", &keys);
    }
}

/// The key that tells which held joint carries a joint of the mechanism; none if its parent does.
pub(super) fn carrier(held: &HeldParts, robot: &UrdfRobot, joint: &str) -> Keys {
    held.carrier(joint).map(|part| ("parent_held", quoted(&robot.joints[part.urdf].name))).into_iter().collect()
}
