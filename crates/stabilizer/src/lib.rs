//! Estimates the state of the robot from measurements, and stabilises the walk by feedback.
//!
//! The data flow in this order:
//!
//! 1. [`SupportFrameMeasurement`]: a measurement, expressed in support coordinates.
//! 2. [`ZmpEstimator`], [`estimate_com`]: zero-moment point (ZMP), contacts, and centre of mass; [`ComPrediction`]
//!    bridges missing samples.
//! 3. [`BalanceState`]: how the robot balances, as planned and as estimated.
//! 4. [`DcmFeedback`]: their difference moves the ZMP by small angles of the ankles.
//! 5. [`LandingCompliance`]: the legs yield to unexpected forces at touchdown.
//! 6. [`WalkOdometry`]: where the walk has come to.
//!
//! Everything is expressed in support coordinates: as if the robot stood on its right foot, O under the ankle, x along
//! the foot.

mod balance_state;
mod com_estimator;
mod com_prediction;
mod dcm_feedback;
mod landing_compliance;
mod odometry;
mod parameters;
mod proportions;
mod support_frame_measurement;
mod zmp_estimator;

pub use balance_state::{BalanceState, SupportFoot};
pub use com_estimator::estimate_com;
pub use com_prediction::ComPrediction;
pub use dcm_feedback::{AnkleLean, DcmFeedback, FeedbackParameters};
pub use landing_compliance::{LandingCompliance, LandingParameters};
pub use odometry::WalkOdometry;
pub use parameters::Parameters;
pub use support_frame_measurement::SupportFrameMeasurement;
pub use zmp_estimator::{ContactEstimate, ZmpEstimator, ZmpParameters};
