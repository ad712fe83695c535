//! The mechanism as URDF, for viewers and other simulators.
//!
//! A floating tree rooted at the right foot link `right_foot`, whose frame lies on the sole: joints 1 and 2, the
//! contact of foot and ground, are left out. Joints 3 to 20 keep their names; they are revolute, or fixed where the
//! robot does not have them. Links between joints that meet in one point have no mass: an element of MuJoCo's own,
//! which others ignore, makes it add the mass that it needs there.
//!
//! Pinocchio drops the root link's mass when the base is fixed: load it there with a free-flyer.

use std::convert::Infallible;

use model::{Body, Joint, Mechanism, Side};
use nalgebra::Vector3;
use quick_xml::escape::escape;

use crate::xml_lines::{XmlLines, numbers};

/// MuJoCo's element for the mass of massless links.
const FOR_MUJOCO: &str = r#"<mujoco><compiler boundmass="1e-6" boundinertia="1e-9"/></mujoco>"#;

/// Writes the mechanism as the text of a URDF file: a floating tree rooted at the right foot.
///
/// # Errors
/// None: every mechanism can be written.
pub fn urdf_text(mechanism: &Mechanism) -> Result<String, Infallible> {
    let mut out = XmlLines::default();
    out.line(r#"<?xml version="1.0"?>"#);
    out.open(format_args!(r#"robot name="{}""#, escape(&mechanism.name)));
    out.line(FOR_MUJOCO);
    for joint in Joint::ALL.into_iter().filter(|joint| *joint >= root()) {
        link(&mut out, mechanism, joint);
    }
    for each in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        joint(&mut out, mechanism, each);
    }
    out.close("robot");
    Ok(out.text)
}

/// The joint whose link is the root.
const fn root() -> Joint {
    Mechanism::RIGHT_FOOT
}

/// Name of the link that a joint carries.
fn link_name(joint: Joint) -> String {
    joint.link_name().map_or_else(|| format!("{}_link", joint.name()), str::to_owned)
}

/// A joint with its range and rate; as effort the torque of its motor at standstill and full voltage. One that the
/// robot does not have is fixed.
fn joint(out: &mut XmlLines, mechanism: &Mechanism, joint: Joint) {
    let link = &mechanism.links[joint];
    let kind = if mechanism.has(joint) { "revolute" } else { "fixed" };
    let (lower, upper, velocity) = link.limits.map_or((0.0, 0.0, 0.0), |l| (l.angle_min, l.angle_max, l.rate_max));
    let effort = link.motor.map_or(0.0, |motor| motor.torque_max());
    out.open(format_args!(r#"joint name="{}" type="{kind}""#, joint.name()));
    origin(out, link.origin);
    out.line(format_args!(r#"<parent link="{}"/>"#, link_name(link.parent.unwrap_or(root()))));
    out.line(format_args!(r#"<child link="{}"/>"#, link_name(joint)));
    if mechanism.has(joint) {
        out.line(format_args!(r#"<axis xyz="{}"/>"#, numbers(link.axis.as_slice())));
        out.line(format_args!(r#"<limit lower="{lower}" upper="{upper}" effort="{effort}" velocity="{velocity}"/>"#));
    }
    out.close("joint");
}

fn link(out: &mut XmlLines, mechanism: &Mechanism, joint: Joint) {
    let body = mechanism.links[joint].body;
    out.open(format_args!(r#"link name="{}""#, link_name(joint)));
    inertial(out, &body);
    if let Some(side) = Side::BOTH.into_iter().find(|side| mechanism.foot(*side) == joint) {
        // Only the soles collide: thighs and pelvis overlap at the hips, and a simulator would push them apart.
        let (centre, size) = foot_box(mechanism, side);
        box_at(out, "visual", centre, size);
        box_at(out, "collision", centre, size);
    } else if body.mass > 0.0 {
        box_at(out, "visual", body.com, equivalent_sides(&body));
    }
    out.close("link");
}

fn inertial(out: &mut XmlLines, body: &Body) {
    let inertia = body.inertia_matrix();
    let [ixx, iyy, izz] = inertia.diagonal().into();
    let (ixy, ixz, iyz) = (inertia.m12, inertia.m13, inertia.m23);
    out.open("inertial");
    origin(out, body.com);
    out.line(format_args!(r#"<mass value="{}"/>"#, body.mass));
    out.line(format_args!(r#"<inertia ixx="{ixx}" ixy="{ixy}" ixz="{ixz}" iyy="{iyy}" iyz="{iyz}" izz="{izz}"/>"#));
    out.close("inertial");
}

/// A box as the shape of a link, for viewers or for contact.
fn box_at(out: &mut XmlLines, shape: &str, centre: Vector3<f64>, size: Vector3<f64>) {
    out.open(shape);
    origin(out, centre);
    out.open("geometry");
    out.line(format_args!(r#"<box size="{}"/>"#, numbers(size.as_slice())));
    out.close("geometry");
    out.close(shape);
}

fn origin(out: &mut XmlLines, place: Vector3<f64>) {
    out.line(format_args!(r#"<origin xyz="{}" rpy="0 0 0"/>"#, numbers(place.as_slice())));
}

/// The foot as a box on its sole, half as high as the ankle: its centre and its sides (m).
fn foot_box(mechanism: &Mechanism, side: Side) -> (Vector3<f64>, Vector3<f64>) {
    let sole = mechanism.sole;
    let height = sole.ankle_height / 2.0;
    let centre = mechanism.sole_in_foot(side) + sole.centre(side).push(height / 2.0);
    (centre, (2.0 * sole.half_size()).push(height))
}

/// Sides of the box of uniform density that has the body's mass and moments (m): they follow from Iz = m (a² + b²) / 12
/// and the same for x and y.
pub(crate) fn equivalent_sides(body: &Body) -> Vector3<f64> {
    let sum = body.inertia.sum();
    body.inertia.map(|moment| (6.0 * (sum - 2.0 * moment) / body.mass).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    #[test]
    fn box_of_a_link_has_its_mass_and_moments() {
        // a uniform brick of 2 kg and sides 0.1, 0.2, 0.3 m
        let moments = [0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04].map(|squares| 2.0 / 12.0 * squares);
        let brick = Body { mass: 2.0, com: Vector3::zeros(), inertia: moments.into(), ..Body::NONE };
        let size = equivalent_sides(&brick);
        assert!((size - Vector3::new(0.1, 0.2, 0.3)).norm() < 1e-12, "{size:?}");
    }

    #[test]
    fn joints_that_the_robot_does_not_have_are_fixed() {
        let mechanism =
            Mechanism::load(format!("{}/../../config/robots/op3/mechanism.toml", env!("CARGO_MANIFEST_DIR")))
                .unwrap_or_else(|errors| panic!("{errors}"));
        let text = urdf_text(&mechanism).unwrap();
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
            let kind = if mechanism.has(joint) { "revolute" } else { "fixed" };
            assert!(text.contains(&format!("<joint name=\"{}\" type=\"{kind}\">", joint.name())), "{}", joint.name());
        }
        assert!(mechanism.has(Joint::LeftShoulder) && !mechanism.has(Joint::LeftElbow));
    }

    #[test]
    fn urdf_foot_boxes_lie_on_the_floor_at_zero_angles() {
        let mechanism = Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR")))
            .unwrap_or_else(|errors| panic!("{errors}"));
        let bottom = |side: Side| {
            let (centre, size) = foot_box(&mechanism, side);
            centre.z - size.z / 2.0
        };
        assert!(bottom(Side::Right).abs() < 1e-15);
        assert!((bottom(Side::Left) + mechanism.sole.ankle_height).abs() < 1e-15);
    }
}
