//! The mechanism as MJCF, MuJoCo's own format.
//!
//! A floating tree: the free joint carries the right foot, whose frame lies on the sole, so that joints 1 and 2, the
//! contact of foot and ground, arise from contact. Joints 3 to 20 keep their names. Those that meet in one point share
//! a body, so that no moving body is massless; those that the robot does not have are left out. Rotors enter as
//! `armature`. Only soles and floor collide.
//!
//! The actuators are plain torque motors, limited to the motor's torque at standstill: position servo and back-EMF
//! belong to the drive, which `plant::Drive` or `tools/mujoco_plant` adds.
//!
//! # Contact
//!
//! MuJoCo defines a contact's stiffness as a time constant, independent of the mass on it. The one chosen here is
//! critically damped, as fast as the springs of `config/plant.toml` are under the robot's weight (four corners of 1e6
//! N/m under 73 kg ring at 234 rad/s, 1/234 s = 4.3 ms), and nearly all constraint: a standing sole sinks in by a few
//! micrometres. Friction is a cone (`elliptic`), a tenth as soft as the normal direction (`impratio`), so that a loaded
//! sole does not creep.

use model::{Body, Joint, Mechanism, Side};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use plant::{GroundPiece, PlantParameters};
use quick_xml::escape::escape;

use crate::floor_prism::FloorPrism;
use crate::mjcf_bodies::MjcfBodies;
use crate::side_name::side_name;
use crate::urdf::equivalent_sides;
use crate::xml_lines::{XmlLines, numbers};

/// Time constant (s) and damping ratio; impedance from 0.99 to 0.999 over half a millimetre.
const CONTACT: &str = r#"solref="0.004 1" solimp="0.99 0.999 0.0005""#;
/// Torsional and rolling friction, which three-dimensional contacts do not use but the format requires.
const UNUSED_FRICTION: &str = "0.005 0.0001";

/// How far a floor with shape reaches in a file, from where the walk begins (m).
const FLOOR_REACH: f64 = 10.0;

/// Writes the mechanism and a floor as MJCF, with friction, floor, payload and integration step from `parameters`. Of a
/// floor with shape, which is that of seed 0, it has what is within 10 m of where the walk begins.
///
/// `period` is the control period (s). The text is complete: MuJoCo loads it without other files.
pub fn mjcf_text(mechanism: &Mechanism, parameters: &PlantParameters, period: f64) -> String {
    let ground = parameters.ground(0);
    let pieces = (!ground.is_plane()).then(|| ground.pieces(Vector2::zeros(), FLOOR_REACH));
    mjcf_text_on(mechanism, parameters, pieces.as_deref(), period)
}

