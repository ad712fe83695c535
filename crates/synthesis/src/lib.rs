//! Offline: the semi-inverse nominal half-step (DESIGN §3).
//!
//! Vukobratović's semi-inverse method: the legs are prescribed, the trunk is found such that the ground reaction stays in
//! O. A [`LegPattern`] says how pelvis and swing foot move, inverse kinematics turns that into leg angles, and the two
//! trunk joints follow from Mx = My = 0 about O at every instant, with an end that mirrors the start.
//!
//! Every number is the same on every machine: no function of the system's mathematical library reaches the table.

mod arms;
mod error;
mod fourier;
mod jet;
mod leg_motion;
mod leg_path;
mod limbs;
mod parameters;
mod pendulum_path;
mod recorded_path;
mod recording;
mod semi_inverse;
mod spline;
mod stick_figure;
mod synthesize;

pub use error::SynthesisError;
pub use leg_path::LegPattern;
pub use parameters::Parameters;
pub use recording::{Recording, RecordingError};
pub use stick_figure::{StickArm, StickFigure, StickLeg};
pub use synthesize::{Report, Synthesis, synthesize};
