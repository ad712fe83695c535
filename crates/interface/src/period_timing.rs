//! How a control loop kept its time in a period.

/// How the control loop kept its time in a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PeriodTiming {
    /// Control periods since the controller started.
    pub tick: u64,
    /// When the period began, by `CLOCK_MONOTONIC` (ns).
    pub time_ns: u64,
    /// Deadlines missed since the start.
    pub missed: u64,
    /// Time from the arrival of the measurement to the departure of the setpoint (ns).
    pub compute_ns: u64,
}
