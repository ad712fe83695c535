//! What drives joints: DC motors, and sources of torque of which only the limit is known.

/// What drives a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motor {
    /// A DC motor, whose torque is bounded by its voltage.
    Dc(DcMotor),
    /// A source of torque of which only the limit is known.
    Torque(TorqueSource),
}

/// A brushed or brushless DC motor with its gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DcMotor {
    /// Armature resistance `R` (Ω).
    pub resistance: f64,
    /// Torque constant `k_t` (N·m/A), equal to the back-EMF constant (V·s/rad).
    pub torque_constant: f64,
    /// Gear ratio: revolutions of the motor per revolution of the joint (-).
    pub gear_ratio: f64,
    /// Rotor inertia, on the motor's side of the gear (kg·m²).
    pub rotor_inertia: f64,
    /// Largest supply voltage, either way (V).
    pub voltage_max: f64,
}

/// A source of torque of which only the limit is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueSource {
    /// Largest torque at the joint, either way (N·m).
    pub effort: f64,
    /// Inertia of the rotor, seen at the joint (kg·m²).
    pub armature: f64,
}

impl Motor {
    /// Reflected rotor inertia, on the joint's side of the gear (kg·m²).
    pub fn reflected_inertia(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.rotor_inertia * motor.gear_ratio * motor.gear_ratio,
            Motor::Torque(source) => source.armature,
        }
    }

    /// Largest torque at the joint at standstill, either way (N·m).
    pub fn torque_max(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.torque_per_volt() * motor.voltage_max,
            Motor::Torque(source) => source.effort,
        }
    }

    /// Joint torque lost to back-EMF per joint rate at constant voltage (N·m·s/rad).
    pub fn back_emf_damping(&self) -> f64 {
        match self {
            Motor::Dc(motor) => motor.torque_per_volt() * motor.torque_constant * motor.gear_ratio,
            Motor::Torque(_) => 0.0,
        }
    }

    /// The DC motor, if it is one.
    pub fn dc(&self) -> Option<&DcMotor> {
        match self {
            Motor::Dc(motor) => Some(motor),
            Motor::Torque(_) => None,
        }
    }
}

impl DcMotor {
    /// Speed of the joint without load, at which the back-EMF takes all of the voltage (rad/s).
    pub fn no_load_speed(&self) -> f64 {
        self.voltage_max / (self.torque_constant * self.gear_ratio)
    }

    /// Torque at the joint for a voltage at standstill (N·m/V).
    pub fn torque_per_volt(&self) -> f64 {
        self.torque_per_ampere() / self.resistance
    }

    /// Torque at the joint for a current (N·m/A).
    pub fn torque_per_ampere(&self) -> f64 {
        self.gear_ratio * self.torque_constant
    }

    /// Voltage at the motor for a current (A) and a rate of the joint (rad/s): that of the resistance and the back-EMF
    /// (V).
    pub fn voltage(&self, current: f64, rate: f64) -> f64 {
        self.resistance * current + self.torque_per_ampere() * rate
    }
}
