//! Reading a mechanism from its file (`config/mechanism.toml`), strictly.
//!
//! All mistakes are reported at once, each with line, key, value and what would be right: see [`config`].

mod fingerprint;
mod symmetry;

use config::{Config, Table};
use nalgebra::{Unit, Vector3};

use crate::{Body, Joint, JointLimits, Link, Mechanism, Motor, PerJoint, Sole};

/// Largest distance between two joints, or of a centre of mass from its joint (m).
const LENGTH_MAX: f64 = 3.0;
/// Largest mass of a link (kg).
const MASS_MAX: f64 = 1000.0;
/// Smallest and largest moment of inertia of a link (kg·m²).
const MOMENT_MIN: f64 = 1e-10;
const MOMENT_MAX: f64 = 1000.0;
/// Largest inertia of a rotor at its joint (kg·m²).
const REFLECTED_INERTIA_MAX: f64 = 100.0;

/// Beside keys and values that are wrong by themselves, a file is refused for a broken tree, axes that are not unit
/// vectors, impossible inertias, joints faster than their motors, and a robot that is not left–right symmetric.
impl Config for Mechanism {
    fn read(root: &Table) -> Self {
        let name = root.text("name").to_string();
        let sole = Sole::read(&root.table("sole"));
        let motors = Motor::read_all(root);
        let joint_table = root.table("joint");
        let tables = PerJoint::from_fn(|joint| joint_table.table(joint.name()));
        let links = PerJoint::from_fn(|joint| link(joint, &tables[joint], &motors));

        let mut mechanism = Mechanism { name, links, sole, fingerprint: 0 };
        check_stance(&tables, &mechanism);
        symmetry::check(&tables, &mechanism);
        mechanism.fingerprint = fingerprint::of(&mechanism);
        mechanism
    }
}

impl Sole {
    /// Reads a table `[sole]`, noting what is wrong.
    pub fn read(table: &Table) -> Self {
        Self {
            behind: table.number("behind_m").between(1e-3, 2.0),
            ahead: table.number("ahead_m").between(1e-3, 2.0),
            half_width: table.number("width_m").between(1e-3, 2.0) / 2.0,
            ankle_height: table.number("ankle_height_m").between(0.0, 1.0),
        }
    }
}

impl Motor {
    /// Reads all tables `[motor.NAME]` of a file, noting what is wrong: name and motor of each. Joints of one type
    /// share a motor.
    pub fn read_all<'d>(root: &Table<'d>) -> Vec<(&'d str, Self)> {
        root.named_tables("motor").iter().map(|(name, table)| (*name, Self::read(table))).collect()
    }

    fn read(table: &Table) -> Self {
        let motor = Self {
            resistance: table.number("resistance_ohm").between(1e-3, 1e4),
            torque_constant: table.number("torque_constant_n_m_per_a").between(1e-5, 100.0),
            gear_ratio: table.number("gear_ratio").between(0.01, 1e4),
            rotor_inertia: table.number("rotor_inertia_kg_m2").between(1e-12, 1.0),
            voltage_max: table.number("voltage_max_v").between(0.1, 1000.0),
        };
        let reflected = motor.reflected_inertia();
        if reflected > REFLECTED_INERTIA_MAX {
            let must = format!(
                "must be smaller: times gear_ratio² it is {reflected:.0} kg·m² at the joint, and may be at most \
                 {REFLECTED_INERTIA_MAX}"
            );
            table.refuse("rotor_inertia_kg_m2", &must);
        }
        motor
    }
}

