//! What the ground answers: ZMP estimator, margin, feedback.
//!
//! Everything here is told in support coordinates: as if the robot stood on its right foot, O under the ankle, x along the
//! foot. [`Sensed`] is a measurement brought there; [`Plan`] is what the asked motion should look like there.

mod feedback;
mod parameters;
mod plan;
mod sensed;
mod state;
mod zmp_estimator;

pub use feedback::{AnkleLean, Feedback};
pub use parameters::{FeedbackParameters, Parameters, ZmpParameters};
pub use plan::Plan;
pub use sensed::Sensed;
pub use state::CentreOfMass;
pub use zmp_estimator::{Ground, ZmpEstimator};