/// The same on these pieces of a floor, maybe none; on a plane for `None`.
pub fn mjcf_text_on(
    mechanism: &Mechanism,
    parameters: &PlantParameters,
    floor: Option<&[GroundPiece]>,
    period: f64,
) -> String {
    let mut out = XmlLines::default();
    let timestep = period / f64::from(parameters.steps_per_period);
    let friction = friction(parameters);
    out.open(format_args!(r#"mujoco model="{}""#, escape(&mechanism.name)));
    out.line(r#"<compiler angle="radian" inertiafromgeom="false" autolimits="true"/>"#);
    out.open(format_args!(
        r#"option timestep="{timestep}" gravity="{}" integrator="implicitfast" cone="elliptic" impratio="10""#,
        numbers(parameters.slope.gravity().as_slice())
    ));
    out.line(r#"<flag autoreset="disable"/>"#);
    out.close("option");
    out.line(r#"<statistic center="0 0 0.8" extent="2"/>"#);
    out.line(r#"<visual><global offwidth="1280" offheight="720"/><headlight ambient="0.4 0.4 0.4"/></visual>"#);
    let prisms: Vec<FloorPrism> = floor.unwrap_or_default().iter().map(FloorPrism::of).collect();
    appearance(&mut out, &prisms);

    out.open(r#"worldbody"#);
    out.line(r#"<light pos="0 0 4" dir="0 0 -1" directional="true"/>"#);
    if floor.is_none() {
        out.line(format_args!(
            r#"<geom name="floor" type="plane" size="0 0 0.5" contype="1" conaffinity="0" condim="3" {friction} {CONTACT} material="floor" rgba="1 1 1 1"/>"#
        ));
    }
    for (index, prism) in prisms.iter().enumerate() {
        // By its priority the friction is the floor's, not the larger one of floor and sole.
        out.line(format_args!(
            r#"<geom name="floor_{index}" type="mesh" mesh="floor_{index}" pos="{}" contype="1" conaffinity="0" condim="3" priority="1" friction="{} {UNUSED_FRICTION}" {CONTACT} rgba="0.8 0.82 0.86 1"/>"#,
            numbers(prism.at.as_slice()),
            prism.friction
        ));
    }
    body(&mut out, &MjcfBodies::of(mechanism), mechanism, parameters, Mechanism::RIGHT_FOOT);
    out.close("worldbody");

    out.open("actuator");
    for joint in Joint::ALL {
        let Some(motor) = mechanism.links[joint].motor else { continue };
        let torque_max = motor.torque_max();
        let name = joint.name();
        out.line(format_args!(
            r#"<motor name="{name}" joint="{name}" ctrllimited="false" forcerange="{} {torque_max}"/>"#,
            -torque_max
        ));
    }
    out.close("actuator");
    sensors(&mut out, mechanism);
    out.close("mujoco");
    out.text
}

fn friction(parameters: &PlantParameters) -> String {
    format!(r#"friction="{} {UNUSED_FRICTION}""#, parameters.contact.friction)
}

/// Textures and colours for viewers, and the shapes of the floor.
fn appearance(out: &mut XmlLines, floor: &[FloorPrism]) {
    out.open("asset");
    out.line(
        r#"<texture name="floor" type="2d" builtin="checker" rgb1="0.85 0.87 0.9" rgb2="0.75 0.78 0.82" width="200" height="200"/>"#,
    );
    out.line(r#"<material name="floor" texture="floor" texrepeat="2 2" texuniform="true"/>"#);
    out.line(
        r#"<texture type="skybox" builtin="gradient" rgb1="0.95 0.97 1" rgb2="0.7 0.8 0.9" width="64" height="64"/>"#,
    );
    for (index, prism) in floor.iter().enumerate() {
        let vertices: Vec<f64> = prism.vertices.iter().flat_map(|vertex| vertex.iter().copied()).collect();
        out.line(format_args!(r#"<mesh name="floor_{index}" vertex="{}"/>"#, numbers(&vertices)));
    }
    out.close("asset");
    out.open("default");
    out.line(r#"<geom contype="0" conaffinity="0" rgba="0.6 0.68 0.78 1"/>"#);
    out.close("default");
}

/// A body with the joints that lead to it and all that it carries.
fn body(out: &mut XmlLines, bodies: &MjcfBodies, mechanism: &Mechanism, parameters: &PlantParameters, link: Joint) {
    let root = Mechanism::RIGHT_FOOT;
    let place = if link == root { Vector3::zeros() } else { bodies.place_of(link) };
    out.open(format_args!(
        r#"body name="{}" pos="{}""#,
        link.link_name().unwrap_or(link.name()),
        numbers(place.as_slice())
    ));
    if link == root {
        out.line(r#"<freejoint name="right_sole"/>"#);
    } else {
        for (joint, place) in bodies.hinges_of(link) {
            hinge(out, mechanism, joint, place);
        }
    }
    let own = bodies.mass_of(link);
    if own.mass > 0.0 {
        inertial(out, &own);
    }
    if let Some(side) = Side::BOTH.into_iter().find(|side| mechanism.foot(*side) == link) {
        foot(out, mechanism, side, parameters);
    } else {
        appearance_of(out, bodies, link);
    }
    if link == Mechanism::TRUNK {
        out.line(r#"<site name="imu"/>"#);
        payload(out, parameters);
    }
    for child in bodies.carried_by(link) {
        body(out, bodies, mechanism, parameters, child);
    }
    out.close("body");
}

fn hinge(out: &mut XmlLines, mechanism: &Mechanism, joint: Joint, place: Vector3<f64>) {
    let link = &mechanism.links[joint];
    let range = link.limits.map_or(String::new(), |l| format!(r#" range="{} {}""#, l.angle_min, l.angle_max));
    let armature = link.motor.map_or(0.0, |motor| motor.reflected_inertia());
    out.line(format_args!(
        r#"<joint name="{}" type="hinge" axis="{}" pos="{}"{range} damping="0" armature="{armature}"/>"#,
        joint.name(),
        numbers(link.axis.as_slice()),
        numbers(place.as_slice()),
    ));
}

fn inertial(out: &mut XmlLines, body: &Body) {
    let turned = body.principal_axes.map_or_else(String::new, |axes| {
        let turn = UnitQuaternion::from_rotation_matrix(&axes);
        format!(r#" quat="{}""#, numbers(&[turn.w, turn.i, turn.j, turn.k]))
    });
    out.line(format_args!(
        r#"<inertial mass="{}" pos="{}"{turned} diaginertia="{}"/>"#,
        body.mass,
        numbers(body.com.as_slice()),
        numbers(body.inertia.as_slice())
    ));
}

/// Visual shape of a link: rods to the joints that it carries, and the box of its mass and moments if it carries none
/// or several.
fn appearance_of(out: &mut XmlLines, bodies: &MjcfBodies, link: Joint) {
    // There is no rod to a joint at the same point.
    let ends = bodies.carried_by(link).map(|child| bodies.place_of(child));
    let ends: Vec<_> = ends.filter(|end| end.norm() > 0.0).collect();
    for end in &ends {
        out.line(format_args!(r#"<geom type="capsule" fromto="0 0 0 {}" size="0.045"/>"#, numbers(end.as_slice())));
    }
    let body = bodies.mass_of(link);
    if ends.len() != 1 && body.mass > 0.0 {
        let half = equivalent_sides(&body) / 2.0;
        out.line(format_args!(
            r#"<geom type="box" pos="{}" size="{}"/>"#,
            numbers(body.com.as_slice()),
            numbers(half.as_slice())
        ));
    }
}

/// Writes the foot as a box on its sole, half as high as the ankle.
fn foot(out: &mut XmlLines, mechanism: &Mechanism, side: Side, parameters: &PlantParameters) {
    let friction = friction(parameters);
    let sole = mechanism.sole;
    let height = sole.ankle_height / 2.0;
    let at = mechanism.sole_in_foot(side);
    let half = sole.half_size().push(height / 2.0);
    let centre = at + sole.centre(side).push(height / 2.0);
    let name = side_name(side);
    out.line(format_args!(
        r#"<geom name="{name}_foot" type="box" pos="{}" size="{}" contype="0" conaffinity="1" condim="3" {friction} {CONTACT} rgba="0.85 0.5 0.25 1"/>"#,
        numbers(centre.as_slice()),
        numbers(half.as_slice())
    ));
    out.line(format_args!(r#"<site name="{name}_sole" pos="{}"/>"#, numbers(at.as_slice())));
}

/// What the trunk carries: a point, but for the trace of inertia that MuJoCo wants a body to have.
fn payload(out: &mut XmlLines, parameters: &PlantParameters) {
    let payload = parameters.payload;
    if payload.mass > 0.0 {
        out.open(format_args!(r#"body name="payload" pos="{}""#, numbers(payload.at.as_slice())));
        inertial(out, &Body { mass: payload.mass, inertia: Vector3::repeat(1e-9), ..Body::NONE });
        out.line(r#"<geom type="sphere" size="0.05" rgba="0.7 0.4 0.2 1"/>"#);
        out.close("body");
    }
}

/// Writes the sensors: joint angles and rates, the trunk's orientation and rate, and the floor's force on each foot.
fn sensors(out: &mut XmlLines, mechanism: &Mechanism) {
    out.open("sensor");
    for (kind, suffix) in [("jointpos", "angle"), ("jointvel", "rate")] {
        for joint in Joint::ALL.into_iter().filter(|joint| mechanism.has(*joint)) {
            let name = joint.name();
            out.line(format_args!(r#"<{kind} name="{name}_{suffix}" joint="{name}"/>"#));
        }
    }
    out.line(r#"<framequat name="imu_orientation" objtype="site" objname="imu"/>"#);
    out.line(r#"<gyro name="imu_rate" site="imu"/>"#);
    for side in Side::BOTH.map(side_name) {
        out.line(format_args!(
            r#"<contact name="{side}_ground" body1="world" geom2="{side}_foot" data="force torque pos" reduce="netforce"/>"#
        ));
    }
    out.close("sensor");
}

#[cfg(test)]
mod tests {
    use config::Config;
    use nalgebra::Vector3;
    use plant::{Payload, Slope};

    use super::*;

    fn plant_parameters() -> PlantParameters {
        PlantParameters::load(format!("{}/../../config/plant.toml", env!("CARGO_MANIFEST_DIR")))
            .expect("the committed file loads")
    }

    fn mechanism() -> Mechanism {
        load("mechanism.toml")
    }

    fn load(file: &str) -> Mechanism {
        Mechanism::load(format!("{}/../../config/{file}", env!("CARGO_MANIFEST_DIR")))
            .unwrap_or_else(|errors| panic!("{errors}"))
    }

    /// The robots in the box with their names.
    fn robots() -> Vec<(String, Mechanism)> {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/robots");
        let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let named = names.map(|name| (name.clone(), load(&format!("robots/{name}/mechanism.toml"))));
        let robots: Vec<_> = named.chain([("paper".to_owned(), mechanism())]).collect();
        assert_eq!(robots.len(), 10);
        robots
    }

    /// All values of an attribute in a text.
    fn values<'t>(text: &'t str, attribute: &str) -> Vec<&'t str> {
        let from = format!(" {attribute}=\"");
        text.split(&from).skip(1).filter_map(|rest| rest.split('"').next()).collect()
    }

    #[test]
    fn mjcf_model_has_the_mass_of_the_mechanism() {
        for (name, mechanism) in robots() {
            let text = mjcf_text(&mechanism, &plant_parameters(), 1e-3);
            let mass: f64 = values(&text, "mass").iter().map(|mass| mass.parse::<f64>().unwrap()).sum();
            assert!((mass - mechanism.mass()).abs() < 1e-12, "{name}: {mass}");
        }
        assert_eq!(values(&mjcf_text(&mechanism(), &plant_parameters(), 1e-3), "mass").len(), 12, "no massless bodies");
    }

    #[test]
    fn every_powered_joint_is_there_once_and_driven() {
        for (name, mechanism) in robots() {
            let text = mjcf_text(&mechanism, &plant_parameters(), 1e-3);
            for joint in Joint::ALL {
                let count = |tag: &str| text.matches(&format!("<{tag} name=\"{}\"", joint.name())).count();
                let sensors = text.matches(&format!(" joint=\"{}\"/>", joint.name())).count();
                let has = usize::from(mechanism.has(joint));
                assert_eq!((count("joint"), count("motor"), sensors), (has, has, 2 * has), "{name} {}", joint.name());
            }
        }
    }

    #[test]
    fn every_element_is_closed_and_every_body_has_a_name_of_its_own() {
        for (name, mechanism) in robots() {
            let text = mjcf_text(&mechanism, &plant_parameters(), 1e-3);
            let mut open = Vec::new();
            let mut bodies = Vec::new();
            for line in text.lines().map(str::trim) {
                let tag = line.trim_matches(['<', '>', '/']).split([' ', '>']).next().unwrap();
                match (line.starts_with("</"), line.contains("/>") || line.contains("</")) {
                    (true, _) => assert_eq!(open.pop(), Some(tag), "{name}"),
                    (false, true) => {}
                    (false, false) => open.push(tag),
                }
                if tag == "body" && !line.starts_with("</") {
                    bodies.push(line.split('"').nth(1).unwrap());
                }
            }
            assert_eq!(open, Vec::<&str>::new(), "{name}");
            bodies.sort_unstable();
            assert!(bodies.windows(2).all(|pair| pair[0] != pair[1]), "{name}: {bodies:?}");
        }
    }

    #[test]
    fn the_floor_is_the_plants() {
        let parameters = PlantParameters {
            slope: Slope { ahead: 0.1, left: 0.0 },
            payload: Payload { mass: 5.0, at: Vector3::new(0.0, 0.0, 0.28) },
            steps_per_period: 2,
            ..plant_parameters()
        };
        let text = mjcf_text(&mechanism(), &parameters, 1e-3);
        assert_eq!(values(&text, "timestep"), ["0.0005"]);
        assert!(values(&text, "friction").iter().all(|friction| friction.starts_with("0.8 ")));
        let gravity: Vec<f64> = values(&text, "gravity")[0].split(' ').map(|number| number.parse().unwrap()).collect();
        assert!((gravity[0] + 9.80665 * 0.1_f64.sin()).abs() < 1e-12, "{gravity:?}");
        assert!(text.contains(r#"<body name="payload" pos="0 0 0.28">"#));
    }
}
