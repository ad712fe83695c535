//! Goal: a half-step that cannot be walked is refused with the reason, the place and the numbers.
//! Method: one impossible wish at a time, and the message that it gets.

mod common;

use std::path::Path;

use common::{config, mechanism};
use synthesis::{GaitRecording, LegPattern, SynthesisError, SynthesisParameters, synthesize};

fn refusal(parameters: SynthesisParameters) -> SynthesisError {
    let mechanism = mechanism("mechanism.toml");
    synthesize(&mechanism, &LegPattern::Pendulum, &parameters, "a test").expect_err("must be refused")
}

#[test]
fn a_step_that_is_too_long_is_refused_with_row_leg_and_lengths() {
    let error = refusal(SynthesisParameters { step_length: 0.8, ..SynthesisParameters::default() });
    assert!(matches!(error, SynthesisError::LegTooShort { row: 0, last: 60, .. }), "{error}");
    let message = error.to_string();
    assert!(message.contains("row 0 of 60") && message.contains("stretched leg 0.8560 m"), "{message}");
    assert!(message.contains("shorten the step or lower the hips"), "{message}");
}

#[test]
fn a_joint_out_of_range_is_refused_with_value_and_range() {
    let error = refusal(SynthesisParameters {
        elbow_flexion: 115_f64.to_radians(),
        hip_height: 0.6,
        ..SynthesisParameters::default()
    });
    assert!(matches!(error, SynthesisError::AngleOutOfRange { .. }), "{error}");
    assert!(error.to_string().contains("its range is"), "{error}");
}

#[test]
fn a_step_that_is_too_quick_is_refused() {
    let error = refusal(SynthesisParameters { duration: 0.15, ..SynthesisParameters::default() });
    assert!(matches!(error, SynthesisError::RateTooHigh { .. } | SynthesisError::AngleOutOfRange { .. }), "{error}");
}

#[test]
fn synthesis_parameters_out_of_range_are_refused_by_name() {
    for (parameters, name) in [
        (SynthesisParameters { duration: f64::NAN, ..SynthesisParameters::default() }, "duration"),
        (SynthesisParameters { clearance: -0.05, ..SynthesisParameters::default() }, "clearance"),
        (SynthesisParameters { intervals: 0, ..SynthesisParameters::default() }, "intervals"),
    ] {
        let message = refusal(parameters).to_string();
        assert!(message.contains(name) && message.contains("must lie between"), "{message}");
    }
}

#[test]
fn a_mistake_in_a_gait_recording_is_reported_with_file_line_column_and_value() {
    let file = config("recorded_leg_shape.csv");
    let text = std::fs::read_to_string(&file).expect("the committed recording");
    for (right, wrong, expected) in [
        ("12,17.6,19.7", "12,17.6,x", "leg.csv:9: knee_flexion_deg is `x`; it must be a number from -15 to 150"),
        ("12,17.6,19.7", "12,NaN,19.7", "leg.csv:9: hip_flexion_deg is `NaN`"),
        (
            "12,17.6,19.7",
            "8,17.6,19.7",
            "leg.csv:9: gait_cycle_percent is `8`; it must be more than the line before, 8",
        ),
        ("12,17.6,19.7", "12,17.6", "leg.csv:9: 2 fields; there must be 3"),
        ("hip_flexion_deg", "hip_flexion_rad", "leg.csv:5: the header is"),
        ("\n100,", "\n99,", "the cycle ends at 99 %; it must end at 100 %"),
        ("\n0,21.6,5.2", "", "leg.csv:6: the cycle begins at 4 %; it must begin at 0 %"),
    ] {
        let broken = text.replace(right, wrong);
        assert_ne!(broken, text, "nothing to break: {right}");
        let message = GaitRecording::parse(&broken, Path::new("leg.csv")).expect_err("must be refused").to_string();
        assert!(message.contains(expected), "{message}\ndoes not say: {expected}");
    }
    let few: String = text.lines().take(10).map(|line| format!("{line}\n")).collect::<String>() + "100,20.4,4.3\n";
    let message = GaitRecording::parse(&few, Path::new("leg.csv")).expect_err("must be refused").to_string();
    assert!(message.contains("there must be at least 16"), "{message}");
}

#[test]
fn a_gait_recording_with_the_wrong_sign_is_refused() {
    let text = std::fs::read_to_string(config("recorded_leg_shape.csv")).expect("the committed recording");
    let backwards: String = text
        .lines()
        .map(|line| match line.split(',').collect::<Vec<_>>()[..] {
            [percent, hip, knee] if hip.parse::<f64>().is_ok() => {
                format!("{percent},{},{knee}\n", -hip.parse::<f64>().unwrap_or_default())
            }
            _ => format!("{line}\n"),
        })
        .collect();
    let recording = GaitRecording::parse(&backwards, Path::new("leg.csv")).expect("strictly speaking a recording");
    let pattern = LegPattern::Recorded(recording);
    let error = synthesize(&mechanism("mechanism.toml"), &pattern, &SynthesisParameters::default(), "a test")
        .expect_err("refused");
    assert!(matches!(error, SynthesisError::RecordingGoesBackwards { .. }), "{error}");
}
