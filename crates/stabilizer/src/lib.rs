//! Estimates the state of the robot from measurements, and stabilises the walk by feedback.
//!
//! The data flow in this order:
//!
//! 1. [`AttitudeEstimator`]: the attitude of the trunk and the bias of its gyro.
//! 2. [`SupportFrameMeasurement`]: a measurement, expressed in support coordinates.
//! 3. [`ZmpEstimator`], [`estimate_com`]: zero-moment point (ZMP), contacts, and centre of mass as measured.
//! 4. [`ComFilter`]: the centre of mass without the offset of its measurement, also between samples; external forces.
//! 5. [`BalanceState`]: how the robot balances, as planned and as estimated.
//! 6. [`DcmFeedback`]: their difference moves the ZMP by small angles of the ankles.
//! 7. [`LandingCompliance`]: the legs yield to unexpected forces at touchdown.
//! 8. [`CapturabilityEstimator`]: whether the robot can still be kept from falling.
//! 9. [`WalkOdometry`]: where the walk has come to.
//!
//! Everything is expressed in support coordinates: as if the robot stood on its right foot, O under the ankle, x along
//! the foot.

mod acceleration_evidence;
mod attitude_estimator;
mod balance_state;
mod capturability_estimator;
mod com_estimator;
mod com_filter;
mod dcm_feedback;
mod ground_slope_filter;
mod landing_compliance;
mod odometry;
mod parameters;
mod proportions;
mod support_frame_measurement;
mod zmp_estimator;

pub use acceleration_evidence::AccelerationEvidence;
pub use attitude_estimator::AttitudeEstimator;
pub use balance_state::{BalanceState, SupportFoot};
pub use capturability_estimator::{CapturabilityEstimator, CaptureEvidence};
pub use com_estimator::{estimate_com, level_specific_force};
pub use com_filter::ComFilter;
pub use dcm_feedback::{AnkleLean, DcmFeedback, FeedbackParameters};
pub use ground_slope_filter::GroundSlopeFilter;
pub use landing_compliance::{LandingCompliance, LandingParameters};
pub use odometry::WalkOdometry;
pub use parameters::Parameters;
pub use support_frame_measurement::SupportFrameMeasurement;
pub use zmp_estimator::{ContactEstimate, ZmpEstimator, ZmpParameters};
