//! Measurement, plant → controller: what the sensors say.

use iceoryx2::prelude::ZeroCopySend;
use model::{Joint, JointVector, Side, Wrench};

use super::fault::Check;
use super::{MessageFault, NOTHING_YET, Newest};

/// A [`Measurement`] as it lies in shared memory. Joints are physical and in the paper's order: 3 to 8 are always the
/// right leg.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Measurement.v2")]
#[repr(C)]
pub struct MeasurementMessage {
    /// Periods since the plant started.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// Which sample of the sensors it is, counted in the plant's periods: the same number again is no news.
    pub sample: u64,
    /// [rad]; joints 1 and 2 hold the tilt of the support sole.
    pub angles: [f64; Joint::COUNT],
    /// [rad/s]
    pub rates: [f64; Joint::COUNT],
    /// Of the ground on the right foot: force xyz [N], moment xyz [N·m], about the sole's origin, in the sole's axes.
    pub wrench_right: [f64; 6],
    /// Of the ground on the left foot, likewise.
    pub wrench_left: [f64; 6],
    /// Unit quaternion w x y z that takes trunk coordinates to level ones, z the true vertical.
    pub imu_orientation: [f64; 4],
    /// Angular velocity of the trunk in trunk axes [rad/s].
    pub imu_rate: [f64; 3],
    /// [A]; 0 for joints 1 and 2.
    pub motor_current: [f64; Joint::COUNT],
}

/// What the sensors say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Periods since the plant started.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` [ns].
    pub time_ns: u64,
    /// Which sample of the sensors it is, counted in the plant's periods: the same number again is no news.
    pub sample: u64,
    /// [rad]; joints 1 and 2 hold the tilt of the support sole.
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Of the ground on the right foot, about the sole's origin, in the sole's axes.
    pub wrench_right: Wrench,
    /// Of the ground on the left foot, likewise.
    pub wrench_left: Wrench,
    /// Unit quaternion w x y z that takes trunk coordinates to level ones, z the true vertical.
    pub imu_orientation: [f64; 4],
    /// Angular velocity of the trunk in trunk axes [rad/s].
    pub imu_rate: [f64; 3],
    /// [A]; 0 for joints 1 and 2.
    pub motor_current: JointVector,
}

impl Measurement {
    /// The ground's wrench on the foot on `side`, about the sole's origin, in the sole's axes.
    pub fn wrench(&self, side: Side) -> Wrench {
        match side {
            Side::Right => self.wrench_right,
            Side::Left => self.wrench_left,
        }
    }
}

impl MeasurementMessage {
    /// The measurement, if every number in it is finite and the orientation is one.
    pub fn checked(&self) -> Result<Measurement, MessageFault> {
        let check = Check("measurement");
        Ok(Measurement {
            tick: self.tick,
            time_ns: self.time_ns,
            sample: self.sample,
            angles: check.joints("angle", &self.angles)?,
            rates: check.joints("rate", &self.rates)?,
            wrench_right: check.wrench("wrench_right", &self.wrench_right)?,
            wrench_left: check.wrench("wrench_left", &self.wrench_left)?,
            imu_orientation: check.rotation("imu_orientation", &self.imu_orientation)?,
            imu_rate: check.numbers("imu_rate", &self.imu_rate)?,
            motor_current: check.joints("motor_current", &self.motor_current)?,
        })
    }
}

impl From<&Measurement> for MeasurementMessage {
    fn from(measurement: &Measurement) -> Self {
        Self {
            tick: measurement.tick,
            time_ns: measurement.time_ns,
            sample: measurement.sample,
            angles: measurement.angles.0,
            rates: measurement.rates.0,
            wrench_right: flat(&measurement.wrench_right),
            wrench_left: flat(&measurement.wrench_left),
            imu_orientation: measurement.imu_orientation,
            imu_rate: measurement.imu_rate,
            motor_current: measurement.motor_current.0,
        }
    }
}

fn flat(Wrench { force, moment }: &Wrench) -> [f64; 6] {
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}

impl Newest for MeasurementMessage {
    const NOTHING: Self = Self {
        tick: NOTHING_YET,
        time_ns: 0,
        sample: 0,
        angles: [0.0; Joint::COUNT],
        rates: [0.0; Joint::COUNT],
        wrench_right: [0.0; 6],
        wrench_left: [0.0; 6],
        imu_orientation: [1.0, 0.0, 0.0, 0.0],
        imu_rate: [0.0; 3],
        motor_current: [0.0; Joint::COUNT],
    };

    fn tick(&self) -> u64 {
        self.tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_come_before_moments() {
        let message = MeasurementMessage {
            wrench_right: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            wrench_left: [-1.0; 6],
            ..MeasurementMessage::NOTHING
        };
        let measurement = message.checked().unwrap();
        assert_eq!(measurement.wrench(Side::Right).force.as_slice(), [1.0, 2.0, 3.0]);
        assert_eq!(measurement.wrench(Side::Right).moment.as_slice(), [4.0, 5.0, 6.0]);
        assert_eq!(MeasurementMessage::from(&measurement), message);
    }

    #[test]
    fn an_orientation_that_is_none_is_refused() {
        let message = MeasurementMessage { imu_orientation: [0.0; 4], ..MeasurementMessage::NOTHING };
        let text = message.checked().unwrap_err().to_string();
        assert_eq!(text, "measurement: imu_orientation has length 0; a rotation has length 1");
    }

    #[test]
    fn an_infinite_wrench_is_refused() {
        let mut message = MeasurementMessage::NOTHING;
        message.wrench_left[5] = f64::INFINITY;
        let text = message.checked().unwrap_err().to_string();
        assert_eq!(text, "measurement: wrench_left is inf; it must be finite");
    }
}
