//! What is expected of a measurement.

use interface::Setpoint;
use model::{JointVector, Side};

/// What is commanded, and so expected of a measurement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expectation<'a> {
    /// The last setpoint.
    pub setpoint: &'a Setpoint,
    /// The part of its angles by which feedback leans on the ground (rad): the drives yield by up to that.
    pub yielding: &'a JointVector,
    /// By how much its drives yield to forces of the ground that are not planned (rad).
    pub deflection: &'a JointVector,
    /// What carries the robot; `None` where anything may, as in a stand.
    pub support: Option<ExpectedSupport>,
}

/// What carries a robot that walks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExpectedSupport {
    /// Either foot, or both: a support change.
    AnyFoot,
    /// This foot alone.
    OneFoot(Side),
}
