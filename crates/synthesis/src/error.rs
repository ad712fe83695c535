//! Why a nominal half-step cannot be synthesized.

use model::{Joint, Side};

/// Why a nominal half-step cannot be synthesized.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum SynthesisError {
    /// A parameter is out of the range of any walk.
    #[error("the {name} is {value}; it must lie between {min} and {max}")]
    ParameterOutOfRange { name: &'static str, value: f64, min: f64, max: f64 },
    /// The mechanism is not left–right symmetric.
    #[error(
        "mechanism `{mechanism}`: right and left are not mirror images, \
         so the end of a half-step cannot mirror its start"
    )]
    NotSymmetric { mechanism: String },
    /// The samples of the recording do not determine its shape.
    #[error("the recording's samples crowd together and leave its shape open; spread them evenly over the cycle")]
    RecordingUndetermined,
    /// The recorded hip does not advance while its leg supports the body.
    #[error(
        "the recorded hip moves {step} m forward while its leg supports the body (0 to 50 %); \
         it must move forward: is flexion positive?"
    )]
    RecordingGoesBackwards { step: f64 },
    /// The recorded swing foot is below the ground.
    #[error("the recorded swing foot is below the line from lift-off to touch-down at {percent} % of the cycle")]
    RecordedFootBelowGround { percent: f64 },
    /// A leg is too short for the prescribed motion.
    #[error(
        "row {row} of {last}: the {leg} leg cannot reach: hip {distance:.4} m from the ankle, \
         stretched leg {length:.4} m; shorten the step or lower the hips",
        leg = match side { Side::Right => "right", Side::Left => "left" }
    )]
    LegTooShort { row: usize, last: usize, side: Side, distance: f64, length: f64 },
    /// Inverse kinematics finds no angles, though the leg is long enough.
    #[error(
        "row {row} of {last}: no angles found for the {leg} leg; {residual:.1e} m or rad are missing. \
         Is its hip far to one side?",
        leg = match side { Side::Right => "right", Side::Left => "left" }
    )]
    LegUnreachable { row: usize, last: usize, side: Side, residual: f64 },
    /// The trunk is to balance a robot that has no waist.
    #[error("the robot has no waist that pitches and rolls: balance it by its pelvis")]
    NoWaist,
    /// A joint would leave its range.
    #[error(
        "row {row} of {last}: joint {number} ({name}) would be at {value:.2}°; its range is {min:.2}° to {max:.2}°",
        number = joint.number(), name = joint.name(), value = value.to_degrees(), min = min.to_degrees(),
        max = max.to_degrees()
    )]
    AngleOutOfRange { row: usize, last: usize, joint: Joint, value: f64, min: f64, max: f64 },
    /// A joint would move too fast.
    #[error(
        "row {row} of {last}: joint {number} ({name}) would move at {value:.1} °/s; its limit is {limit:.1} °/s; \
         take more time",
        number = joint.number(), name = joint.name(), value = value.to_degrees(), limit = limit.to_degrees()
    )]
    RateTooHigh { row: usize, last: usize, joint: Joint, value: f64, limit: f64 },
    /// The iteration for the trunk motion does not converge.
    #[error(
        "no motion of trunk or pelvis found that balances these legs: \
         after {iterations} iterations it still changes by {change:.1e} rad or m"
    )]
    NotConverged { iterations: usize, change: f64 },
    /// The trunk motion leaves the ZMP too far from O.
    #[error(
        "row {row} of {last}: the ZMP is {value:.2} mm from O; the limit is {limit:.2} mm",
        value = value * 1e3, limit = limit * 1e3
    )]
    NotBalanced { row: usize, last: usize, value: f64, limit: f64 },
}
