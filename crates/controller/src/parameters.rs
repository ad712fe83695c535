//! What can be set about the controller; `config/controller.toml`.

use std::path::Path;

use balance::{FeedbackParameters, ZmpParameters};
use gait::{GaitParameters, Limits, RampKind};
use model::config::{self, ConfigErrors, Document, Table};

use crate::Compensation;

/// All of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// How requests bend the walk, and how far.
    pub gait: GaitParameters,
    /// How the modified half-step is kept in balance before any feedback.
    pub compensation: Compensation,
    /// ZMP estimator and ankle feedback.
    pub balance: balance::Parameters,
    /// What counts as trouble.
    pub watch: WatchParameters,
}

/// What counts as trouble.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WatchParameters {
    /// Longest time without a good measurement [s]; beyond it the robot holds still.
    pub silence_max: f64,
    /// Tilt of the trunk beyond which the robot counts as fallen [rad].
    pub tilt_max: f64,
}

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
            balance: balance::Parameters { zmp: zmp(&root.table("zmp")), feedback: feedback(&root.table("feedback")) },
            watch: watch(&root.table("watch")),
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
        lag: table.number("lag_s").positive(),
        fade: table.number("fade_s").positive(),
    }
}

fn watch(table: &Table) -> WatchParameters {
    WatchParameters {
        silence_max: table.number("silence_max_s").positive(),
        tilt_max: table.angle("tilt_max_deg").between(5.0, 90.0),
    }
}
