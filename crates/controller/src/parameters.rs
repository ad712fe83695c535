//! What can be set about the controller; `config/controller.toml`.

use std::path::Path;

use balance::preview::ForecastParameters;
use balance::{FeedbackParameters, LandingParameters, ZmpParameters};
use gait::{GaitParameters, Limits, RampKind};
use model::config::{self, ConfigErrors, Document, Table};

use crate::{AGE_LIMIT_MIN, Compensation, Source, SourcesParameters};

/// All of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// How requests bend the walk, and how far.
    pub gait: GaitParameters,
    /// How the modified half-step is kept in balance before any feedback.
    pub compensation: Compensation,
    /// ZMP estimator and ankle feedback.
    pub balance: balance::Parameters,
    /// What is demanded of the half-steps that a request leads to.
    pub forecast: ForecastParameters,
    /// What counts as trouble.
    pub watch: WatchParameters,
    /// How long sources of requests are believed, and who goes before whom.
    pub sources: SourcesParameters,
}

/// What counts as trouble.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WatchParameters {
    /// Longest time without a good measurement [s]; beyond it the robot holds still.
    pub silence_max: f64,
    /// Tilt of the trunk beyond which the robot counts as fallen [rad].
    pub tilt_max: f64,
}

/// Longest age limit that makes sense: a walk that goes on for longer with nobody there is unattended [s].
const AGE_LIMIT_MAX: f64 = 60.0;

impl Parameters {
    /// Reads a controller file.
    ///
    /// # Errors
    /// When the file cannot be read, and every key that is unknown, missing or out of range.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ConfigErrors> {
        let path = path.as_ref();
        Self::from_toml(&config::read(path)?, &path.display().to_string())
    }

    /// Reads the text of a controller file; `file` is its name for messages.
    ///
    /// # Errors
    /// Every key that is unknown, missing or out of range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let root = document.root();
        let parameters = Self {
            gait: gait(&root.table("gait"), &root.table("limits")),
            compensation: root
                .table("gait")
                .choice("compensation", [("none", Compensation::None), ("preview", Compensation::Preview)])
                .unwrap_or(Compensation::None),
            balance: balance::Parameters {
                zmp: zmp(&root.table("zmp")),
                feedback: feedback(&root.table("feedback")),
                landing: landing(&root.table("landing")),
            },
            forecast: forecast(&root.table("forecast")),
            watch: watch(&root.table("watch")),
            sources: sources(&root.table("sources")),
        };
        document.finish(parameters)
    }
}

fn gait(gait: &Table, limits: &Table) -> GaitParameters {
    let ramps = [("linear", RampKind::Linear), ("quintic", RampKind::Quintic)];
    GaitParameters {
        ramp: gait.choice("ramp", ramps).unwrap_or(RampKind::Quintic),
        speed_ramp: gait.duration("speed_ramp_s"),
        limits: Limits {
            turn_max: limits.angle("turn_max_deg").between(0.0, 45.0),
            speed_min: limits.number("speed_min").between(0.05, 1.0),
            speed_max: limits.number("speed_max").between(1.0, 3.0),
            extension_min: limits.angle("extension_min_deg").between(-45.0, 0.0),
            extension_max: limits.angle("extension_max_deg").between(0.0, 45.0),
        },
    }
}

fn zmp(table: &Table) -> ZmpParameters {
    ZmpParameters {
        force_min: table.number("force_min_n").positive(),
        time_constant: table.number("time_constant_s").not_negative(),
    }
}

fn feedback(table: &Table) -> FeedbackParameters {
    FeedbackParameters {
        gain: table.number("gain").between(0.0, 20.0),
        ankle_stiffness: table.number("ankle_stiffness_n_m_per_rad").positive(),
        edge: table.number("edge_m").not_negative(),
        zmp_lag: table.number("zmp_lag_s").positive(),
        lag: table.number("lag_s").positive(),
        fade: table.number("fade_s").positive(),
    }
}

fn landing(table: &Table) -> LandingParameters {
    LandingParameters {
        damping: table.number("damping_n_s_per_m").positive(),
        return_time: table.number("return_time_s").positive(),
    }
}

fn forecast(table: &Table) -> ForecastParameters {
    ForecastParameters {
        margin_min: table.number("margin_min_m").between(-0.1, 0.1),
        clearance_min: table.number("clearance_min_m").between(0.0, 0.1),
    }
}

fn watch(table: &Table) -> WatchParameters {
    WatchParameters {
        silence_max: table.number("silence_max_s").positive(),
        tilt_max: table.angle("tilt_max_deg").between(5.0, 90.0),
    }
}

fn sources(table: &Table) -> SourcesParameters {
    let names = [
        ("teleop", Source::Teleop),
        ("console", Source::Console),
        ("program", Source::Program),
        ("script", Source::Script),
    ];
    let is_limit = |limit| limit == 0.0 || (AGE_LIMIT_MIN..=AGE_LIMIT_MAX).contains(&limit);
    let must = format!("must lie between {AGE_LIMIT_MIN} and {AGE_LIMIT_MAX}, or be 0 for none");
    let age_limit = table.number("age_limit_s").that(is_limit, &must);
    SourcesParameters {
        age_limit: Some(age_limit).filter(|&limit| limit > 0.0),
        priority: table.order("priority", names).unwrap_or(Source::ALL),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMMITTED: &str = include_str!("../../../config/controller.toml");

    fn with(from: &str, to: &str) -> Result<SourcesParameters, String> {
        assert!(COMMITTED.contains(from), "{from}");
        let parameters = Parameters::from_toml(&COMMITTED.replace(from, to), "f");
        parameters.map(|parameters| parameters.sources).map_err(|errors| errors.to_string())
    }

    #[test]
    fn streams_are_believed_for_half_a_second_unless_that_is_switched_off() {
        assert_eq!(with("", "").unwrap().age_limit, Some(0.5));
        assert_eq!(with("age_limit_s = 0.5", "age_limit_s = 0").unwrap().age_limit, None);
        for wrong in ["-1", "0.01", "1000", "nan"] {
            assert!(with("age_limit_s = 0.5", &format!("age_limit_s = {wrong}")).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_order_of_priority_names_each_source_once() {
        let order = r#"["teleop", "console", "program", "script"]"#;
        assert_eq!(with("", "").unwrap().priority[0], Source::Teleop);
        let turned = with(order, r#"["script", "program", "console", "teleop"]"#).unwrap();
        assert_eq!(turned.priority, [Source::Script, Source::Program, Source::Console, Source::Teleop]);
        for wrong in ["[]", "3", r#"["teleop", "console", "program"]"#, r#"["teleop", "teleop", "program", "script"]"#]
        {
            let errors = with(order, wrong).unwrap_err();
            assert!(errors.contains("must be an array that names each of \"teleop\", \"console\""), "{errors}");
        }
    }
}
