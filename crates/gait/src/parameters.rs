//! The parameters of the gait.

use std::time::Duration;

use crate::RampKind;

/// How the walk follows commands, and how far; tables `[gait]` and `[limits]` of `config/controller.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaitParameters {
    /// Shape of the ramps by which turn, extension, sidestep and speed reach their commanded values. Linear is the
    /// paper's, and jumps in rate.
    pub ramp: RampKind,
    /// Duration of a change of speed. A shorter one responds sooner and accelerates harder.
    pub speed_ramp: Duration,
    /// Range of the commands that are granted.
    pub limits: Limits,
}

/// Range of the commands that are granted. It must include the nominal walk: no turn, speed 1, no extension,
/// no sidestep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest turn `α` per full step, to either side (rad). More brings the heels together: at 30° the soles stay 7 cm
    /// apart.
    pub turn_max: f64,
    /// Least speed factor `c`, greater than zero (-). Far below 1 the ZMP follows the projection of the centre of mass.
    pub speed_min: f64,
    /// Greatest speed factor `c` (-). The ZMP's travel under the foot grows with `c² − 1`.
    pub speed_max: f64,
    /// Least step extension `β`, at most zero (rad): how much a step may be shortened, or reversed.
    pub extension_min: f64,
    /// Greatest step extension `β`, at least zero (rad).
    pub extension_max: f64,
    /// Largest sidestep `γ`, to either side (rad).
    pub sidestep_max: f64,
}
