//! Reads links and joints of a URDF; every number is checked where it is read.

use std::collections::HashMap;

use nalgebra::{Matrix3, Unit, Vector3};

use crate::import::body::LumpedBody;
use crate::import::file_errors::FileErrors;
use crate::import::urdf_format;
use crate::import::urdf_numbers::{AXIS, EFFORT, FACTOR, LIMIT, MASS, MOMENT, PRODUCT, RATE, SIZE, UrdfNumbers};
use crate::import::urdf_robot::{JointKind, Mimic, Shape, Solid, UrdfLimit, UrdfLink, UrdfRobot, UrdfTreeJoint};
use crate::import::urdf_tree;
use crate::import::xml_tree::Element;
use crate::import::{ImportError, NamedText};

/// Reads the robot.
///
/// # Errors
/// One line if the text is another format, no XML, or broken off; else every mistake in links and joints, with line,
/// link or joint, element, value, and what would be right.
pub(super) fn read(urdf: NamedText) -> Result<UrdfRobot, ImportError> {
    let root = urdf_format::robot_element(urdf.text)
        .map_err(|what| ImportError::new(format!("{}: no URDF: {what}", urdf.file)))?;
    let mut errors = FileErrors::new(urdf.file);
    let links: Vec<UrdfLink> = root.children("link").map(|link| read_link(link, &mut errors)).collect();
    let mut index = HashMap::new();
    for (place, link) in links.iter().enumerate() {
        if let Some(first) = index.insert(link.name.as_str(), place) {
            let first = links[first].line;
            errors.note_at(link.line, format!("link {}: must have a name of its own: line {first} has it", link.name));
        }
    }
    let mut lines = HashMap::new();
    let mut joints = Vec::new();
    for element in root.children("joint") {
        let joint = read_joint(element, &index, &mut errors);
        let name = element.attribute("name").unwrap_or_default().to_string();
        if let Some(first) = lines.insert(name.clone(), element.line)
            && !name.is_empty()
        {
            let text = format!("joint {name}: must have a name of its own: line {first} has it");
            errors.note_at(element.line, text);
        }
        joints.extend(joint);
    }
    let root_link = if errors.is_empty() { urdf_tree::root(&links, &joints, &mut errors) } else { None };
    let name = root.attribute("name").unwrap_or_default().to_string();
    errors.finish(root_link.map(|root| UrdfRobot { name, links, joints, root }))
}

fn read_link(element: &Element, errors: &mut FileErrors) -> UrdfLink {
    let name = name(element, errors);
    let mut numbers = UrdfNumbers { owner: format!("link {name}"), errors };
    let body = element.child("inertial").map_or(LumpedBody::default(), |inertial| read_body(inertial, &mut numbers));
    let shapes = element.children("collision").filter_map(|shape| read_shape(shape, &mut numbers)).collect();
    UrdfLink { name, line: element.line, body, shapes }
}

fn read_body(inertial: &Element, numbers: &mut UrdfNumbers) -> LumpedBody {
    let pose = numbers.origin(inertial);
    let mass = match inertial.child("mass") {
        Some(mass) => numbers.required(mass, "value", MASS),
        None => {
            numbers.note(inertial, "<inertial> must have <mass value=\"…\"/> (kilograms)");
            0.0
        }
    };
    let inertia = inertial.child("inertia").map_or(Matrix3::zeros(), |inertia| {
        let [xx, yy, zz] = ["ixx", "iyy", "izz"].map(|key| numbers.required(inertia, key, MOMENT).max(0.0));
        let [xy, xz, yz] = ["ixy", "ixz", "iyz"].map(|key| numbers.optional(inertia, key, PRODUCT).unwrap_or_default());
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    });
    LumpedBody { mass, com: Vector3::zeros(), inertia }.moved(&pose)
}

