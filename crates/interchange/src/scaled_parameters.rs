//! Parameters of controller and plant in a robot's proportions: the files of the paper's robot with every number that
//! has the size of a robot scaled.
//!
//! Lengths scale as the legs, times as the root of it (Froude's law), forces as the weight. What has no size, and what
//! is a property of sensors, stays.

use model::{LegReach, Mechanism, Servo, Servos};

/// Mass of the paper's robot, for which the files were written (kg).
const PAPER_MASS: f64 = 73.031;
/// Servos of the paper's robot.
const PAPER_SERVOS: Servos = Servos {
    legs_and_waist: Servo { stiffness: 5000.0, damping: 150.0 },
    arms: Servo { stiffness: 500.0, damping: 15.0 },
};
/// Significant digits of a scaled number: no one measures more.
const DIGITS: i32 = 4;

/// What a number is multiplied by: powers of the ratios of mass and length.
#[derive(Clone, Copy, Debug)]
struct Scaling {
    table: &'static str,
    key: &'static str,
    mass: f64,
    length: f64,
}

const fn by(table: &'static str, key: &'static str, mass: f64, length: f64) -> Scaling {
    Scaling { table, key, mass, length }
}

/// The numbers of `controller.toml` that have the size of the robot.
const CONTROLLER: &[Scaling] = &[
    by("gait", "speed_ramp_s", 0.0, 0.5),
    by("forecast", "clearance_min_m", 0.0, 1.0),
    by("zmp", "force_min_n", 1.0, 0.0),
    by("feedback", "edge_m", 0.0, 1.0),
    by("feedback", "zmp_lag_s", 0.0, 0.5),
    by("feedback", "lag_s", 0.0, 0.5),
    by("feedback", "fade_s", 0.0, 0.5),
    by("landing", "damping_n_s_per_m", 1.0, -0.5),
    by("landing", "return_time_s", 0.0, 0.5),
    by("watch", "trunk_rate_jump_max_rad_per_s", 0.0, -0.5),
];

/// The numbers of `plant.toml` that have the size of the robot.
const PLANT: &[Scaling] = &[
    by("payload", "at_m", 0.0, 1.0),
    by("contact", "stiffness_n_per_m", 1.0, -1.0),
    by("contact", "damping_n_s_per_m", 1.0, -0.5),
    by("contact", "stiffness_tangential_n_per_m", 1.0, -1.0),
    by("contact", "damping_tangential_n_s_per_m", 1.0, -0.5),
    by("sensors", "force_noise_n", 1.0, 0.0),
    by("sensors", "moment_noise_n_m", 1.0, 1.0),
];

/// The text of a robot's `controller.toml`.
///
/// * `paper` – that of the paper's robot
pub fn controller_text(paper: &str, mechanism: &Mechanism) -> String {
    scaled(paper, CONTROLLER, mechanism)
}

/// The text of a robot's `plant.toml`.
///
/// * `paper` – that of the paper's robot
pub fn plant_text(paper: &str, mechanism: &Mechanism) -> String {
    scaled(paper, PLANT, mechanism)
}

/// The servos of a robot's drives: stiffness as weight times length, and damping as that times the time.
///
/// * `mass` – of the robot (kg)
/// * `leg` – length of its stretched leg from hip to ankle (m)
pub fn servos(mass: f64, leg: f64) -> Servos {
    let [mass, length] = [mass / PAPER_MASS, leg / LegReach::PAPER_LENGTH];
    let scaled = |servo: Servo| Servo {
        stiffness: rounded(servo.stiffness * mass * length),
        damping: rounded(servo.damping * mass * libm::pow(length, 1.5)),
    };
    Servos { legs_and_waist: scaled(PAPER_SERVOS.legs_and_waist), arms: scaled(PAPER_SERVOS.arms) }
}

