//! What can be wrong in a control period.

use std::fmt;

use crate::Rejection;
use crate::code::codes;

codes! {
    /// One thing that is wrong in a control period; its number is its bit in [`Faults`].
    Fault {
        /// A measurement contains a NaN or infinite value, or its orientation is no rotation; it was not used.
        MeasurementNotFinite = 1 "a measurement contains a value that is not finite",
        /// A measurement contains a value that no working sensor of this robot produces; it was not used.
        MeasurementImplausible = 2 "a measurement contains an implausible value",
        /// No valid measurement has arrived for longer than the timeout.
        MeasurementStale = 4 "no valid measurement has arrived for too long",
        /// A measurement is older than one already used; it was not used.
        MeasurementOutOfOrder = 8 "a measurement is older than the one before",
        /// A joint angle of the setpoint was limited to its range.
        AngleLimited = 16 "a joint angle was limited to its range",
        /// A joint rate of the setpoint was limited.
        RateLimited = 32 "a joint rate was limited",
        /// The computed setpoint was not finite; the last valid one was sent.
        SetpointNotFinite = 64 "the setpoint was not finite; the last valid one was sent",
        /// The feet bear too little force for a ZMP estimate.
        InTheAir = 128 "the feet bear too little force for a zero-moment point",
        /// The trunk is tilted beyond recovery: the robot has fallen.
        Fallen = 256 "the robot has fallen",
        /// The plan needed a foot out of a leg's reach; the posture before was kept.
        OutOfReach = 1024 "the plan needed a foot out of a leg's reach",
        /// A sensor's value stays the same to the bit although the robot moves; the measurement was not used.
        MeasurementFrozen = 2048 "a sensor's value has stopped changing",
        /// A sensor says that it has no value.
        MeasurementMissing = 131072 "a sensor has no value",
        /// Sensors contradict each other; the measurement was not used.
        MeasurementInconsistent = 4096 "sensors contradict each other",
        /// A joint is not where it was commanded to be: its encoder is off, or its drive does not follow.
        JointOffSetpoint = 8192 "a joint is not where it was commanded to be",
        /// The robot is not in the posture in which the controller begins, nor in a stand; it holds its posture.
        UnexpectedPosture = 16384 "the robot is not in the posture in which the controller begins",
        /// For several half-steps the robot has moved as if the vertical were another one than the measured one.
        OrientationAskew = 65536 "the measured orientation and the forces on the feet disagree about the vertical",
        /// The run can no longer be recorded.
        NotRecorded = 32768 "the run can no longer be recorded",
        /// The control loop missed a deadline.
        DeadlineMissed = 512 "a deadline was missed",
    }
}

/// A fault that keeps the robot from walking until a reset. Its text names the fault and when it was latched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatchedFault {
    /// What is wrong.
    pub fault: Fault,
    /// When it was latched: time of the controller since its first tick (s).
    pub time: f64,
    /// Why measurements were not used then, if that is what led to it: the sensor to look at.
    pub cause: Option<Rejection>,
}

impl LatchedFault {
    /// The fault in words, with the sensor that led to it.
    pub fn text(&self) -> String {
        match self.cause {
            Some(cause) => format!("{} ({cause})", self.fault),
            None => self.fault.to_string(),
        }
    }
}

impl fmt::Display for LatchedFault {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{}, since {:.2} s", self.text(), self.time)
    }
}

/// A set of faults, one bit each. Bits unknown to this version are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults(pub u32);

impl Faults {
    /// Adds a fault.
    pub fn insert(&mut self, fault: Fault) {
        self.0 |= fault.code();
    }

    /// Whether a fault is in the set.
    pub fn contains(self, fault: Fault) -> bool {
        self.0 & fault.code() != 0
    }

    /// The faults in the set.
    pub fn iter(self) -> impl Iterator<Item = Fault> {
        Fault::ALL.iter().copied().filter(move |fault| self.contains(*fault))
    }
}

impl FromIterator<Fault> for Faults {
    fn from_iter<I: IntoIterator<Item = Fault>>(faults: I) -> Self {
        let mut set = Self::default();
        faults.into_iter().for_each(|fault| set.insert(fault));
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sensor;

    #[test]
    fn a_latched_fault_is_told_with_its_time() {
        let latched = LatchedFault { fault: Fault::Fallen, time: 3.2999, cause: None };
        assert_eq!(latched.to_string(), "the robot has fallen, since 3.30 s");
        let cause = Some(Rejection { fault: Fault::MeasurementFrozen, sensor: Sensor::Orientation });
        assert_eq!(
            LatchedFault { fault: Fault::MeasurementStale, cause, ..latched }.text(),
            "no valid measurement has arrived for too long (orientation of the trunk: a sensor's value has stopped \
             changing)"
        );
    }

    #[test]
    fn each_fault_has_a_bit_of_its_own() {
        let all: Faults = Fault::ALL.iter().copied().collect();
        assert_eq!(all.0.count_ones() as usize, Fault::ALL.len());
        assert_eq!(all.iter().collect::<Vec<_>>(), Fault::ALL);
    }
}
