//! Links and joints of a URDF. Everything else in the file is ignored.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Unit, Vector3};

use crate::import::body::Body;
use crate::import::file_errors::FileErrors;
use crate::import::urdf_format;
use crate::import::urdf_numbers::{AXIS, EFFORT, FACTOR, LIMIT, MASS, MOMENT, Numbers, PRODUCT, RATE, SIZE};
use crate::import::urdf_tree;
use crate::import::xml_tree::Element;
use crate::import::{ImportError, NamedText};

/// A robot as its URDF describes it: one tree.
#[derive(Clone, Debug)]
pub(super) struct Robot {
    pub name: String,
    pub links: Vec<UrdfLink>,
    pub joints: Vec<UrdfJoint>,
    /// Index of the link that is no joint's child.
    pub root: usize,
}

/// A link.
#[derive(Clone, Debug)]
pub(super) struct UrdfLink {
    pub name: String,
    /// Line in the file.
    pub line: usize,
    /// Mass and inertia in the link's frame; zero without an `<inertial>`.
    pub body: Body,
    /// Collision shapes that are no meshes.
    pub shapes: Vec<Shape>,
}

/// A collision shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Maps the shape's coordinates to the link's.
    pub pose: Isometry3<f64>,
    pub solid: Solid,
}

/// Form of a shape (m); a cylinder stands along z.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    Box(Vector3<f64>),
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
}

/// What a joint lets move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointKind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
}

/// A joint.
#[derive(Clone, Debug)]
pub(super) struct UrdfJoint {
    pub name: String,
    /// Line in the file.
    pub line: usize,
    pub kind: JointKind,
    /// Indices of the links that it connects.
    pub parent: usize,
    pub child: usize,
    /// Maps the child's coordinates at zero to the parent's.
    pub origin: Isometry3<f64>,
    /// Axis in the child's frame.
    pub axis: Unit<Vector3<f64>>,
    pub limit: Limit,
    pub mimic: Option<Mimic>,
}

/// Limits of a joint as written (rad or m).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limit {
    /// Whether there is a `<limit>`, and one that tells both ends.
    pub given: bool,
    pub complete: bool,
    pub lower: f64,
    pub upper: f64,
    /// Largest rate and effort; `None` where absent.
    pub velocity: Option<f64>,
    pub effort: Option<f64>,
}

/// A joint that follows another one: angle = factor · its angle + offset.
#[derive(Clone, Debug)]
pub(super) struct Mimic {
    pub joint: String,
    pub factor: f64,
    pub offset: f64,
}

impl JointKind {
    /// The kind as a URDF writes it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            JointKind::Revolute => "revolute",
            JointKind::Continuous => "continuous",
            JointKind::Prismatic => "prismatic",
            JointKind::Fixed => "fixed",
            JointKind::Floating => "floating",
            JointKind::Planar => "planar",
        }
    }
}

impl UrdfJoint {
    /// Whether it turns about one axis.
    pub(super) fn turns(&self) -> bool {
        matches!(self.kind, JointKind::Revolute | JointKind::Continuous)
    }
}

/// Reads the robot.
///
/// # Errors
/// One line if the text is another format, no XML, or broken off; else every mistake in links and joints, with line,
/// link or joint, element, value, and what would be right.
pub(super) fn read(urdf: NamedText) -> Result<Robot, ImportError> {
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
    errors.finish(root_link.map(|root| Robot { name, links, joints, root }))
}

fn read_link(element: &Element, errors: &mut FileErrors) -> UrdfLink {
    let name = name(element, errors);
    let mut numbers = Numbers { owner: format!("link {name}"), errors };
    let body = element.child("inertial").map_or(Body::default(), |inertial| read_body(inertial, &mut numbers));
    let shapes = element.children("collision").filter_map(|shape| read_shape(shape, &mut numbers)).collect();
    UrdfLink { name, line: element.line, body, shapes }
}

fn read_body(inertial: &Element, numbers: &mut Numbers) -> Body {
    let pose = numbers.origin(inertial);
    let mass = match inertial.child("mass") {
        Some(mass) => numbers.required(mass, "value", MASS),
        None => {
            numbers.note(inertial, "<inertial> must have <mass value=\"…\"/> (kilograms)");
            0.0
        }
    };
    let inertia = inertial.child("inertia").map_or(Matrix3::zeros(), |inertia| {
        let [xx, yy, zz] = ["ixx", "iyy", "izz"].map(|key| numbers.required(inertia, key, MOMENT));
        let [xy, xz, yz] = ["ixy", "ixz", "iyz"].map(|key| numbers.optional(inertia, key, PRODUCT).unwrap_or_default());
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    });
    Body { mass, com: Vector3::zeros(), inertia }.moved(&pose)
}

fn read_shape(collision: &Element, numbers: &mut Numbers) -> Option<Shape> {
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

fn read_joint(element: &Element, links: &HashMap<&str, usize>, errors: &mut FileErrors) -> Option<UrdfJoint> {
    let name = name(element, errors);
    let mut numbers = Numbers { owner: format!("joint {name}"), errors };
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
    let limit = limit.map_or(Limit::default(), |limit| Limit {
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
    Some(UrdfJoint { name, line, kind: kind?, parent: parent?, child: child?, origin, axis: axis?, limit, mimic })
}

fn name(element: &Element, errors: &mut FileErrors) -> String {
    let name = element.attribute("name").unwrap_or_default();
    if name.trim().is_empty() {
        errors.note_at(element.line, format!("<{}>: must have name=\"…\"", element.name));
    }
    name.to_string()
}

fn kind(element: &Element, numbers: &mut Numbers) -> Option<JointKind> {
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