/// Scales the numbers in a file line by line, so that its comments stay.
fn scaled(text: &str, scalings: &[Scaling], mechanism: &Mechanism) -> String {
    let ratios = [mechanism.mass() / PAPER_MASS, LegReach::of(mechanism).scale()];
    let mut table = "";
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
            table = name;
        }
        let key = line.split('=').next().unwrap_or_default().trim();
        match scalings.iter().find(|scaling| scaling.table == table && scaling.key == key) {
            Some(scaling) => out += &scaled_line(line, scaling.factor(ratios)),
            None => out += line,
        }
        out.push('\n');
    }
    out
}

impl Scaling {
    fn factor(&self, [mass, length]: [f64; 2]) -> f64 {
        libm::pow(mass, self.mass) * libm::pow(length, self.length)
    }
}

/// A line `key = value` or `key = [values]` with each number multiplied.
fn scaled_line(line: &str, factor: f64) -> String {
    let Some((key, value)) = line.split_once('=') else { return line.to_owned() };
    let (value, comment) = value.split_once('#').map_or((value, None), |(value, comment)| (value, Some(comment)));
    let mut scaled = String::new();
    for part in value.split_inclusive([',', '[', ']', ' ']) {
        let (number, rest) = part.split_at(part.trim_end_matches([',', '[', ']', ' ']).len());
        match number.parse::<f64>() {
            Ok(number) => scaled += &(rounded(number * factor).to_string() + rest),
            Err(_) => scaled += part,
        }
    }
    let comment = comment.map_or(String::new(), |comment| format!("#{comment}"));
    format!("{key}={scaled}{comment}")
}

/// A number with a few significant digits.
fn rounded(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let grain = 10_f64.powi(DIGITS - 1 - libm::log10(value.abs()).floor() as i32);
    (value * grain).round() / grain
}

#[cfg(test)]
mod tests {
    use config::Config;
    use plant::PlantParameters;

    use super::*;

    const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config");

    fn text(name: &str) -> String {
        std::fs::read_to_string(format!("{FOLDER}/{name}")).expect("it is committed")
    }

    fn mechanism() -> Mechanism {
        Mechanism::load(format!("{FOLDER}/mechanism.toml")).expect("the committed file loads")
    }

    #[test]
    fn the_papers_robot_keeps_its_numbers_and_each_is_found() {
        let paper = PlantParameters::load(format!("{FOLDER}/plant.toml")).expect("it loads");
        let text_of_plant = plant_text(&text("plant.toml"), &mechanism());
        assert_eq!(PlantParameters::from_toml(&text_of_plant, "plant.toml").expect("it loads"), paper);
        let own = mechanism();
        assert_eq!(servos(own.mass(), LegReach::of(&own).length()), own.servos);
        for (name, scalings) in [("controller.toml", CONTROLLER), ("plant.toml", PLANT)] {
            let file = text(name);
            for Scaling { table, key, .. } in scalings {
                let after = file.split(&format!("\n[{table}]")).nth(1).expect("the table is there");
                assert!(after.split("\n[").next().is_some_and(|rows| rows.contains(&format!("\n{key} ="))), "{key}");
            }
        }
    }

    /// A robot of half the length has an eighth of the mass.
    #[test]
    fn a_robot_of_half_the_size_has_its_own_numbers() {
        let mut half = mechanism();
        for link in &mut half.links.0 {
            link.origin *= 0.5;
            link.body.mass *= 0.125;
        }
        half.sole.ankle_height *= 0.5;
        let plant =
            PlantParameters::from_toml(&plant_text(&text("plant.toml"), &half), "plant.toml").expect("it loads");
        assert!((plant.contact.stiffness - 2.5e5).abs() < 1e2, "{}", plant.contact.stiffness);
        let knee = servos(half.mass(), LegReach::of(&half).length()).legs_and_waist;
        assert!((knee.stiffness - 312.5).abs() < 0.1 && (knee.damping - 6.629).abs() < 0.01, "{knee:?}");
        let controller = controller_text(&text("controller.toml"), &half);
        assert!(controller.contains("\nforce_min_n = 6.25\n"));
        assert!(controller.contains("# The ZMP estimator."), "comments stay");
        assert!((plant.payload.at.z - 0.14).abs() < 1e-9);
    }
}
