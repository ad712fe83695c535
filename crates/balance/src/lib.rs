//! What the ground answers: ZMP estimator, margin, feedback, the paper's compensator.
//!
//! Everything here is told in support coordinates: as if the robot stood on its right foot, O under the ankle, x along the
//! foot. [`Sensed`] is a measurement brought there; [`Plan`] is what the asked motion should look like there.

mod feedback;
mod half_step_zmp;
mod landing;
mod lean_table;
mod paper_lean;
mod parameters;
mod plan;
pub mod preview;
mod sensed;
mod state;
mod zmp_estimator;

pub use feedback::{AnkleLean, Balance, Feedback};
pub use half_step_zmp::{GroundSplit, ZmpExtents, zmp_by_newton_euler, zmp_by_speed_law};
pub use landing::Landing;
pub use lean_table::{LeanTable, LeanTableError};
pub use paper_lean::{LeanAt, PaperLean};
pub use parameters::{FeedbackParameters, LandingParameters, Parameters, ZmpParameters};
pub use plan::Plan;
pub use preview::Preview;
pub use sensed::Sensed;
pub use state::CentreOfMass;
pub use zmp_estimator::{Ground, ZmpEstimator};
