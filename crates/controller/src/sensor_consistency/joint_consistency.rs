//! Joint angles against their setpoints and against their rates.

use interface::{Fault, Measurement, Sensor};
use model::{Joint, JointVector};

use super::expectation::Expectation;
use super::parameters::ConsistencyParameters;
use crate::rejected_sensors::RejectedSensors;

/// Time over which the mean tracking error is formed (s): pushes and impacts are shorter.
const BIAS_TIME_CONSTANT: f64 = 0.3;
/// Time constant with which the integral of a rate is corrected by the measured angle (s).
const CORRECTION_TIME_CONSTANT: f64 = 0.1;
/// Longest gap between samples over which rates can be integrated (s).
const INTEGRABLE: f64 = 0.005;

/// Finds encoders that are off, stuck or reversed, drives that do not follow, and rates that are not those of the
/// angles.
#[derive(Clone, Debug, Default)]
pub(super) struct JointConsistency {
    /// Mean tracking error (rad).
    bias: JointVector,
    /// The angles that the rates lead to (rad).
    integral: Option<JointVector>,
}

impl JointConsistency {
    /// Absorbs a sample, and rejects the joints that are off.
    pub(super) fn update(
        &mut self,
        sample: &Measurement,
        last: &Measurement,
        expected: &Expectation,
        parameters: &ConsistencyParameters,
        dt: f64,
        rejected: &mut RejectedSensors,
    ) {
        let errors = JointVector::from_fn(|joint| {
            let (angle, setpoint) = (sample.angles[joint], expected.setpoint.angles[joint]);
            let unyielding = setpoint - expected.yielding[joint];
            let deflected = setpoint + expected.deflection[joint];
            let bounds = [setpoint.min(unyielding).min(deflected), setpoint.max(unyielding).max(deflected)];
            angle - angle.max(bounds[0]).min(bounds[1])
        });
        let rate_errors = self.rate_errors(sample, last, dt);
        // The first two joints are those of the foot on the ground, which nothing measures.
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
            let is_astray = errors[joint].abs() > parameters.tracking_error_max;
            // A moment's glitch leaves no trace in the mean.
            if !is_astray {
                self.bias[joint] += (errors[joint] - self.bias[joint]) * dt / (BIAS_TIME_CONSTANT + dt);
            }
            let is_biased = self.bias[joint].abs() > parameters.tracking_bias_max;
            if is_astray || is_biased {
                rejected.insert(Fault::JointOffSetpoint, Sensor::JointAngle(joint));
            } else if rate_errors[joint].abs() > parameters.rate_error_max {
                // The setpoint is the third witness.
                let is_angle_off = errors[joint].abs() > parameters.tracking_bias_max;
                let sensor = if is_angle_off { Sensor::JointAngle(joint) } else { Sensor::JointRate(joint) };
                rejected.insert(Fault::MeasurementInconsistent, sensor);
            }
        }
    }

    /// The measured angles minus those that the rates lead to (rad).
    fn rate_errors(&mut self, sample: &Measurement, last: &Measurement, dt: f64) -> JointVector {
        let Some(integral) = self.integral.filter(|_| dt < INTEGRABLE) else {
            self.integral = Some(sample.angles);
            return JointVector::ZERO;
        };
        let predicted = integral + (sample.rates + last.rates) * (dt / 2.0);
        let errors = sample.angles - predicted;
        self.integral = Some(predicted + errors * (dt / (CORRECTION_TIME_CONSTANT + dt)));
        errors
    }
}

#[cfg(test)]
mod tests {
    use interface::{Rejection, Setpoint};

    use super::*;

    const PARAMETERS: ConsistencyParameters = ConsistencyParameters {
        orientation_error_max: 0.012,
        tracking_error_max: 0.15,
        tracking_bias_max: 0.02,
        rate_error_max: 0.01,
        load_share: [0.6, 1.5],
    };

    /// A knee that swings by 0.3 rad at 2 Hz and follows its setpoint.
    fn swinging(time: f64) -> (Setpoint, Measurement) {
        let omega = std::f64::consts::TAU * 2.0;
        let at = |value: f64| model::PerJoint::from_fn(|joint| if joint == Joint::LeftKnee { value } else { 0.0 });
        let (angles, rates) = (at(0.3 * (omega * time).sin()), at(0.3 * omega * (omega * time).cos()));
        let setpoint = Setpoint { angles, rates, feed_forward: JointVector::ZERO };
        let sample = Measurement {
            sample: 0,
            angles,
            rates,
            feet: [model::Wrench::ZERO; 2],
            orientation: nalgebra::Quaternion::identity(),
            angular_rate: nalgebra::Vector3::zeros(),
            currents: JointVector::ZERO,
            specific_force: nalgebra::Vector3::z() * model::GRAVITY,
            missing: interface::SensorGroups::NONE,
        };
        (setpoint, sample)
    }

