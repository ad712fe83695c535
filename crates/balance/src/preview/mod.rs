//! Preview: the centre of mass is planned over the feet of the coming half-steps (DESIGN §5.3).
//!
//! Vocabulary:
//! * **walk frame**: the floor, origin and heading where the walk began.
//! * **knot**: an instant at which the plan is computed, every [`KNOT`] seconds; between knots joints are interpolated.
//! * **lead**: the plan is computed a little ahead of the motion, so that there are knots on both sides of now.

mod biped;
mod cart_table;
mod course;
mod draft;
mod floor;
mod footprint;
mod footwork;
mod forecast;
mod foresight;
mod gate;
mod height;
mod hip_height;
mod landing_shift;
mod nominal_sway;
mod outlook;
mod pace;
mod planner;
mod playback;
mod swing_path;
mod whole_body;

pub use biped::Biped;
pub use cart_table::{CartState, CartTable};
pub use course::{Course, Event, Feet};
pub use draft::{Change, Draft};
pub use floor::Floor;
pub use footprint::{Footprint, SolePose};
pub use footwork::Footwork;
pub use forecast::{Forecast, ForecastParameters, Forecaster, Limit, Strain};
pub use foresight::Foresight;
pub use gate::{Gate, Goal, Stance};
pub use height::Height;
pub use hip_height::HipHeight;
pub use landing_shift::LandingShift;
pub use nominal_sway::NominalSway;
pub use outlook::Outlook;
pub use pace::Pace;
pub use planner::{KNOT, Preview};
pub use playback::{Knot, Playback};
pub use swing_path::{SwingPath, smooth_step};
pub use whole_body::{Wanted, WholeBody};
