//! The parameters of the controller; `config/controller.toml`.

use ::pattern::FeasibilityParameters;
use config::{Config, Table};
use gait::{GaitParameters, Limits, RampKind};
use interface::{COMMAND_TIMEOUT_MAX as TIMEOUT_MAX, COMMAND_TIMEOUT_MIN as TIMEOUT_MIN, Source};
use stabilizer::{FeedbackParameters, LandingParameters, ZmpParameters};

use crate::command_arbiter::ArbiterParameters;
use crate::pattern::Compensation;
use crate::sensor_consistency::ConsistencyParameters;
use crate::validator_parameters::ValidatorParameters;

/// Coefficient of friction that is relied on unless the file says otherwise: rubber on a dry floor has 0.7 and more.
const FRICTION: f64 = 0.7;

/// The parameters of the controller, read by its [`Config`] implementation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Ramps and permitted range of the gait parameters.
    pub gait: GaitParameters,
    /// How the modified half-step is kept in balance before any feedback.
    pub compensation: Compensation,
    /// ZMP estimator, feedback and landing compliance.
    pub stabilizer: stabilizer::Parameters,
    /// Limits that the half-steps of a granted request must keep.
    pub feasibility: FeasibilityParameters,
    /// What counts as a valid measurement and as a fall.
    pub validator: ValidatorParameters,
    /// Command timeout and priorities of the sources.
    pub arbiter: ArbiterParameters,
}

impl Parameters {
    /// The same where simulated time passes faster than that of operators: the commands of a stream do not expire.
    /// Operators live by wall-clock time, and half a second of lockstep passes in a few milliseconds.
    #[must_use]
    pub fn for_lockstep(mut self) -> Self {
        self.arbiter.timeout = None;
        self
    }
}

impl Config for Parameters {
    fn read(root: &Table) -> Self {
        Self {
            gait: gait(&root.table("gait"), &root.table("limits")),
            compensation: root
                .table("gait")
                .choice("compensation", [("none", Compensation::None), ("preview", Compensation::Preview)])
                .unwrap_or(Compensation::None),
            stabilizer: stabilizer::Parameters {
                zmp: zmp(&root.table("zmp")),
                feedback: feedback(&root.table("feedback")),
                landing: landing(&root.table("landing")),
            },
            feasibility: feasibility(&root.table("forecast")),
            validator: validator(&root.table("watch")),
            arbiter: arbiter(&root.table("sources")),
        }
    }
}

fn gait(gait: &Table, limits: &Table) -> GaitParameters {
    let ramps = [("linear", RampKind::Linear), ("quintic", RampKind::Quintic)];
    GaitParameters {
        ramp: gait.choice("ramp", ramps).unwrap_or(RampKind::Quintic),
        speed_ramp: gait.duration("speed_ramp_s", 0.01, 60.0),
        limits: Limits {
            turn_max: limits.angle("turn_max_deg").between(0.0, 60.0),
            speed_min: limits.number("speed_min").between(0.05, 1.0),
            speed_max: limits.number("speed_max").between(1.0, 3.0),
            extension_min: limits.angle("extension_min_deg").between(-80.0, 0.0),
            extension_max: limits.angle("extension_max_deg").between(0.0, 45.0),
            // Who wrote the file before there were sidesteps wants none.
            sidestep_max: if limits.has("sidestep_max_deg") {
                limits.angle("sidestep_max_deg").between(0.0, 45.0)
            } else {
                0.0
            },
        },
    }
}

fn zmp(table: &Table) -> ZmpParameters {
    ZmpParameters {
        force_min: table.number("force_min_n").between(0.01, 2000.0),
        time_constant: table.number("time_constant_s").between(0.0, 1.0),
    }
}

fn feedback(table: &Table) -> FeedbackParameters {
    let must = "must be removed: it is stiffness_n_m_per_rad of [servo.legs_and_waist] in the robot's mechanism.toml";
    table.refuse_former("ankle_stiffness_n_m_per_rad", must);
    FeedbackParameters {
        gain: table.number("gain").between(0.0, 20.0),
        edge: table.number("edge_m").between(0.0, 0.1),
        foot_damping_time_constant: table.number("zmp_lag_s").between(1e-4, 10.0),
        support_ankle_time_constant: table.number("lag_s").between(1e-4, 10.0),
        swing_ankle_time_constant: table.number("fade_s").between(1e-4, 10.0),
    }
}

fn landing(table: &Table) -> LandingParameters {
    LandingParameters {
        damping: table.number("damping_n_s_per_m").between(0.1, 1e6),
        return_time: table.number("return_time_s").between(1e-3, 10.0),
    }
}

fn feasibility(table: &Table) -> FeasibilityParameters {
    FeasibilityParameters {
        margin_min: table.number("margin_min_m").between(-0.1, 0.1),
        clearance_min: table.number("clearance_min_m").between(0.0, 0.1),
        friction: if table.has("friction") { table.number("friction").between(0.05, 2.0) } else { FRICTION },
    }
}

