//! Setpoint, controller → plant: what the drives are to reach.

use iceoryx2::prelude::ZeroCopySend;
use interface::Setpoint;
use model::Joint;

use super::fault::Check;
use super::{Latest, MessageFault, NEVER_WRITTEN};

/// A [`Setpoint`] as it lies in shared memory. Joints are physical and in the paper's order: 3 to 8 are always the
/// right leg.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Setpoint.v1")]
#[repr(C)]
pub struct SetpointMessage {
    /// Tick of the measurement that it answers.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` (ns).
    pub time_ns: u64,
    /// (rad)
    pub angles: [f64; Joint::COUNT],
    /// (rad/s)
    pub rates: [f64; Joint::COUNT],
    /// Torques that the motion needs, added to what the servos find (N·m).
    pub feed_forward: [f64; Joint::COUNT],
}

impl SetpointMessage {
    /// The setpoint that answers the measurement of `tick`, sent at `time_ns` (`CLOCK_MONOTONIC`).
    pub fn new(tick: u64, time_ns: u64, setpoint: &Setpoint) -> Self {
        Self {
            tick,
            time_ns,
            angles: setpoint.angles.0,
            rates: setpoint.rates.0,
            feed_forward: setpoint.feed_forward.0,
        }
    }

    /// The setpoint, if every number in it is finite.
    pub fn checked(&self) -> Result<Setpoint, MessageFault> {
        let check = Check("setpoint");
        Ok(Setpoint {
            angles: check.joints("angle", &self.angles)?,
            rates: check.joints("rate", &self.rates)?,
            feed_forward: check.joints("feed_forward", &self.feed_forward)?,
        })
    }
}

impl Latest for SetpointMessage {
    const EMPTY: Self = Self {
        tick: NEVER_WRITTEN,
        time_ns: 0,
        angles: [0.0; Joint::COUNT],
        rates: [0.0; Joint::COUNT],
        feed_forward: [0.0; Joint::COUNT],
    };

    fn tick(&self) -> u64 {
        self.tick
    }

    fn time_ns(&self) -> u64 {
        self.time_ns
    }
}

#[cfg(test)]
mod tests {
    use model::JointVector;

    use super::*;

    #[test]
    fn a_nan_is_named_with_its_joint() {
        let mut message = SetpointMessage { tick: 3, ..SetpointMessage::EMPTY };
        assert!(message.checked().is_ok());
        message.rates[Joint::RightHipYaw.index()] = f64::NAN;
        let text = message.checked().unwrap_err().to_string();
        assert_eq!(text, "setpoint: rate of joint 7 (right_hip_yaw) is NaN; it must be finite");
    }

    #[test]
    fn it_survives_the_way_there_and_back() {
        let setpoint = Setpoint {
            angles: JointVector::from_fn(|joint| f64::from(joint.number())),
            rates: JointVector::unit(Joint::LeftKnee),
            feed_forward: JointVector::unit(Joint::RightKnee) * -3.0,
        };
        assert_eq!(SetpointMessage::new(7, 9, &setpoint).checked(), Ok(setpoint));
    }
}
