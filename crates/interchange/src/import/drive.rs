//! Range, rate and torque of a joint.

use model::DcMotor;

use crate::import::import_map::MapJoint;
use crate::import::urdf_robot::{JointKind, UrdfTreeJoint};

/// Share of a motor's speed without load at which its joint is used at most.
const NO_LOAD_SHARE: f64 = 0.85;
/// Rate where nothing tells one: that of the built-in robot, 500 °/s with legs of 0.856 m; it grows with the inverse
/// root of the length (Froude).
const RATE_DEFAULT: f64 = 8.7;
const RATE_DEFAULT_LEG: f64 = 0.856;
/// Greatest rate that a mechanism file may have (rad/s).
const RATE_MAX: f64 = 174.5;
/// Torque where nothing tells one, as a share of weight times leg length: about that of the built-in robot.
const EFFORT_DEFAULT: f64 = 0.5;
/// Inertia of a rotor at its joint, as a share of mass times the leg's length squared: that of the built-in robot. A
/// URDF tells none, and a drive without rotor shakes.
const ARMATURE_DEFAULT: f64 = 0.0026;
/// From this share on, a torque is no limit worth the name.
const EFFORT_LARGE: f64 = 5.0;
/// Greatest torque that a mechanism file may have (N·m).
const EFFORT_MAX: f64 = 1e5;
/// Beyond this an angle of a URDF cannot be meant in radians.
const ANGLE_MAX: f64 = 1.01 * std::f64::consts::TAU;
/// A smaller range is none (rad).
const RANGE_MIN: f64 = 1.75e-4;
/// Standard gravity (m/s²).
const GRAVITY: f64 = 9.80665;

/// What a joint can do, in the URDF's sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointDrive {
    /// Smallest and largest angle (rad).
    pub range: [f64; 2],
    /// Largest rate (rad/s).
    pub rate_max: f64,
    /// Largest torque (N·m); unused if there is a motor.
    pub effort: f64,
    /// Index among the map's motors.
    pub motor: Option<usize>,
}

/// Sizes that defaults follow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Length of the stretched leg from hip to ankle (m).
    pub leg: f64,
    /// Mass (kg).
    pub mass: f64,
}

impl Scale {
    /// The inertia of a rotor at its joint that is assumed of every joint without a motor in the map (kg·m²).
    pub(super) fn armature(self) -> f64 {
        ARMATURE_DEFAULT * self.mass * self.leg * self.leg
    }
}

/// What was assumed or changed, each with the joints that it is true of.
#[derive(Clone, Debug, Default)]
pub(super) struct DriveNotes(Vec<(String, Vec<String>)>);

impl DriveNotes {
    fn add(&mut self, what: String, joint: &str) {
        match self.0.iter_mut().find(|(other, _)| *other == what) {
            Some((_, joints)) => joints.push(joint.to_string()),
            None => self.0.push((what, vec![joint.to_string()])),
        }
    }

    /// One line for each note.
    pub(super) fn lines(self) -> impl Iterator<Item = String> {
        self.0.into_iter().map(|(what, joints)| format!("{what}: {}", joints.join(", ")))
    }
}

/// The drive of a joint, or what is wrong with its limits.
pub(super) fn drive(
    joint: &UrdfTreeJoint,
    map: MapJoint,
    motors: &[(String, DcMotor)],
    scale: Scale,
    notes: &mut DriveNotes,
) -> Result<JointDrive, String> {
    let limit = joint.limit;
    let range = match (map.range, joint.kind) {
        (Some(range), _) => range,
        (None, JointKind::Continuous) => [-std::f64::consts::PI, std::f64::consts::PI],
        (None, _) if !limit.given => {
            return Err("must have <limit lower=\"…\" upper=\"…\"> (radians), or range_deg in the map".into());
        }
        (None, _) => checked_range(limit.lower, limit.upper)?,
    };
    if range[1] - range[0] < RANGE_MIN {
        let [low, high] = range.map(f64::to_degrees);
        return Err(format!("must have a range of at least 0.01°; it has {low} to {high}°: give range_deg in the map"));
    }
    if map.range.is_none() && joint.kind == JointKind::Revolute && !limit.complete {
        notes.add("the URDF tells but one end of the range; the other one is 0".to_string(), &joint.name);
    }
    if !(range[0] <= 0.0 && 0.0 <= range[1]) {
        let [low, high] = range.map(f64::to_degrees);
        notes.add(format!("the range {low:.1}° to {high:.1}° leaves out the straight posture"), &joint.name);
    }
    let motor = map.motor.and_then(|index| motors.get(index));
    Ok(JointDrive {
        range,
        rate_max: rate(joint, map.rate_max, motor, scale, notes),
        effort: effort(joint, map, scale, notes),
        motor: map.motor,
    })
}

