//! What can be wrong, as values.

/// One thing that is wrong in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Fault {
    /// No measurement came for longer than allowed.
    MeasurementStale = 1,
    /// A measurement had a NaN or infinite value, or no orientation; it was not used.
    MeasurementNotFinite = 2,
    /// A measurement was older than one already used; it was not used.
    MeasurementOutOfOrder = 4,
    /// An angle was held at the end of its range.
    AngleLimited = 8,
    /// A rate was held at its limit.
    RateLimited = 16,
    /// The walk asked for something that is no number; the last setpoint was held.
    WalkNotFinite = 32,
    /// No foot carries the robot.
    InTheAir = 64,
    /// The trunk tilts beyond recovery.
    Fallen = 128,
    /// A measurement had a value that no working sensor of this robot gives; it was not used.
    MeasurementAbsurd = 256,
    /// The plan went where a leg cannot reach; the posture before was kept.
    OutOfReach = 512,
}

impl Fault {
    /// All faults.
    pub const ALL: [Fault; 10] = [
        Fault::MeasurementStale,
        Fault::MeasurementNotFinite,
        Fault::MeasurementOutOfOrder,
        Fault::AngleLimited,
        Fault::RateLimited,
        Fault::WalkNotFinite,
        Fault::InTheAir,
        Fault::Fallen,
        Fault::MeasurementAbsurd,
        Fault::OutOfReach,
    ];
}

/// A set of faults; one bit each on the wire.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults(pub u32);

impl Faults {
    /// Adds a fault.
    pub fn insert(&mut self, fault: Fault) {
        self.0 |= fault as u32;
    }

    /// Whether a fault is in the set.
    pub fn contains(self, fault: Fault) -> bool {
        self.0 & fault as u32 != 0
    }

    /// The faults in the set.
    pub fn iter(self) -> impl Iterator<Item = Fault> {
        Fault::ALL.into_iter().filter(move |fault| self.contains(*fault))
    }
}
