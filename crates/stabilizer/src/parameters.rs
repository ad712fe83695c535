//! The configured parameters of the stabilizer.

use crate::dcm_feedback::FeedbackParameters;
use crate::landing_compliance::LandingParameters;
use crate::zmp_estimator::ZmpParameters;

/// All parameters of the stabilizer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Parameters of the ZMP estimator.
    pub zmp: ZmpParameters,
    /// Parameters of the ankle feedback.
    pub feedback: FeedbackParameters,
    /// Parameters of the legs at touchdown.
    pub landing: LandingParameters,
}