/// The torque of a joint that is held (N·m): as that of one with a role that the map does not mention.
pub(super) fn held_effort(joint: &UrdfTreeJoint, scale: Scale) -> f64 {
    effort(joint, MapJoint::default(), scale, &mut DriveNotes::default())
}

fn checked_range(lower: f64, upper: f64) -> Result<[f64; 2], String> {
    let told = format!("<limit lower = \"{lower}\" upper = \"{upper}\">");
    if lower.abs().max(upper.abs()) > ANGLE_MAX {
        let degrees = [lower, upper].map(f64::to_degrees);
        return Err(format!(
            "{told}: would be {:.0}° to {:.0}°; must be in radians, and looks like degrees",
            degrees[0], degrees[1]
        ));
    }
    if lower > upper {
        return Err(format!("{told}: lower must be less than upper; or give range_deg in the map"));
    }
    if lower == upper {
        return Err(format!("{told}: must leave the joint a range; or give range_deg in the map"));
    }
    Ok([lower, upper])
}

fn rate(
    joint: &UrdfTreeJoint,
    told: Option<f64>,
    motor: Option<&(String, DcMotor)>,
    scale: Scale,
    notes: &mut DriveNotes,
) -> f64 {
    let urdf = joint.limit.velocity.filter(|velocity| *velocity > 0.0);
    let said = match joint.limit.velocity {
        Some(_) => "the URDF tells no rate (velocity 0)",
        None => "the URDF tells no rate (no velocity)",
    };
    let told = told.or(urdf);
    if let Some((name, motor)) = motor {
        let usable = NO_LOAD_SHARE * motor.no_load_speed();
        let words = format!(
            "{:.0} °/s, {:.0} % of what motor {name} does without load",
            usable.to_degrees(),
            100.0 * NO_LOAD_SHARE
        );
        match told {
            None => notes.add(format!("{said}; taken {words}"), &joint.name),
            Some(told) if told > usable => {
                notes.add(format!("rate limited to {words} (told: {:.0} °/s)", told.to_degrees()), &joint.name);
            }
            Some(_) => {}
        }
        return told.unwrap_or(usable).min(usable);
    }
    match told {
        Some(told) if told > RATE_MAX => {
            let words = format!("rate limited to {:.0} °/s", RATE_MAX.to_degrees());
            notes.add(
                format!("{words} (the URDF tells {told} rad/s, which is no limit worth the name: or is it in °/s?)"),
                &joint.name,
            );
            RATE_MAX
        }
        Some(told) => told,
        None => {
            let rate = RATE_DEFAULT * (RATE_DEFAULT_LEG / scale.leg).sqrt();
            let words = format!("{said}; assumed {:.0} °/s for a leg of {:.2} m", rate.to_degrees(), scale.leg);
            notes.add(words, &joint.name);
            rate
        }
    }
}

fn effort(joint: &UrdfTreeJoint, map: MapJoint, scale: Scale, notes: &mut DriveNotes) -> f64 {
    let unit = scale.mass * GRAVITY * scale.leg;
    if let Some(told) = map.effort {
        return told;
    }
    let assumed = EFFORT_DEFAULT * unit;
    let default = |words: String, notes: &mut DriveNotes| {
        if map.motor.is_none() {
            notes.add(format!("{words}; assumed {assumed:.3} N·m, half of weight times leg length"), &joint.name);
        }
        assumed
    };
    match joint.limit.effort.filter(|effort| *effort > 0.0) {
        None => default("the URDF tells no torque (effort 0 or none)".to_string(), notes),
        Some(effort) if effort > EFFORT_MAX => {
            default(format!("the URDF tells {effort} N·m, which is no limit worth the name"), notes)
        }
        Some(effort) => {
            if effort > EFFORT_LARGE * unit && map.motor.is_none() {
                let times = effort / unit;
                let words = format!(
                    "torque {effort} N·m taken as given, though it is {times:.0} times weight times leg length"
                );
                notes.add(words, &joint.name);
            }
            effort
        }
    }
}
