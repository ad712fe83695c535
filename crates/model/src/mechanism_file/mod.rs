//! Reading a mechanism from its file (`config/mechanism.toml`), strictly.
//!
//! All mistakes are reported at once, each with line, key, value and what would be right: see [`config`].

mod fingerprint;
mod symmetry;

use config::{Config, Table};
use nalgebra::{Unit, Vector3};

use crate::{Body, Joint, JointLimits, Link, Mechanism, Motor, PerJoint, Sole};

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
            behind: table.number("behind_m").positive(),
            ahead: table.number("ahead_m").positive(),
            half_width: table.number("width_m").positive() / 2.0,
            ankle_height: table.number("ankle_height_m").not_negative(),
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
        Self {
            resistance: table.number("resistance_ohm").positive(),
            torque_constant: table.number("torque_constant_n_m_per_a").positive(),
            gear_ratio: table.number("gear_ratio").positive(),
            rotor_inertia: table.number("rotor_inertia_kg_m2").positive(),
            voltage_max: table.number("voltage_max_v").positive(),
        }
    }
}

fn link(joint: Joint, table: &Table, motors: &[(&str, Motor)]) -> Link {
    let number = f64::from(joint.number());
    table.number("number").that(|value| value == number, &format!("must be {number}, the number of {}", joint.name()));
    let parent = parent(joint, table);
    let is_unit = |axis: &[f64; 3]| (Vector3::from(*axis).norm() - 1.0).abs() <= 1e-9;
    let axis = Vector3::from(table.numbers("axis").that(is_unit, "must be a unit vector such as [0, 1, 0]"));
    let origin = Vector3::from(table.numbers("origin_m").any());

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
        mass: table.number("mass_kg").positive(),
        com: table.numbers("com_m").any().into(),
        inertia: table
            .numbers("inertia_kg_m2")
            .that(
                |moments| {
                    let sum: f64 = moments.iter().sum();
                    moments.iter().all(|&moment| moment > 0.0 && moment <= sum - moment)
                },
                "must be three principal moments, each greater than 0 and at most the sum of the other two",
            )
            .into(),
    }
}

fn drive(table: &Table, motors: &[(&str, Motor)]) -> (Option<JointLimits>, Option<Motor>) {
    let [angle_min, angle_max] = table.angles("range_deg").increasing();
    let rate_max = table.angle("rate_max_deg_per_s").positive();
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
