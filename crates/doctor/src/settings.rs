//! The settings that a trial can be repeated with, one at a time, as they usually are.

use crate::examined_robot::RobotSetup;

/// One setting, or some that belong together.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Name of the file in the configuration folder.
    pub file: &'static str,
    /// Key with its table.
    pub key: &'static str,
    /// What is seen when it is wrong.
    pub effect: &'static str,
    /// Its value in the unit of the file, in words.
    pub text: fn(&RobotSetup) -> String,
    /// Sets it as it is in another setup.
    pub copy: fn(&mut RobotSetup, &RobotSetup),
}

/// A setting at a place of the setup; `scale` is from SI to the unit of the file.
macro_rules! setting {
    ($file:literal, $key:literal, $($place:ident).+, $scale:expr, $effect:literal) => {
        Setting {
            file: $file,
            key: $key,
            effect: $effect,
            text: |setup| number(f64::from(setup.$($place).+) * $scale),
            copy: |setup, from| setup.$($place).+ = from.$($place).+,
        }
    };
}

/// A setting of another kind than a number.
macro_rules! setting_in_words {
    ($file:literal, $key:literal, $($place:ident).+, $effect:literal) => {
        Setting {
            file: $file,
            key: $key,
            effect: $effect,
            text: |setup| format!("{:?}", setup.$($place).+),
            copy: |setup, from| setup.$($place).+.clone_from(&from.$($place).+),
        }
    };
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const CONTROLLER: &str = "controller.toml";

/// All settings that decide about the walk, those that most others depend on first.
pub const SETTINGS: &[Setting] = &[
    setting!(
        "mechanism.toml",
        "servo.legs_and_waist.stiffness_n_m_per_rad",
        mechanism.servos.legs_and_waist.stiffness,
        1.0,
        "too soft, the legs sink and the robot sways; too stiff, feet bounce"
    ),
    setting!(
        "mechanism.toml",
        "servo.legs_and_waist.damping_n_m_s_per_rad",
        mechanism.servos.legs_and_waist.damping,
        1.0,
        "too low, joints ring after each landing; too high, they come late"
    ),
    setting!(
        "mechanism.toml",
        "servo.arms.stiffness_n_m_per_rad",
        mechanism.servos.arms.stiffness,
        1.0,
        "too soft, the arms lag behind their swing"
    ),
    setting!(
        "mechanism.toml",
        "servo.arms.damping_n_m_s_per_rad",
        mechanism.servos.arms.damping,
        1.0,
        "too low, the arms ring"
    ),
    setting!(
        "plant.toml",
        "servo.stiffness_share",
        plant.servo.stiffness,
        1.0,
        "the drives are not as stiff as the controller relies on"
    ),
    setting!(
        "plant.toml",
        "servo.damping_share",
        plant.servo.damping,
        1.0,
        "the drives are not damped as the mechanism says"
    ),
    setting!(
        "plant.toml",
        "sensors.delay_periods",
        plant.sensors.delay_periods,
        1.0,
        "late sensors: balance comes late, the robot sways more with each step"
    ),
    setting!(
        "plant.toml",
        "sensors.every_periods",
        plant.sensors.every_periods,
        1.0,
        "samples come too rarely for balance"
    ),
    setting!(
        "plant.toml",
        "sensors.rate_noise_deg_per_s",
        plant.sensors.rate_noise,
        DEGREES,
        "noise of the joint rates shakes the feedback"
    ),
    setting!(
        "plant.toml",
        "sensors.orientation_noise_deg",
        plant.sensors.orientation_noise,
        DEGREES,
        "noise of the orientation shakes the feedback"
    ),
    setting!(
        "plant.toml",
        "sensors.angular_rate_noise_deg_per_s",
        plant.sensors.angular_rate_noise,
        DEGREES,
        "noise of the gyro shakes the feedback"
    ),
    setting!(
        "plant.toml",
        "sensors.force_noise_n",
        plant.sensors.force_noise,
        1.0,
        "noise of the forces moves the measured ZMP"
    ),
    setting!(
        "plant.toml",
        "sensors.moment_noise_n_m",
        plant.sensors.moment_noise,
        1.0,
        "noise of the moments moves the measured ZMP"
    ),
    setting_in_words!(
        "plant.toml",
        "sensors.imu_mounting_deg",
        plant.sensors.mounting,
        "the measured vertical is askew"
    ),
    setting_in_words!("plant.toml", "sensors.gyro_bias_deg_per_s", plant.sensors.gyro_bias, "the gyro drifts"),
    setting!(
        "controller.toml",
        "feedback.gain",
        controller.stabilizer.feedback.gain,
        1.0,
        "too low, a push or an error is not answered; too high, the ankles shake"
    ),
    setting!(
        "controller.toml",
        "feedback.edge_m",
        controller.stabilizer.feedback.edge,
        1.0,
        "too wide, there is no sole left to balance with"
    ),
    setting!(
        "controller.toml",
        "feedback.zmp_lag_s",
        controller.stabilizer.feedback.foot_damping_time_constant,
        1.0,
        "too short, a foot shakes on the ground; too long, it stands on its edge on uneven ground"
    ),
    setting!(
        "controller.toml",
        "feedback.lag_s",
        controller.stabilizer.feedback.support_ankle_time_constant,
        1.0,
        "too long, balance comes late"
    ),
    setting!(
        "controller.toml",
        "feedback.fade_s",
        controller.stabilizer.feedback.swing_ankle_time_constant,
        1.0,
        "too long, the swing sole lands tilted"
    ),
    setting!(
        "controller.toml",
        "landing.damping_n_s_per_m",
        controller.stabilizer.landing.damping,
        1.0,
        "too low, a leg gives way when it lands; too high, it lands hard"
    ),
    setting!(
        "controller.toml",
        "landing.return_time_s",
        controller.stabilizer.landing.return_time,
        1.0,
        "too long, a leg that gave way is still short in the next half-step"
    ),
    setting!(
        "controller.toml",
        "zmp.force_min_n",
        controller.stabilizer.zmp.force_min,
        1.0,
        "too high, a foot that bears is taken to be in the air"
    ),
    setting!(
        "controller.toml",
        "zmp.time_constant_s",
        controller.stabilizer.zmp.time_constant,
        1.0,
        "too long, the measured ZMP is late"
    ),
    Setting {
        file: CONTROLLER,
        key: "gait.speed_ramp_s",
        effect: "too short, the ZMP leaves the sole when the speed changes, so that little is granted",
        text: |setup| number(setup.controller.gait.speed_ramp.as_secs_f64()),
        copy: |setup, from| setup.controller.gait.speed_ramp = from.controller.gait.speed_ramp,
    },
    setting_in_words!(
        "controller.toml",
        "gait.ramp",
        controller.gait.ramp,
        "\"linear\" jumps in rate at each support change"
    ),
    setting_in_words!(
        "controller.toml",
        "gait.compensation",
        controller.compensation,
        "without it the centre of mass is not planned over the steps"
    ),
    setting!(
        "controller.toml",
        "forecast.margin_min_m",
        controller.feasibility.margin_min,
        1.0,
        "too large, nothing is granted"
    ),
    setting!(
        "controller.toml",
        "forecast.clearance_min_m",
        controller.feasibility.clearance_min,
        1.0,
        "too large, no turn is granted"
    ),
    setting!(
        "controller.toml",
        "forecast.friction",
        controller.feasibility.friction,
        1.0,
        "too low, nothing fast is granted"
    ),
    Setting {
        file: CONTROLLER,
        key: "limits",
        effect: "the permitted range decides what is granted",
        text: |setup| format!("{:?}", setup.controller.gait.limits),
        copy: |setup, from| setup.controller.gait.limits = from.controller.gait.limits,
    },
    setting!(
        "controller.toml",
        "watch.silence_max_s",
        controller.validator.timeout,
        1.0,
        "too short, a moment without a valid sample stops the robot"
    ),
    setting!(
        "controller.toml",
        "watch.tilt_max_deg",
        controller.validator.tilt_max,
        DEGREES,
        "too small, a trunk that leans counts as fallen"
    ),
    setting!(
        "controller.toml",
        "watch.orientation_error_max_rad",
        controller.validator.consistency.orientation_error_max,
        1.0,
        "too small, good orientations are rejected"
    ),
    setting!(
        "controller.toml",
        "watch.tracking_error_max_rad",
        controller.validator.consistency.tracking_error_max,
        1.0,
        "too small, joints that follow are rejected"
    ),
    setting!(
        "controller.toml",
        "watch.tracking_bias_max_rad",
        controller.validator.consistency.tracking_bias_max,
        1.0,
        "too small, joints that follow are rejected"
    ),
    setting!(
        "controller.toml",
        "watch.rate_error_max_rad",
        controller.validator.consistency.rate_error_max,
        1.0,
        "too small, good joint rates are rejected"
    ),
    setting_in_words!(
        "controller.toml",
        "watch.load_share_min",
        controller.validator.consistency.load_share,
        "too narrow, good forces are rejected"
    ),
    setting_in_words!(
        "controller.toml",
        "watch",
        controller.validator,
        "thresholds that are too strict reject good samples"
    ),
    setting!(
        "plant.toml",
        "payload.mass_kg",
        plant.payload.mass,
        1.0,
        "more load than the robot, which does not know of it, can balance"
    ),
    setting!(
        "plant.toml",
        "mass_error",
        plant.mass_error,
        1.0,
        "masses that are further off than balance makes up for"
    ),
    setting!("plant.toml", "contact.friction", plant.contact.friction, 1.0, "the soles slip"),
    setting!(
        "plant.toml",
        "contact.stiffness_n_per_m",
        plant.contact.stiffness,
        1.0,
        "on soft ground the robot tips as on a spring"
    ),
    setting!("plant.toml", "contact.damping_n_s_per_m", plant.contact.damping, 1.0, "too low, soles bounce"),
    setting!("plant.toml", "slope.ahead_deg", plant.slope.ahead, DEGREES, "a slope steeper than the robot can walk on"),
    setting!("plant.toml", "slope.left_deg", plant.slope.left, DEGREES, "a slope steeper than the robot can walk on"),
    setting_in_words!(
        "plant.toml",
        "unevenness",
        plant.unevenness,
        "tiles further out of level than the soles can bear"
    ),
    setting_in_words!("plant.toml", "floor", plant.floor, "a floor that the robot cannot walk on"),
    setting!(
        "plant.toml",
        "steps_per_period",
        plant.steps_per_period,
        1.0,
        "too few integration steps make the simulation inaccurate"
    ),
];

/// A number with four significant digits.
fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let grain = 10f64.powi(3 - value.abs().log10().floor() as i32);
    ((value * grain).round() / grain).to_string()
}

/// The settings that are not as usual.
pub fn unusual(setup: &RobotSetup, usual: &RobotSetup) -> Vec<&'static Setting> {
    SETTINGS.iter().filter(|setting| (setting.text)(setup) != (setting.text)(usual)).collect()
}
