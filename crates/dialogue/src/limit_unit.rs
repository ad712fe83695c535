//! The units in which users read limits.

use interface::Reason;

/// The unit in which users read the limit of a reason.
pub(crate) struct LimitUnit {
    /// How many of this unit one SI unit is.
    pub per_si: f64,
    /// The unit's name as it follows a number.
    pub name: &'static str,
}

impl LimitUnit {
    /// The unit of a reason's limit.
    pub(crate) fn of(reason: Reason) -> Self {
        const DEGREES: f64 = 180.0 / std::f64::consts::PI;
        let (per_si, name) = match reason {
            Reason::TurnLimit
            | Reason::ExtensionLimit
            | Reason::SidestepLimit
            | Reason::JointRange
            | Reason::NotInStand
            | Reason::StepTurn => (DEGREES, "°"),
            Reason::JointRate => (DEGREES, " °/s"),
            Reason::Torque | Reason::YawTorque => (1.0, " N·m"),
            Reason::Voltage => (1.0, " V"),
            Reason::Margin | Reason::SoleClearance | Reason::LegReach => (1e3, " mm"),
            Reason::StepTooFar | Reason::FeetCross | Reason::TooFar => (1.0, " m"),
            // Speed and friction are factors; the others have no limit.
            Reason::SpeedLimit
            | Reason::Friction
            | Reason::None
            | Reason::NotFinite
            | Reason::CannotRestart
            | Reason::QueueFull
            | Reason::UnknownCode
            | Reason::Empty
            | Reason::ShuttingDown
            | Reason::Outranked
            | Reason::Superseded
            | Reason::Fallen
            | Reason::Faulted
            | Reason::FaultPersists
            | Reason::NothingToReset
            | Reason::InPlace
            | Reason::Contradictory
            | Reason::TooManyPlaces
            | Reason::SameFoot
            | Reason::NoDestination
            | Reason::Expired => (1.0, ""),
        };
        Self { per_si, name }
    }
}
