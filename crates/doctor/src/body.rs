//! The body: whether masses, inertias and soles can be those of a biped of this size.

use model::{Joint, LegReach, Mechanism, Side, Sole};

use crate::examined_robot::ExaminedRobot;
use crate::finding::{Finding, Remedy};

const CHECK: &str = "model";
const FILE: &str = "mechanism.toml";
/// Mass over the cube of the leg's length (kg/m³): the paper's robot has 116, public ones 86 to 290.
const DENSITY: [f64; 2] = [30.0, 1000.0];
/// Greatest radius of gyration of a body, and distance of its centre of mass from its joint, per length of the leg.
const REACH_MAX: f64 = 0.7;
/// Least length and width of a sole per length of the leg: public robots have 0.27 and 0.09.
const SOLE_MIN: [f64; 2] = [0.15, 0.055];

/// Checks masses, inertias and soles.
pub fn check(examined: &ExaminedRobot) -> Finding {
    let mechanism = &examined.setup.mechanism;
    let (mass, leg, sole) = (mechanism.mass(), examined.leg(), &mechanism.sole);
    let size = sole.half_size() * 2.0;
    let figure = format!("{mass:.1} kg, legs of {leg:.3} m, soles of {:.0} × {:.0} mm", size.x * 1e3, size.y * 1e3);
    match wrong_mass(mechanism, leg).or_else(|| wrong_body(mechanism, leg)).or_else(|| wrong_sole(sole, leg)) {
        Some((wrong, remedy)) => Finding::bad(CHECK, figure, wrong, vec![remedy]),
        None => Finding::good(CHECK, figure),
    }
}

fn remedy(key: String, advice: &str) -> Remedy {
    Remedy { file: FILE, key, advice: advice.to_owned() }
}

fn wrong_mass(mechanism: &Mechanism, leg: f64) -> Option<(String, Remedy)> {
    let [least, most] = DENSITY.map(|density| density * leg.powi(3));
    let mass = mechanism.mass();
    let heaviest = Joint::ALL
        .into_iter()
        .max_by(|one, other| mechanism.links[*one].body.mass.total_cmp(&mechanism.links[*other].body.mass))?;
    (!(least..=most).contains(&mass)).then(|| {
        let wrong = format!("a biped with legs of {leg:.3} m weighs {least:.0} to {most:.0} kg, not {mass:.1} kg");
        let key = format!("joint.{}.mass_kg", heaviest.name());
        (wrong, remedy(key, "check the masses, and their unit, kilograms; this is the heaviest link"))
    })
}

fn wrong_body(mechanism: &Mechanism, leg: f64) -> Option<(String, Remedy)> {
    Joint::ALL.into_iter().filter(|joint| mechanism.links[*joint].body.mass > 0.0).find_map(|joint| {
        let body = &mechanism.links[joint].body;
        let gyration = (body.inertia.max() / body.mass).sqrt();
        let (name, most) = (joint.name(), REACH_MAX * leg);
        if gyration > most {
            let wrong = format!("the inertia of {name} puts its mass {gyration:.2} m apart, more than {most:.2} m");
            return Some((wrong, remedy(format!("joint.{name}.inertia_kg_m2"), "check its unit, kg·m²")));
        }
        let far = body.com.norm();
        (far > most).then(|| {
            let wrong = format!("the centre of mass of {name} is {far:.2} m from its joint, more than {most:.2} m");
            (wrong, remedy(format!("joint.{name}.com_m"), "check its unit, metres"))
        })
    })
}

fn wrong_sole(sole: &Sole, leg: f64) -> Option<(String, Remedy)> {
    let size = sole.half_size() * 2.0;
    let [length, width] = SOLE_MIN.map(|share| share * leg);
    let centre = sole.centre(Side::Right);
    let (key, has, needs) = if sole.inside.min(sole.outside) <= 0.0 {
        ("sole.inside_m", sole.inside.min(sole.outside), 0.0)
    } else if size.y < width {
        ("sole.width_m", size.y, width)
    } else if sole.ahead.min(sole.behind) <= 0.0 {
        (if centre.x > 0.0 { "sole.behind_m" } else { "sole.ahead_m" }, sole.ahead.min(sole.behind), 0.0)
    } else if size.x < length {
        ("sole.ahead_m", size.x, length)
    } else {
        return None;
    };
    let wrong = format!(
        "the sole has {:.0} mm where it needs {:.0} mm: the ankles cannot balance the robot on it",
        has * 1e3,
        needs * 1e3
    );
    Some((wrong, remedy(key.to_owned(), "a larger sole; then make the half-step anew with `halfstep synthesize`")))
}

/// Height of the centre of mass over the soles when the robot stands straight (m).
pub(crate) fn standing_height(mechanism: &Mechanism) -> f64 {
    let tree = dynamics::Tree::new(mechanism);
    let kinematics = dynamics::Kinematics::fixed_base(&tree, &model::JointVector::ZERO);
    kinematics.com(&tree).z.max(0.5 * LegReach::of(mechanism).length())
}
