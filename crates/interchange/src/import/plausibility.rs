//! Sizes that no biped has: mistakes of unit.

use crate::import::body::LumpedBody;
use crate::import::drive::Scale;
use crate::import::file_errors::FileErrors;
use crate::import::urdf_robot::UrdfRobot;

/// Length of a leg (m).
const LEG: [f64; 2] = [0.1, 2.0];
/// Mass over the cube of the leg's length (kg/m³): humans and humanoids have 80 to 450.
const DENSITY: [f64; 2] = [8.0, 4000.0];
/// Largest radius of gyration of a part of the robot, in leg lengths.
const GYRATION_MAX: f64 = 10.0;

/// How far a link's centre of mass may be from its frame, in leg lengths.
const COM_MAX: f64 = 5.0;

/// Notes lengths, masses and moments of inertia that no biped has, with the unit that is suspected.
pub(super) fn check(scale: Scale, robot: &UrdfRobot, bodies: &[(&str, LumpedBody)], errors: &mut FileErrors) {
    let Scale { leg, mass } = scale;
    let [short, long] = LEG;
    if !(short..=long).contains(&leg) {
        let unit = if leg > 100.0 {
            ": it looks like millimetres"
        } else if leg > long {
            ": it looks like centimetres or inches"
        } else {
            ""
        };
        errors.note(format!(
            "the legs are {leg:.4} long from hip to ankle, in the URDF's unit, metres; they must have {short} to \
             {long} m{unit}"
        ));
        return;
    }
    if mass <= 0.0 {
        errors.note("the robot weighs nothing: its links must have <inertial> with <mass> (kilograms)");
        return;
    }
    let density = mass / leg.powi(3);
    if !(DENSITY[0]..=DENSITY[1]).contains(&density) {
        let [least, most] = DENSITY.map(|density| density * leg.powi(3));
        let unit = if density > DENSITY[1] { "grams" } else { "tonnes" };
        errors.note(format!(
            "the robot weighs {mass:.4} in the URDF's unit, kilograms; with legs of {leg:.3} m it must have {least:.2} \
             to {most:.0} kg: it looks like {unit}"
        ));
    }
    for link in robot.links.iter().filter(|link| link.body.mass > 0.0 && link.body.com.norm() > COM_MAX * leg) {
        let far = link.body.com.norm();
        errors.note_at(
            link.line,
            format!(
                "link {}: its centre of mass is {far:.3} m from its frame, and the leg {leg:.3} m long: <origin xyz> \
                 must be in metres, and looks like another unit",
                link.name
            ),
        );
    }
    for (name, body) in bodies {
        let must_weigh = ["thigh", "shank", "foot", "trunk"].iter().any(|part| name.ends_with(part));
        if must_weigh && body.mass <= 0.0 {
            errors.note(format!("{name} weighs nothing: its links must have <inertial> with <mass> (kilograms)"));
        }
        let gyration = (body.inertia.diagonal().max() / body.mass).sqrt();
        if body.mass > 0.01 * mass && gyration > GYRATION_MAX * leg {
            errors.note(format!(
                "{name}: its mass of {:.3} kg and its greatest moment of inertia, {:.4} kg·m², would put it \
                 {gyration:.1} m apart: the moments must be in kg·m², and look like another unit",
                body.mass,
                body.inertia.diagonal().max()
            ));
        }
    }
}
