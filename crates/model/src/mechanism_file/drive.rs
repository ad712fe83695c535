//! What drives a joint: `[motor.NAME]`, or the effort that a URDF tells; with range and rate.

use config::Table;

use crate::{DcMotor, Joint, JointLimits, Motor, TorqueSource};

/// Largest inertia of a rotor at its joint (kg·m²).
const REFLECTED_INERTIA_MAX: f64 = 100.0;
/// Largest torque at a joint (N·m).
const EFFORT_MAX: f64 = 1e5;

/// Whether the robot has the joint. Waist and arms may be missing: a table without any key of a drive is rigid.
pub(super) fn is_present(joint: Joint, table: &Table) -> bool {
    let keys = ["range_deg", "rate_max_deg_per_s", "motor", "effort_n_m", "armature_kg_m2"];
    joint.is_in_leg() || joint.is_powered() && keys.iter().any(|key| table.has(key))
}

/// Reads range, rate and motor of a joint.
pub(super) fn read(table: &Table, motors: &[(&str, DcMotor)]) -> (Option<JointLimits>, Option<Motor>) {
    let [angle_min, angle_max] = table.angles("range_deg").increasing_between(-720.0, 720.0);
    let rate_max = table.angle("rate_max_deg_per_s").between(0.1, 1e4);
    let limits = Some(JointLimits { angle_min, angle_max, rate_max });
    if table.has("effort_n_m") {
        let effort = table.number("effort_n_m").between(1e-3, EFFORT_MAX);
        let armature = if table.has("armature_kg_m2") {
            table.number("armature_kg_m2").between(0.0, REFLECTED_INERTIA_MAX)
        } else {
            0.0
        };
        return (limits, Some(Motor::Torque(TorqueSource { effort, armature })));
    }
    let motor = table.choice("motor", motors.iter().map(|(name, motor)| (*name, Motor::Dc(*motor))));
    if let Some(Motor::Dc(motor)) = motor {
        let no_load = motor.no_load_speed();
        if rate_max > no_load {
            let must = format!("must be at most {:.1}, the motor's speed without load", no_load.to_degrees());
            table.refuse("rate_max_deg_per_s", &must);
        }
    }
    (limits, motor)
}

impl DcMotor {
    /// Reads all tables `[motor.NAME]` of a file, noting what is wrong: name and motor of each. Joints of one type
    /// share a motor.
    pub fn read_all<'d>(root: &Table<'d>) -> Vec<(&'d str, Self)> {
        if !root.has("motor") {
            return Vec::new();
        }
        root.named_tables("motor").iter().map(|(name, table)| (*name, Self::read(table))).collect()
    }

    /// Keys and values of the motor's table.
    pub fn keys(&self) -> [(&'static str, f64); 5] {
        [
            ("resistance_ohm", self.resistance),
            ("torque_constant_n_m_per_a", self.torque_constant),
            ("rotor_inertia_kg_m2", self.rotor_inertia),
            ("gear_ratio", self.gear_ratio),
            ("voltage_max_v", self.voltage_max),
        ]
    }

    fn read(table: &Table) -> Self {
        let motor = Self {
            resistance: table.number("resistance_ohm").between(1e-3, 1e4),
            torque_constant: table.number("torque_constant_n_m_per_a").between(1e-5, 100.0),
            gear_ratio: table.number("gear_ratio").between(0.01, 1e4),
            rotor_inertia: table.number("rotor_inertia_kg_m2").between(1e-12, 1.0),
            voltage_max: table.number("voltage_max_v").between(0.1, 1000.0),
        };
        let reflected = Motor::Dc(motor).reflected_inertia();
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
