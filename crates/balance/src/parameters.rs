//! What can be set about balance.

/// All of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// The ZMP estimator's.
    pub zmp: ZmpParameters,
    /// The ankle feedback's.
    pub feedback: FeedbackParameters,
    /// The legs' at touchdown.
    pub landing: LandingParameters,
}

/// See [`crate::ZmpEstimator`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZmpParameters {
    /// Vertical force from which a foot counts as bearing [N]. Less says nothing of where it pushes.
    pub force_min: f64,
    /// Of the low-pass filter [s]. Longer is smoother and later.
    pub time_constant: f64,
}

/// See [`crate::Landing`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LandingParameters {
    /// Unexpected force over the speed with which the leg yields to it [N·s/m].
    pub damping: f64,
    /// Time constant with which the foot comes back to its planned height [s].
    pub return_time: f64,
}

/// See [`crate::Feedback`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedbackParameters {
    /// ZMP shift per error of the divergent component; above 1 the error shrinks. 0 switches feedback off.
    pub gain: f64,
    /// Stiffness of an ankle's drive [N·m/rad]: what an angle does to the ground.
    pub ankle_stiffness: f64,
    /// The wanted ZMP keeps this far off the sole's edge [m].
    pub edge: f64,
    /// Time constant with which the ankle takes out what the measured ZMP misses [s].
    pub zmp_lag: f64,
    /// Time constant with which the bearing ankle follows [s].
    pub lag: f64,
    /// Time constant with which the swinging ankle comes back level [s].
    pub fade: f64,
}