/// The thresholds besides timeout and tilt may be left out.
fn validator(table: &Table) -> ValidatorParameters {
    let timeout = table.number("silence_max_s").between(0.005, 1.0);
    let tilt_max = table.angle("tilt_max_deg").between(5.0, 90.0);
    let default = ValidatorParameters::with_default_thresholds(timeout, tilt_max);
    let optional = |key, [min, max]: [f64; 2], default| {
        if table.has(key) { table.number(key).between(min, max) } else { default }
    };
    let consistency = default.consistency;
    ValidatorParameters {
        timeout,
        tilt_max,
        fall_confirmation: optional("fall_confirmation_s", [1e-3, 1.0], default.fall_confirmation),
        angle_tolerance: optional("angle_tolerance_rad", [1e-3, 3.2], default.angle_tolerance),
        rate_factor_max: optional("rate_factor_max", [1.0, 100.0], default.rate_factor_max),
        trunk_rate_max: optional("trunk_rate_max_rad_per_s", [0.1, 1000.0], default.trunk_rate_max),
        load_factor_max: optional("load_factor_max", [1.0, 1000.0], default.load_factor_max),
        orientation_jump_max: optional("orientation_jump_max_rad", [1e-3, 3.2], default.orientation_jump_max),
        trunk_rate_jump_max: optional("trunk_rate_jump_max_rad_per_s", [0.01, 1000.0], default.trunk_rate_jump_max),
        gyro_horizon: optional("gyro_horizon_s", [1e-3, 10.0], default.gyro_horizon),
        consistency: ConsistencyParameters {
            orientation_error_max: optional(
                "orientation_error_max_rad",
                [1e-4, 3.2],
                consistency.orientation_error_max,
            ),
            tracking_error_max: optional("tracking_error_max_rad", [1e-3, 3.2], consistency.tracking_error_max),
            tracking_bias_max: optional("tracking_bias_max_rad", [1e-3, 3.2], consistency.tracking_bias_max),
            rate_error_max: optional("rate_error_max_rad", [1e-3, 3.2], consistency.rate_error_max),
            load_share: [
                optional("load_share_min", [0.0, 1.0], consistency.load_share[0]),
                optional("load_share_max", [1.0, 100.0], consistency.load_share[1]),
            ],
        },
    }
}

fn arbiter(table: &Table) -> ArbiterParameters {
    let names = [
        ("teleop", Source::Teleop),
        ("console", Source::Console),
        ("program", Source::Program),
        ("script", Source::Script),
    ];
    let is_timeout = |timeout| timeout == 0.0 || (TIMEOUT_MIN..=TIMEOUT_MAX).contains(&timeout);
    let must = format!("must lie between {TIMEOUT_MIN} and {TIMEOUT_MAX}, or be 0 for none");
    let timeout = table.number("age_limit_s").that(is_timeout, &must);
    ArbiterParameters {
        timeout: Some(timeout).filter(|&timeout| timeout > 0.0),
        priority: table.order("priority", names).unwrap_or(names.map(|(_, source)| source)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMMITTED: &str = include_str!("../../../config/controller.toml");

    fn with(from: &str, to: &str) -> Result<Parameters, String> {
        assert!(COMMITTED.contains(from), "{from}");
        Parameters::from_toml(&COMMITTED.replace(from, to), "f").map_err(|errors| errors.to_string())
    }

    #[test]
    fn the_command_timeout_may_be_switched_off_but_not_be_absurd() {
        let timeout = |to: &str| with("age_limit_s = 0.5", to).map(|parameters| parameters.arbiter.timeout);
        assert_eq!(timeout("age_limit_s = 0.5"), Ok(Some(0.5)));
        assert_eq!(timeout("age_limit_s = 0"), Ok(None));
        for wrong in ["-1", "0.01", "1000", "nan"] {
            assert!(timeout(&format!("age_limit_s = {wrong}")).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_stiffness_of_the_ankle_is_the_mechanisms() {
        let errors = with("gain = 3", "gain = 3\nankle_stiffness_n_m_per_rad = 5000").unwrap_err();
        assert_eq!(
            errors,
            "f:43:31: feedback.ankle_stiffness_n_m_per_rad = 5000: must be removed: it is stiffness_n_m_per_rad of \
             [servo.legs_and_waist] in the robot's mechanism.toml"
        );
    }

    #[test]
    fn the_order_of_priority_names_each_source_once() {
        let order = r#"["teleop", "console", "program", "script"]"#;
        let priority = |to: &str| with(order, to).map(|parameters| parameters.arbiter.priority);
        assert_eq!(priority(order).unwrap()[0], Source::Teleop);
        let reversed = [Source::Script, Source::Program, Source::Console, Source::Teleop];
        assert_eq!(priority(r#"["script", "program", "console", "teleop"]"#), Ok(reversed));
        for wrong in ["[]", "3", r#"["teleop", "console", "program"]"#, r#"["teleop", "teleop", "program", "script"]"#]
        {
            let errors = priority(wrong).unwrap_err();
            assert!(errors.contains("must be an array that names each of \"teleop\", \"console\""), "{errors}");
        }
    }

    #[test]
    fn thresholds_that_are_left_out_are_those_of_the_committed_file() {
        let committed = with("", "").unwrap().validator;
        let default = ValidatorParameters::with_default_thresholds(committed.timeout, committed.tilt_max);
        assert_eq!(committed, default, "the file states the defaults");
        assert_eq!(with("\nfriction = 0.7", ""), with("", ""), "and that of friction");
        let other = with("fall_confirmation_s = 0.05", "fall_confirmation_s = 0.1").unwrap().validator;
        assert_eq!(other, ValidatorParameters { fall_confirmation: 0.1, ..default });
        assert!(with("fall_confirmation_s = 0.05", "fall_confirmation_s = -0.1").is_err());
    }
}
