//! Measurement, plant → controller: one sample of all sensors.

use iceoryx2::prelude::ZeroCopySend;
use interface::{Measurement, SensorGroups};
use model::{Joint, PerJoint, Wrench};
use nalgebra::Quaternion;

use super::{Latest, NEVER_WRITTEN};

/// A [`Measurement`] as it lies in shared memory. Joints are physical and in the paper's order: 3 to 8 are always the
/// right leg.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.Measurement.v3")]
#[repr(C)]
pub struct MeasurementMessage {
    /// Periods since the plant started.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` (ns).
    pub time_ns: u64,
    /// Which sample of the sensors it is, counted in the plant's periods: the same number again is no news.
    pub sample: u64,
    /// (rad); joints 1 and 2 hold the tilt of the support sole.
    pub angles: [f64; Joint::COUNT],
    /// (rad/s)
    pub rates: [f64; Joint::COUNT],
    /// Of the ground on the right foot: force xyz (N), moment xyz (N·m), about the sole's origin, in the sole's axes.
    pub wrench_right: [f64; 6],
    /// Of the ground on the left foot, likewise.
    pub wrench_left: [f64; 6],
    /// Unit quaternion w x y z that takes trunk coordinates to level ones, z the true vertical.
    pub imu_orientation: [f64; 4],
    /// Angular velocity of the trunk in trunk axes (rad/s).
    pub imu_rate: [f64; 3],
    /// (A); 0 for joints 1 and 2.
    pub motor_current: [f64; Joint::COUNT],
    /// Acceleration of the trunk's origin less gravity, in trunk axes (m/s²).
    pub imu_specific_force: [f64; 3],
    /// The groups whose values are missing: the sum of [`SensorGroup`](interface::SensorGroup)s.
    pub missing: u64,
}

impl MeasurementMessage {
    /// The measurement written after `tick` periods at `time_ns` (`CLOCK_MONOTONIC`).
    pub fn new(tick: u64, time_ns: u64, measurement: &Measurement) -> Self {
        let orientation = measurement.orientation;
        Self {
            tick,
            time_ns,
            sample: measurement.sample,
            angles: measurement.angles.0,
            rates: measurement.rates.0,
            wrench_right: flat(&measurement.feet[0]),
            wrench_left: flat(&measurement.feet[1]),
            imu_orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
            imu_rate: measurement.angular_rate.into(),
            motor_current: measurement.currents.0,
            imu_specific_force: measurement.specific_force.into(),
            missing: measurement.missing.0.into(),
        }
    }

    /// The measurement as it was written. Nothing is checked: the controller validates it and reports what is wrong.
    pub fn measurement(&self) -> Measurement {
        let [w, i, j, k] = self.imu_orientation;
        Measurement {
            sample: self.sample,
            angles: PerJoint(self.angles),
            rates: PerJoint(self.rates),
            feet: [wrench(self.wrench_right), wrench(self.wrench_left)],
            orientation: Quaternion::new(w, i, j, k),
            angular_rate: self.imu_rate.into(),
            currents: PerJoint(self.motor_current),
            specific_force: self.imu_specific_force.into(),
            // No group has a bit beyond.
            missing: SensorGroups(self.missing as u32),
        }
    }
}

fn flat(Wrench { force, moment }: &Wrench) -> [f64; 6] {
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}

fn wrench([fx, fy, fz, mx, my, mz]: [f64; 6]) -> Wrench {
    Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() }
}

impl Latest for MeasurementMessage {
    const EMPTY: Self = Self {
        tick: NEVER_WRITTEN,
        time_ns: 0,
        sample: 0,
        angles: [0.0; Joint::COUNT],
        rates: [0.0; Joint::COUNT],
        wrench_right: [0.0; 6],
        wrench_left: [0.0; 6],
        imu_orientation: [1.0, 0.0, 0.0, 0.0],
        imu_rate: [0.0; 3],
        motor_current: [0.0; Joint::COUNT],
        imu_specific_force: [0.0; 3],
        missing: 0,
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
    use interface::SensorGroup;
    use model::JointVector;
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    #[test]
    fn a_measurement_survives_its_message() {
        let wrench = |force: [f64; 3], moment: [f64; 3]| Wrench { force: force.into(), moment: moment.into() };
        let measurement = Measurement {
            sample: 6,
            angles: JointVector::unit(Joint::RightKnee),
            rates: JointVector::unit(Joint::LeftKnee),
            feet: [wrench([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]), wrench([6.0, 5.0, 4.0], [3.0, 2.0, 1.0])],
            orientation: UnitQuaternion::from_euler_angles(0.1, -0.2, 0.3).into_inner(),
            angular_rate: Vector3::new(0.4, 0.5, 0.6),
            currents: JointVector::unit(Joint::WaistRoll),
            specific_force: Vector3::new(0.7, 0.8, 9.9),
            missing: SensorGroups(SensorGroup::LeftFoot.code()),
        };
        let message = MeasurementMessage::new(7, 8, &measurement);
        assert_eq!((message.tick, message.time_ns), (7, 8));
        assert_eq!(message.wrench_right, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "forces come before moments");
        assert_eq!(message.measurement(), measurement);
    }
}
