//! What can be chosen about the gait before the walk begins.

use std::time::Duration;

use crate::RampKind;

/// How the walk answers to requests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaitParameters {
    /// How turn, extension and speed go from what they are to what is asked. Linear is the paper's, and jerks.
    pub ramp: RampKind,
    /// How long a change of speed takes. Shorter answers sooner and accelerates harder.
    pub speed_ramp: Duration,
    /// What is granted at most.
    pub limits: Limits,
}

/// The box of what is granted. It must hold the nominal walk: no turn, speed 1, no extension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest turn per full step, either way [rad]. More brings the heels together: at 30° the soles stay 7 cm apart.
    pub turn_max: f64,
    /// Least speed factor `c`, above zero. Far below 1 the ZMP keeps to the projection of the centre of mass.
    pub speed_min: f64,
    /// Greatest speed factor `c`. The ZMP's travel under the foot grows with `c² − 1`.
    pub speed_max: f64,
    /// Least step extension `β` [rad], at most zero: how much a step may be shortened.
    pub extension_min: f64,
    /// Greatest step extension `β` [rad], at least zero.
    pub extension_max: f64,
}

impl Default for GaitParameters {
    /// Quintic ramps; a change of speed takes 0.6 s, one nominal half-step.
    fn default() -> Self {
        Self { ramp: RampKind::Quintic, speed_ramp: Duration::from_millis(600), limits: Limits::default() }
    }
}

impl Default for Limits {
    /// The range of the paper's figures (`c` 0.6 to 1.4), turns to 30° and extensions to 8° either way.
    fn default() -> Self {
        Self {
            turn_max: 30_f64.to_radians(),
            speed_min: 0.6,
            speed_max: 1.4,
            extension_min: -8_f64.to_radians(),
            extension_max: 8_f64.to_radians(),
        }
    }
}
