//! Reads the text of a URDF, within limits: the parser beneath recurses and copies, and would run out of stack or time
//! with a file that was made to hurt. No robot comes near the limits.

use quick_xml::Reader;
use quick_xml::events::Event;
use urdf_rs::{Inertial, JointType, Pose, Robot};

use crate::import::file_errors::FileErrors;
use crate::import::{ImportError, NamedText};

/// Longest text (bytes).
const LENGTH_MAX: usize = 4 << 20;
/// Deepest nesting of elements; that of a URDF is five.
const DEPTH_MAX: usize = 32;
/// Most elements, and most links and joints among them.
const ELEMENTS_MAX: usize = 50_000;
const LINKS_MAX: usize = 1000;
/// Largest coordinate (m), angle (rad), mass (kg) and moment of inertia (kg·m²).
const LENGTH: f64 = 100.0;
const ANGLE: f64 = 1e3;
const MASS: f64 = 1e4;
const INERTIA: f64 = 1e4;
/// Largest rate of a joint (rad/s).
const RATE: f64 = 1e4;

/// Reads the robot.
///
/// # Errors
/// The text is no URDF, beyond the limits, or has numbers that no robot has.
pub(super) fn read(urdf: NamedText) -> Result<Robot, ImportError> {
    let wrong = |what: String| ImportError::new(format!("{}: no URDF: {what}", urdf.file));
    within_limits(urdf.text).map_err(wrong)?;
    let robot = urdf_rs::read_from_string(urdf.text).map_err(|error| wrong(error.to_string()))?;
    let mut errors = FileErrors { file: urdf.file, errors: Vec::new() };
    check_numbers(&robot, &mut errors);
    errors.finish(Some(robot))
}

fn within_limits(text: &str) -> Result<(), String> {
    if text.len() > LENGTH_MAX {
        return Err(format!("it has {} bytes, and may have {LENGTH_MAX}", text.len()));
    }
    let mut reader = Reader::from_str(text);
    // What does not match is left to the parser beneath, which tells it better.
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_unmatched_ends = true;
    let (mut depth, mut elements, mut links) = (0_usize, 0, 0);
    let line = |reader: &Reader<&[u8]>| {
        let place = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX).min(text.len());
        1 + text.as_bytes()[..place].iter().filter(|byte| **byte == b'\n').count()
    };
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return Ok(()),
            Ok(event @ (Event::Start(_) | Event::Empty(_))) => {
                let (Event::Start(start) | Event::Empty(start)) = &event else { continue };
                elements += 1;
                links += usize::from(matches!(start.name().as_ref(), b"link" | b"joint"));
                depth += usize::from(matches!(event, Event::Start(_)));
            }
            Ok(Event::End(_)) => depth = depth.saturating_sub(1),
            Ok(Event::DocType(_)) => return Err(format!("line {}: it must have no <!DOCTYPE>", line(&reader))),
            Ok(_) => {}
        }
        let beyond = [
            (depth, DEPTH_MAX, "elements within each other"),
            (elements, ELEMENTS_MAX, "elements"),
            (links, LINKS_MAX, "links and joints"),
        ];
        if let Some((_, max, what)) = beyond.iter().find(|(count, max, _)| count > max) {
            return Err(format!("line {}: it has more than {max} {what}", line(&reader)));
        }
    }
}

fn check_numbers(robot: &Robot, errors: &mut FileErrors) {
    for joint in &robot.joints {
        let mut check = |what: &str, values: &[f64], max: f64| {
            if let Some(value) = values.iter().find(|value| !is_within(**value, max)) {
                errors.note(format!("joint {}: {what} = {value}: must lie between -{max} and {max}", joint.name));
            }
        };
        check_pose(&joint.origin, &mut check);
        check("axis", &joint.axis.xyz.0, LENGTH);
        if matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic) {
            check("limit", &[joint.limit.lower, joint.limit.upper], ANGLE);
        }
        if joint.joint_type != JointType::Fixed {
            check("limit velocity", &[joint.limit.velocity], RATE);
        }
    }
    for link in &robot.links {
        let mut check = |what: &str, values: &[f64], max: f64| {
            if let Some(value) = values.iter().find(|value| !is_within(**value, max)) {
                errors.note(format!("link {}: {what} = {value}: must lie between -{max} and {max}", link.name));
            }
        };
        let Inertial { origin, mass, inertia } = &link.inertial;
        check_pose(origin, &mut check);
        check("mass", &[mass.value], MASS);
        let urdf_rs::Inertia { ixx, ixy, ixz, iyy, iyz, izz } = inertia;
        check("inertia", &[*ixx, *ixy, *ixz, *iyy, *iyz, *izz], INERTIA);
    }
}

fn check_pose(pose: &Pose, check: &mut impl FnMut(&str, &[f64], f64)) {
    check("origin xyz", &pose.xyz.0, LENGTH);
    check("origin rpy", &pose.rpy.0, ANGLE);
}

/// Whether a value lies between `-max` and `max`; NaN does not.
fn is_within(value: f64, max: f64) -> bool {
    value.abs() <= max
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> String {
        read(NamedText { text, file: "r.urdf" }).unwrap_err().to_string()
    }

    #[test]
    fn texts_beyond_the_limits_are_refused_before_they_are_parsed() {
        let nested = "<robot name=\"r\">".to_owned() + &"<a>\n".repeat(100_000);
        assert_eq!(refused(&nested), "r.urdf: no URDF: line 32: it has more than 32 elements within each other");
        let many = "<robot name=\"r\">".to_owned() + &"<link name=\"l\"/>".repeat(1001) + "</robot>";
        assert_eq!(refused(&many), "r.urdf: no URDF: line 1: it has more than 1000 links and joints");
        let entities = "<!DOCTYPE r [<!ENTITY a \"aaaa\">]><robot name=\"&a;\"/>";
        assert_eq!(refused(entities), "r.urdf: no URDF: line 1: it must have no <!DOCTYPE>");
        assert!(refused(&" ".repeat(LENGTH_MAX + 1)).ends_with("bytes, and may have 4194304"));
    }

    #[test]
    fn numbers_that_no_robot_has_are_refused() {
        let text = "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"1e308\"/><inertia ixx=\"inf\" \
                    ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link><link name=\"b\"/>\
                    <joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>\
                    <origin xyz=\"0 0 2000\"/><limit lower=\"-1e308\" upper=\"1\" velocity=\"1\" effort=\"1\"/>\
                    </joint></robot>";
        let errors = refused(text);
        let starts = ["joint j: origin xyz = 2000", "joint j: limit = -1", "link a: mass = 1", "link a: inertia = inf"];
        for (line, start) in errors.lines().zip(starts) {
            assert!(line.starts_with(&format!("r.urdf: {start}")), "{line}");
        }
        assert_eq!(errors.lines().count(), starts.len(), "{errors}");
    }
}
