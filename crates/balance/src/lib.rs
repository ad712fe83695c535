//! What the ground answers: ZMP estimator, margin, compensation.