fn link(joint: Joint, table: &Table, motors: &[(&str, Motor)]) -> Link {
    let number = f64::from(joint.number());
    table.number("number").that(|value| value == number, &format!("must be {number}, the number of {}", joint.name()));
    let parent = parent(joint, table);
    let is_unit = |axis: &[f64; 3]| (Vector3::from(*axis).norm() - 1.0).abs() <= 1e-9;
    let axis = Vector3::from(table.numbers("axis").that(is_unit, "must be a unit vector such as [0, 1, 0]"));
    let origin = Vector3::from(table.numbers("origin_m").between(-LENGTH_MAX, LENGTH_MAX));

    // Between foot and ground there is no body, only an axis.
    let body = if joint == Joint::FootRoll { Body::NONE } else { body(table) };
    let (limits, motor) = if joint.is_powered() { drive(table, motors) } else { (None, None) };
    Link { parent, axis: Unit::new_normalize(axis), origin, body, limits, motor }
}

/// The parent joint; the ground for the first joint only. Parents come before children, so there can be no cycle.
fn parent(joint: Joint, table: &Table) -> Option<Joint> {
    let name = table.text("parent");
    let parent = Joint::from_name(name);
    let below = joint.index().checked_sub(1).map(|index| Joint::ALL[index]);
    let (right, must) = match below {
        None => (name == "ground", "must be \"ground\": the tree stands on this joint".to_string()),
        Some(below) if joint.is_in_leg() || joint == Joint::FootPitch => {
            (parent == Some(below), format!("must be \"{}\": the legs are one chain from foot to foot", below.name()))
        }
        Some(below) => (
            parent.is_some_and(|parent| parent < joint),
            format!("must name a joint that comes before this one (numbers 1 to {})", below.number()),
        ),
    };
    if !right && !name.is_empty() {
        table.refuse("parent", &must);
    }
    parent
}

fn body(table: &Table) -> Body {
    let keys = ["mass_kg", "com_m", "inertia_kg_m2"].map(|key| table.has(key));
    if keys == [false; 3] {
        return Body::NONE;
    }
    Body {
        mass: table.number("mass_kg").between(1e-4, MASS_MAX),
        com: table.numbers("com_m").between(-LENGTH_MAX, LENGTH_MAX).into(),
        inertia: table
            .numbers("inertia_kg_m2")
            .that(
                |moments| {
                    let sum: f64 = moments.iter().sum();
                    let right = |moment: f64| (MOMENT_MIN..=MOMENT_MAX).contains(&moment) && moment <= sum - moment;
                    moments.iter().all(|&moment| right(moment))
                },
                &format!(
                    "must be three principal moments, each between {MOMENT_MIN} and {MOMENT_MAX} and at most the sum \
                     of the other two"
                ),
            )
            .into(),
    }
}

fn drive(table: &Table, motors: &[(&str, Motor)]) -> (Option<JointLimits>, Option<Motor>) {
    let [angle_min, angle_max] = table.angles("range_deg").increasing_between(-720.0, 720.0);
    let rate_max = table.angle("rate_max_deg_per_s").between(0.1, 1e4);
    let motor = table.choice("motor", motors.iter().copied());
    if let Some(motor) = motor {
        // Without load the back-EMF takes all of the voltage.
        let no_load = motor.voltage_max / (motor.torque_constant * motor.gear_ratio);
        if rate_max > no_load {
            let must = format!("must be at most {:.1}, the motor's speed without load", no_load.to_degrees());
            table.refuse("rate_max_deg_per_s", &must);
        }
    }
    (Some(JointLimits { angle_min, angle_max, rate_max }), motor)
}

/// The robot stands with its right ankle above O: the unpowered joints at O, the ankle at the sole's height.
fn check_stance(tables: &PerJoint<Table>, mechanism: &Mechanism) {
    for joint in [Joint::FootRoll, Joint::FootPitch] {
        if mechanism.links[joint].origin.norm() > 0.0 {
            tables[joint].refuse("origin_m", "must be [0, 0, 0]: the foot tips about O, under the ankle");
        }
    }
    let height = mechanism.sole.ankle_height;
    if (mechanism.links[Joint::RightAnkleRoll].origin - Vector3::new(0.0, 0.0, height)).norm() > 1e-9 {
        let must = format!("must be [0, 0, {height}]: sole.ankle_height_m above the sole");
        tables[Joint::RightAnkleRoll].refuse("origin_m", &must);
    }
}
