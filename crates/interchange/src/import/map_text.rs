//! Writes the complete map of what an import found and took, to be edited and given back.

use crate::import::import_map::ImportMap;
use crate::import::mechanism_text::{Header, write_motors, write_sole};
use crate::import::role::JointRole;
use crate::import::toml_text::{COARSE, number, quoted, table};
use crate::import::urdf_robot::UrdfRobot;

/// Writes the map's text.
pub(super) fn write(robot: &UrdfRobot, map: &ImportMap, roles: &[(JointRole, usize)], header: &Header) -> String {
    let mut text = format!(
        "# What was found in {}. Delete what may be found again.\n\nname = {}\n",
        quoted(header.urdf),
        quoted(header.name)
    );
    write_sole(&mut text, &header.sole);
    write_motors(&mut text, map);
    for (role, joint) in roles {
        let told = map.joint(*role);
        let mut keys = vec![("urdf", quoted(&robot.joints[*joint].name))];
        if let Some([low, high]) = told.range.map(|range| range.map(f64::to_degrees)) {
            keys.push(("range_deg", format!("[{}, {}]", number(low, COARSE), number(high, COARSE))));
        }
        keys.extend(told.rate_max.map(|rate| ("rate_max_deg_per_s", number(rate.to_degrees(), COARSE))));
        keys.extend(told.effort.map(|effort| ("effort_n_m", number(effort, COARSE))));
        let motor = told.motor.and_then(|index| map.motors.get(index));
        keys.extend(motor.map(|(name, _)| ("motor", quoted(name))));
        table(&mut text, &format!("[joint.{}]", role.name()), &keys);
    }
    for &(index, angle) in header.held {
        let keys = [("urdf", quoted(&robot.joints[index].name)), ("at_deg", number(angle.to_degrees(), COARSE))];
        table(&mut text, "[[held]]", &keys);
    }
    text
}