    fn expectation(setpoint: &Setpoint) -> Expectation<'_> {
        Expectation { setpoint, yielding: &JointVector::ZERO, deflection: &JointVector::ZERO, support: None }
    }

    /// What is found of a swing with wrong values from 1 s on, and when (s after it).
    fn found(wrong: impl Fn(&mut Measurement)) -> Option<(f64, Rejection)> {
        let mut joints = JointConsistency::default();
        let mut last = swinging(0.0).1;
        for tick in 0..3000 {
            let time = f64::from(tick) * 1e-3;
            let (setpoint, mut sample) = swinging(time);
            if time >= 1.0 {
                wrong(&mut sample);
            }
            if let Some(rejection) = update(&mut joints, &sample, &last, &expectation(&setpoint)) {
                return Some((time - 1.0, rejection));
            }
            last = sample;
        }
        None
    }

    fn update(
        joints: &mut JointConsistency,
        sample: &Measurement,
        last: &Measurement,
        expected: &Expectation,
    ) -> Option<Rejection> {
        let mut rejected = RejectedSensors::default();
        joints.update(sample, last, expected, &PARAMETERS, 1e-3, &mut rejected);
        rejected.first()
    }

    #[test]
    fn a_swing_that_is_followed_is_consistent() {
        assert_eq!(found(|_| {}), None);
    }

    /// A foot on its toes for half a second: the ankle, whose drive yields, stays where the sole holds it.
    #[test]
    fn a_drive_that_yields_where_feedback_leans_is_consistent() {
        let leans = JointVector::unit(Joint::RightAnklePitch) * 0.04;
        let setpoint = Setpoint { angles: leans, rates: JointVector::ZERO, feed_forward: JointVector::ZERO };
        let found = |angle: f64| {
            let mut joints = JointConsistency::default();
            let mut sample = Measurement { rates: JointVector::ZERO, ..swinging(0.0).1 };
            sample.angles[Joint::RightAnklePitch] = angle;
            let expected =
                Expectation { setpoint: &setpoint, yielding: &leans, deflection: &JointVector::ZERO, support: None };
            (0..500).find_map(|_| update(&mut joints, &sample, &sample, &expected))
        };
        assert_eq!(found(0.0), None);
        assert_eq!(found(0.04), None);
        let beyond = found(-0.03).unwrap();
        assert_eq!(beyond.sensor, Sensor::JointAngle(Joint::RightAnklePitch));
    }

    /// A foot on a stone carries more than planned: the knee gives way by what its drive yields, and by no more.
    #[test]
    fn a_drive_that_yields_to_the_ground_is_consistent() {
        let deflection = JointVector::unit(Joint::LeftKnee) * 0.03;
        let found = |angle: f64| {
            let (setpoint, mut sample) = swinging(0.0);
            (sample.angles[Joint::LeftKnee], sample.rates) = (angle, JointVector::ZERO);
            let mut joints = JointConsistency::default();
            let expected = Expectation { deflection: &deflection, ..expectation(&setpoint) };
            (0..500).find_map(|_| update(&mut joints, &sample, &sample, &expected))
        };
        assert_eq!(found(0.0), None);
        assert_eq!(found(0.03), None);
        assert_eq!(found(0.06).unwrap().sensor, Sensor::JointAngle(Joint::LeftKnee));
        assert_eq!(found(-0.03).unwrap().sensor, Sensor::JointAngle(Joint::LeftKnee));
    }

    #[test]
    fn a_rate_that_is_off_or_reversed_is_named() {
        for wrong in [
            (|sample: &mut Measurement| sample.rates[Joint::LeftKnee] += 0.5) as fn(&mut Measurement),
            |sample| sample.rates[Joint::LeftKnee] *= -1.0,
            |sample| sample.rates[Joint::LeftKnee] = 0.0,
        ] {
            let (after, rejection) = found(wrong).unwrap();
            assert_eq!(rejection.sensor, Sensor::JointRate(Joint::LeftKnee));
            assert!(after < 0.05, "after {after} s");
        }
    }

    #[test]
    fn an_encoder_that_is_off_by_two_degrees_is_named() {
        let (after, rejection) = found(|sample| sample.angles[Joint::LeftKnee] += 0.035).unwrap();
        assert_eq!(rejection.sensor, Sensor::JointAngle(Joint::LeftKnee));
        assert!(after < 0.3, "after {after} s");
    }

    #[test]
    fn an_encoder_that_drifts_is_named() {
        let mut joints = JointConsistency::default();
        let (_, mut last) = swinging(0.0);
        let off = |tick: u32| f64::from(tick) * 1e-3 * 0.035;
        let named = (0..3000).find_map(|tick| {
            let (setpoint, mut sample) = swinging(f64::from(tick) * 1e-3);
            sample.angles[Joint::LeftKnee] += off(tick);
            let rejection = update(&mut joints, &sample, &last, &expectation(&setpoint));
            last = sample;
            rejection.map(|rejection| (off(tick), rejection.sensor))
        });
        let (off, sensor) = named.unwrap();
        assert_eq!(sensor, Sensor::JointAngle(Joint::LeftKnee));
        assert!(off < 0.04, "{off} rad");
    }
}
