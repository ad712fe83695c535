//! The half-steps about which statements are made.

use model::Mechanism;
use synthesis::{GaitRecording, LegPattern, Synthesis, SynthesisParameters, synthesize};

use crate::common::{config, mechanism};

/// The half-step of the default parameters.
pub(crate) fn nominal(mechanism: &Mechanism, pattern: &LegPattern) -> Synthesis {
    synthesize(mechanism, pattern, &SynthesisParameters::default(), "a test").unwrap_or_else(|error| panic!("{error}"))
}

/// Both mechanisms with both leg patterns.
pub(crate) fn all() -> Vec<(String, Mechanism, Synthesis)> {
    let recording = GaitRecording::load(&config("recorded_leg_shape.csv")).unwrap_or_else(|error| panic!("{error}"));
    let mut all = Vec::new();
    for file in ["mechanism.toml", "mechanism_other_reading.toml"] {
        for (shape, pattern) in
            [("pendulum", LegPattern::Pendulum), ("recorded", LegPattern::Recorded(recording.clone()))]
        {
            let mechanism = mechanism(file);
            let synthesis = nominal(&mechanism, &pattern);
            all.push((format!("{file}, {shape}"), mechanism, synthesis));
        }
    }
    all
}
