//! Offline: the semi-inverse nominal half-step (DESIGN §3).
//!
//! Vukobratović's semi-inverse method: the legs are prescribed, the trunk is found such that the ground reaction stays
//! in O. A [`LegPattern`] prescribes the motion of pelvis and swing foot, inverse kinematics yields the leg angles, and
//! the two trunk joints follow from Mx = My = 0 about O at every instant, with an end that mirrors the start. A
//! robot without a waist shifts its pelvis instead.
//!
//! Every number is the same on every machine: no function of the system's mathematical library enters the table.

mod arms;
mod error;
mod fitted;
mod fourier;
mod gait_recording;
mod gauss_newton;
mod jet;
mod leg_motion;
mod leg_path;
mod leg_pattern;
mod limbs;
mod parameters;
mod pelvis_balance;
mod pendulum_path;
mod recorded_path;
mod semi_inverse;
mod spline;
mod stick_figure;
mod synthesize;

pub use error::SynthesisError;
pub use fitted::{FittedHalfStep, fit_half_step};
pub use gait_recording::{GaitRecording, GaitRecordingError};
pub use leg_pattern::LegPattern;
pub use parameters::{Balance, SynthesisParameters};
pub use stick_figure::{StickArm, StickFigure, StickLeg};
pub use synthesize::{Synthesis, SynthesisReport, synthesize};
