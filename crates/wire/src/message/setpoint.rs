//! Setpoint, controller → plant: where the joints shall be.

use iceoryx2::prelude::ZeroCopySend;
use model::{Joint, JointVector};

use super::fault::Check;
use super::{MessageFault, NOTHING_YET, Newest};

/// A [`Setpoint`] as it lies in shared memory. Joints are physical and in the paper's order: 3 to 8 are always the
/// right leg.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Setpoint.v1")]
#[repr(C)]
pub struct SetpointMessage {
    /// The tick of the measurement that it answers.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// [rad]
    pub angles: [f64; Joint::COUNT],
    /// [rad/s]
    pub rates: [f64; Joint::COUNT],
    /// Torques that the motion needs, added to what the servos find [N·m].
    pub feed_forward: [f64; Joint::COUNT],
}

/// Where the joints shall be. Values of the unpowered joints 1 and 2 mean nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setpoint {
    /// The tick of the measurement that it answers.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// [rad]
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Torques that the motion needs, added to what the servos find [N·m].
    pub feed_forward: JointVector,
}

impl SetpointMessage {
    /// The setpoint, if every number in it is finite.
    pub fn checked(&self) -> Result<Setpoint, MessageFault> {
        let check = Check("setpoint");
        Ok(Setpoint {
            tick: self.tick,
            time_ns: self.time_ns,
            angles: check.joints("angle", &self.angles)?,
            rates: check.joints("rate", &self.rates)?,
            feed_forward: check.joints("feed_forward", &self.feed_forward)?,
        })
    }
}

impl From<&Setpoint> for SetpointMessage {
    fn from(setpoint: &Setpoint) -> Self {
        Self {
            tick: setpoint.tick,
            time_ns: setpoint.time_ns,
            angles: setpoint.angles.0,
            rates: setpoint.rates.0,
            feed_forward: setpoint.feed_forward.0,
        }
    }
}

impl Newest for SetpointMessage {
    const NOTHING: Self = Self {
        tick: NOTHING_YET,
        time_ns: 0,
        angles: [0.0; Joint::COUNT],
        rates: [0.0; Joint::COUNT],
        feed_forward: [0.0; Joint::COUNT],
    };

    fn tick(&self) -> u64 {
        self.tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nan_is_named_with_its_joint() {
        let mut message = SetpointMessage { tick: 3, ..SetpointMessage::NOTHING };
        assert!(message.checked().is_ok());
        message.rates[Joint::RightHipYaw.index()] = f64::NAN;
        let text = message.checked().unwrap_err().to_string();
        assert_eq!(text, "setpoint: rate of joint 7 (right_hip_yaw) is NaN; it must be finite");
    }

    #[test]
    fn it_survives_the_way_there_and_back() {
        let setpoint = Setpoint {
            tick: 7,
            time_ns: 9,
            angles: JointVector::from_fn(|joint| f64::from(joint.number())),
            rates: JointVector::unit(Joint::LeftKnee),
            feed_forward: JointVector::unit(Joint::RightKnee) * -3.0,
        };
        assert_eq!(SetpointMessage::from(&setpoint).checked(), Ok(setpoint));
    }
}
