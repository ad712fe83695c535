//! Measurement, plant → wire → controller.

use controller::Measurement;
use model::{PerJoint, Wrench};
use nalgebra::Quaternion;
use wire::MeasurementMessage;

/// What the plant's sensors say, for the wire.
pub fn message(tick: u64, time_ns: u64, measured: &plant::Measurement) -> MeasurementMessage {
    let orientation = measured.orientation.quaternion();
    MeasurementMessage::from(&wire::Measurement {
        tick,
        time_ns,
        sample: measured.sample,
        angles: measured.angles,
        rates: measured.rates,
        wrench_right: measured.feet[0],
        wrench_left: measured.feet[1],
        imu_orientation: [orientation.w, orientation.i, orientation.j, orientation.k],
        imu_rate: measured.angular_rate.into(),
        motor_current: measured.currents,
    })
}

/// What came over the wire, for the controller. Unchecked: the controller watches for what is no measurement, and says so
/// in its report.
pub fn for_controller(message: &MeasurementMessage) -> Measurement {
    let [w, i, j, k] = message.imu_orientation;
    Measurement {
        tick: message.sample,
        angles: PerJoint(message.angles),
        rates: PerJoint(message.rates),
        feet: [wrench(message.wrench_right), wrench(message.wrench_left)],
        orientation: Quaternion::new(w, i, j, k),
        angular_rate: message.imu_rate.into(),
    }
}

fn wrench([fx, fy, fz, mx, my, mz]: [f64; 6]) -> Wrench {
    Wrench { force: [fx, fy, fz].into(), moment: [mx, my, mz].into() }
}

#[cfg(test)]
mod tests {
    use model::{Joint, JointVector};
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    #[test]
    fn what_the_plant_senses_reaches_the_controller() {
        let sensed = plant::Measurement {
            sample: 6,
            angles: JointVector::unit(Joint::RightKnee),
            rates: JointVector::unit(Joint::LeftKnee),
            feet: [wrench([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), wrench([6.0, 5.0, 4.0, 3.0, 2.0, 1.0])],
            orientation: UnitQuaternion::from_euler_angles(0.1, -0.2, 0.3),
            angular_rate: Vector3::new(0.4, 0.5, 0.6),
            currents: JointVector::unit(Joint::WaistRoll),
        };
        let heard = for_controller(&message(7, 8, &sensed));
        assert_eq!(heard.tick, 6);
        assert_eq!((heard.angles, heard.rates, heard.feet), (sensed.angles, sensed.rates, sensed.feet));
        assert_eq!(heard.orientation, sensed.orientation.into_inner());
        assert_eq!(heard.angular_rate, sensed.angular_rate);
    }
}