fn read_shape(collision: &Element, numbers: &mut UrdfNumbers) -> Option<Shape> {
    let geometry = collision.child("geometry")?;
    let solid = if let Some(element) = geometry.child("box") {
        Solid::Box(numbers.vector(element, "size", Vector3::zeros(), SIZE))
    } else if let Some(element) = geometry.child("cylinder") {
        let radius = numbers.required(element, "radius", SIZE);
        Solid::Cylinder { radius, length: numbers.required(element, "length", SIZE) }
    } else {
        Solid::Sphere { radius: numbers.required(geometry.child("sphere")?, "radius", SIZE) }
    };
    Some(Shape { pose: numbers.origin(collision), solid })
}

fn read_joint(element: &Element, links: &HashMap<&str, usize>, errors: &mut FileErrors) -> Option<UrdfTreeJoint> {
    let name = name(element, errors);
    let mut numbers = UrdfNumbers { owner: format!("joint {name}"), errors };
    let kind = kind(element, &mut numbers);
    let mut end = |tag: &str| {
        let at = element.child(tag).unwrap_or(element);
        let link = element.child(tag).and_then(|end| end.attribute("link"));
        let found = link.and_then(|link| links.get(link).copied());
        match (link, found) {
            (None, _) => numbers.note(at, &format!("must have <{tag} link=\"…\"/>")),
            (Some(link), None) => {
                let link = config::quoted(link);
                numbers.note(at, &format!("<{tag}> link = \"{link}\": must be one of the robot's links"));
            }
            _ => {}
        }
        found
    };
    let (parent, child) = (end("parent"), end("child"));
    let origin = numbers.origin(element);
    let needs_axis = !matches!(kind, Some(JointKind::Fixed | JointKind::Floating));
    let axis = element.child("axis").filter(|_| needs_axis);
    let axis = axis.map_or(Some(Vector3::x_axis()), |axis| {
        let vector = numbers.vector(axis, "xyz", Vector3::x(), AXIS);
        let unit = Unit::try_new(vector, 1e-6);
        if unit.is_none() {
            numbers.note(axis, "<axis> xyz = \"0 0 0\": must be a direction, such as \"0 1 0\"");
        }
        unit
    });
    let limit = element.child("limit").filter(|_| needs_axis);
    let limit = limit.map_or(UrdfLimit::default(), |limit| UrdfLimit {
        given: true,
        complete: limit.attribute("lower").is_some() && limit.attribute("upper").is_some(),
        lower: numbers.optional(limit, "lower", LIMIT).unwrap_or_default(),
        upper: numbers.optional(limit, "upper", LIMIT).unwrap_or_default(),
        velocity: numbers.optional(limit, "velocity", RATE),
        effort: numbers.optional(limit, "effort", EFFORT),
    });
    let mimic = element.child("mimic").map(|mimic| Mimic {
        joint: mimic.attribute("joint").unwrap_or_default().to_string(),
        factor: numbers.optional(mimic, "multiplier", FACTOR).unwrap_or(1.0),
        offset: numbers.optional(mimic, "offset", FACTOR).unwrap_or_default(),
    });
    let line = element.line;
    Some(UrdfTreeJoint { name, line, kind: kind?, parent: parent?, child: child?, origin, axis: axis?, limit, mimic })
}

fn name(element: &Element, errors: &mut FileErrors) -> String {
    let name = element.attribute("name").unwrap_or_default();
    if name.trim().is_empty() {
        errors.note_at(element.line, format!("<{}>: must have name=\"…\"", element.name));
    }
    name.to_string()
}

fn kind(element: &Element, numbers: &mut UrdfNumbers) -> Option<JointKind> {
    let told = element.attribute("type");
    let kinds = [
        JointKind::Revolute,
        JointKind::Continuous,
        JointKind::Prismatic,
        JointKind::Fixed,
        JointKind::Floating,
        JointKind::Planar,
    ];
    let kind = kinds.into_iter().find(|kind| Some(kind.name()) == told);
    if kind.is_none() {
        let found = told.map_or("has no type".to_string(), |told| format!("type = \"{}\"", config::quoted(told)));
        let must = kinds.map(JointKind::name).join(", ");
        numbers.note(element, &format!("<joint> {found}: must be one of {must}"));
    }
    kind
}
