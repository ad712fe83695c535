//! The measurement validator: rejects measurements that are stale or out of order, and the values of sensors that are
//! missing, not finite, implausible, or inconsistent with each other and with the setpoint. One dead sensor does not
//! silence the others: each is judged by itself.

use interface::{Fault, Faults, Measurement, Rejection, Sensor, SensorGroup, SensorGroups};
use model::{GRAVITY, Joint, Mechanism};
use nalgebra::{UnitQuaternion, Vector3};

use crate::plausibility::Plausibility;
use crate::rejected_sensors::RejectedSensors;
use crate::sensor_consistency::{Expectation, SensorConsistency};
use crate::validator_parameters::ValidatorParameters;

/// The part of a sample that can be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UsableSample {
    /// The sample. Joints whose values cannot be used are where they were commanded to be.
    pub measurement: Measurement,
    /// The groups whose values cannot be used, but for joints.
    pub unusable: SensorGroups,
}

/// Lets valid values through, and knows how long ago the last sample without a fault arrived.
#[derive(Clone, Debug)]
pub struct MeasurementValidator {
    parameters: ValidatorParameters,
    plausibility: Plausibility,
    /// Number of the newest valid sample.
    newest: Option<u64>,
    /// Time since the last sample without a fault (s).
    age: f64,
    /// The vertical (unit vector) and the angular rate (rad/s) of the last valid measurement, in trunk axes.
    trunk: Option<[Vector3<f64>; 2]>,
    /// Time since that measurement (s).
    trunk_age: f64,
    /// Time since the last usable orientation (s).
    orientation_age: f64,
    /// How long the trunk has been tilted beyond recovery (s).
    tilted: f64,
    consistency: SensorConsistency,
    /// Time since the last sample that was checked for consistency (s).
    unchecked: f64,
    /// What was wrong with the newest sample, if something was.
    rejection: Option<Rejection>,
    /// Whether the newest sample is the first one of a robot.
    has_found_robot: bool,
}

impl MeasurementValidator {
    /// A validator that has seen no measurement; the timeout begins now.
    pub fn new(mechanism: &Mechanism, parameters: ValidatorParameters) -> Self {
        let weight = mechanism.mass() * GRAVITY;
        Self {
            parameters,
            plausibility: Plausibility::new(mechanism, &parameters),
            newest: None,
            age: 0.0,
            trunk: None,
            trunk_age: 0.0,
            orientation_age: 0.0,
            tilted: 0.0,
            consistency: SensorConsistency::new(parameters.consistency, weight),
            unchecked: 0.0,
            rejection: None,
            has_found_robot: false,
        }
    }

    /// Absorbs what arrived within the last `dt` seconds, and returns what of a new sample can be used.
    ///
    /// * `expected` – what is commanded, if the robot is to follow it: then measurements must be consistent with it and
    ///   with each other
    pub(crate) fn update(
        &mut self,
        measurement: Option<&Measurement>,
        expected: Option<&Expectation>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<UsableSample> {
        self.age += dt;
        self.trunk_age += dt;
        self.orientation_age += dt;
        self.unchecked += dt;
        let mut usable = None;
        // The same sample again adds nothing, but is no fault: the periods of the two processes drift.
        if let Some(measurement) = measurement.filter(|measurement| self.newest != Some(measurement.sample)) {
            let mut rejected = RejectedSensors::default();
            usable = self.check(measurement, expected, &mut rejected);
            self.rejection = rejected.first();
            match self.rejection {
                None => self.age = 0.0,
                Some(rejection) => faults.insert(rejection.fault),
            }
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        usable
    }

    /// Whether the newest sample is the first one of a robot: the first ever, or the first after the timeout of one
    /// that counts from the start again.
    pub fn has_found_robot(&self) -> bool {
        self.has_found_robot
    }

    /// What was wrong with the newest sample, if something was.
    pub fn rejection(&self) -> Option<Rejection> {
        self.rejection
    }

    /// Forgets what former samples say about present ones, as if a sensor had been repaired.
    pub(crate) fn begin_anew(&mut self) {
        self.consistency.reset();
    }

    /// Checks a new sample, and returns what of it can be used.
    fn check(
        &mut self,
        measurement: &Measurement,
        expected: Option<&Expectation>,
        rejected: &mut RejectedSensors,
    ) -> Option<UsableSample> {
        let is_earlier = self.newest.is_some_and(|newest| measurement.sample < newest);
        if is_earlier && !self.is_stale() {
            rejected.insert(Fault::MeasurementOutOfOrder, Sensor::All);
            return None;
        }
        // After the timeout, a plant that counts from the start again is a new one.
        let is_new_robot = self.newest.is_none() || is_earlier;
        // It is where it is, whatever was commanded.
        let expected = expected.filter(|_| !is_new_robot);
        self.plausibility.check(measurement, rejected);
        let is_plausible = rejected.first().is_none();
        if is_new_robot && !is_plausible {
            return None;
        }
        let up = UnitQuaternion::new_normalize(measurement.orientation).inverse() * Vector3::z();
        if is_plausible {
            self.contradicts_gyro(&up, &measurement.angular_rate, rejected);
        }
        self.newest = Some(measurement.sample);
        self.has_found_robot = is_new_robot;
        if rejected.first().is_none() {
            self.reject_inconsistent(measurement, &up, expected, rejected);
        }
        let up = (!rejected.groups().contains(SensorGroup::Orientation)).then_some(up);
        self.note_trunk(up, measurement.angular_rate, rejected);
        // Without a setpoint nobody knows where a joint is that does not tell.
        if rejected.has_any_joint() && expected.is_none() {
            return None;
        }
        let mut measurement = *measurement;
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered() && rejected.has_joint(*joint)) {
            let setpoint = expected.map(|expected| expected.setpoint)?;
            measurement.angles[joint] = setpoint.angles[joint];
            measurement.rates[joint] = setpoint.rates[joint];
        }
        Some(UsableSample { measurement, unusable: rejected.groups() })
    }

    /// Notes the trunk's motion, as far as it can be used.
    fn note_trunk(&mut self, up: Option<Vector3<f64>>, rate: Vector3<f64>, rejected: &RejectedSensors) {
        let Some(up) = up else { return };
        let is_tilted = up.z < libm::cos(self.parameters.tilt_max);
        self.tilted = if is_tilted { self.tilted + self.orientation_age } else { 0.0 };
        self.orientation_age = 0.0;
        if !rejected.groups().contains(SensorGroup::AngularRate) {
            self.trunk = Some([up, rate]);
            self.trunk_age = 0.0;
        }
    }

    /// Rejects what of a plausible sample contradicts other values or what is commanded.
    fn reject_inconsistent(
        &mut self,
        measurement: &Measurement,
        up: &Vector3<f64>,
        expected: Option<&Expectation>,
        rejected: &mut RejectedSensors,
    ) {
        let dt = std::mem::take(&mut self.unchecked);
        if expected.is_none() || dt >= self.parameters.gyro_horizon {
            self.consistency.reset();
        }
        if let Some(expected) = expected {
            self.consistency.update(measurement, up, expected, dt, rejected);
        }
    }

    /// Whether no valid measurement has arrived for longer than the timeout.
    pub fn is_stale(&self) -> bool {
        self.age > self.parameters.timeout
    }

    /// Rejects an angular rate that jumps, or a vertical that is not where the last one turns to at the mean rate of
    /// both samples (`u̇ = u × ω` in trunk axes). After a gap beyond the gyro's horizon nothing can contradict.
    fn contradicts_gyro(&self, up: &Vector3<f64>, rate: &Vector3<f64>, rejected: &mut RejectedSensors) {
        let ValidatorParameters { orientation_jump_max, trunk_rate_jump_max, gyro_horizon, .. } = self.parameters;
        let Some([last_up, last_rate]) = self.trunk.filter(|_| self.trunk_age < gyro_horizon) else { return };
        let expected = last_up + last_up.cross(&((last_rate + rate) * (self.trunk_age / 2.0)));
        if (rate - last_rate).amax() > trunk_rate_jump_max {
            rejected.insert(Fault::MeasurementImplausible, Sensor::AngularRate);
        } else if up.dot(&expected.normalize()) < libm::cos(orientation_jump_max) {
            rejected.insert(Fault::MeasurementImplausible, Sensor::Orientation);
        }
    }

    /// Whether the trunk was within recovery at the last valid measurement.
    pub fn is_upright(&self) -> bool {
        self.tilted == 0.0
    }

    /// Whether the trunk has been tilted beyond recovery for long enough.
    pub fn has_fallen(&self) -> bool {
        self.tilted > self.parameters.fall_confirmation
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::JointVector;

    use super::*;

    fn validator() -> MeasurementValidator {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        MeasurementValidator::new(&mechanism, ValidatorParameters::with_default_thresholds(0.02, 40_f64.to_radians()))
    }

    /// A trunk turned about an axis that is not x, y or z, at a rate (rad, rad/s).
    fn turned(tick: u64, angle: f64, rate: f64) -> Measurement {
        let axis = nalgebra::Unit::new_normalize(Vector3::new(0.8, -0.6, 0.1));
        Measurement {
            sample: tick,
            angles: JointVector::ZERO,
            rates: JointVector::ZERO,
            feet: [model::Wrench::ZERO; 2],
            orientation: UnitQuaternion::from_axis_angle(&axis, angle).into_inner(),
            angular_rate: axis.into_inner() * rate,
            currents: JointVector::ZERO,
            specific_force: Vector3::z() * GRAVITY,
            missing: SensorGroups::NONE,
        }
    }

    fn is_valid(validator: &mut MeasurementValidator, sample: &Measurement, dt: f64, faults: &mut Faults) -> bool {
        validator.update(Some(sample), None, dt, faults).is_some() && validator.rejection().is_none()
    }

    /// Each sensor alone is missing, or says nonsense: what is left can be used.
    #[test]
    fn one_dead_sensor_does_not_silence_the_others() {
        type Spoil = fn(&mut Measurement);
        let dead: [(SensorGroup, Spoil); 5] = [
            (SensorGroup::Orientation, |sample| sample.orientation.coords.x = f64::NAN),
            (SensorGroup::AngularRate, |sample| sample.angular_rate.y = 1e3),
            (SensorGroup::RightFoot, |sample| sample.feet[0].force.z = f64::INFINITY),
            (SensorGroup::LeftFoot, |sample| sample.feet[1].moment.x = f64::NAN),
            (SensorGroup::SpecificForce, |sample| sample.specific_force.x = -1e6),
        ];
        for (group, spoil) in dead {
            let mut spoilt = turned(1, 0.1, 0.0);
            spoil(&mut spoilt);
            let mut missing = turned(1, 0.1, 0.0);
            missing.missing.insert(group);
            for (sample, is_fault) in [(spoilt, true), (missing, group != SensorGroup::SpecificForce)] {
                let (mut validator, mut faults) = (validator(), Faults::default());
                validator.update(Some(&turned(0, 0.1, 0.0)), None, 1e-3, &mut faults).expect("a good sample");
                let usable = validator.update(Some(&sample), None, 1e-3, &mut faults).expect("the others go on");
                assert_eq!(usable.unusable.iter().collect::<Vec<_>>(), [group]);
                assert_eq!(
                    (validator.rejection().is_some(), faults != Faults::default()),
                    (is_fault, is_fault),
                    "{group}"
                );
            }
        }
    }

    #[test]
    fn a_dead_encoder_is_taken_to_be_where_it_was_commanded() {
        let mut setpoint = interface::Setpoint { angles: JointVector::ZERO, ..interface::Setpoint::default() };
        setpoint.angles[Joint::LeftKnee] = 0.4;
        let expected = Expectation {
            setpoint: &setpoint,
            yielding: &JointVector::ZERO,
            deflection: &JointVector::ZERO,
            support: None,
        };
        let mut validator = validator();
        validator.update(Some(&turned(0, 0.1, 0.0)), Some(&expected), 1e-3, &mut Faults::default());
        let mut dead = turned(1, 0.1, 0.0);
        dead.angles[Joint::LeftKnee] = f64::NAN;
        dead.angles[Joint::RightKnee] = 0.01;
        let usable =
            validator.update(Some(&dead), Some(&expected), 1e-3, &mut Faults::default()).expect("a part of it");
        assert_eq!(usable.measurement.angles[Joint::LeftKnee], 0.4);
        assert_eq!(usable.measurement.angles[Joint::RightKnee], 0.01);
        assert!(validator.rejection().is_some());
    }

    /// At 6 rad/s the trunk is tilted beyond 40° after 0.12 s; the robot counts as fallen 50 ms later.
    #[test]
    fn a_tilt_that_lasts_is_a_fall() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        let mut fallen_at = None;
        for tick in 0..200 {
            let time = tick as f64 * 1e-3;
            assert!(is_valid(&mut validator, &turned(tick, 6.0 * time, 6.0), 1e-3, &mut faults));
            fallen_at = fallen_at.or(validator.has_fallen().then_some(time));
        }
        assert!((0.16..0.18).contains(&fallen_at.unwrap()), "{fallen_at:?}");
        assert_eq!(faults, Faults::default());
    }

    #[test]
    fn an_orientation_jump_without_rate_is_implausible() {
        let mut validator = validator();
        for tick in 0..100 {
            let jumps = (50..60).contains(&tick);
            let mut faults = Faults::default();
            let measurement = turned(tick, if jumps { 1.57 } else { 0.1 }, 0.0);
            assert_eq!(is_valid(&mut validator, &measurement, 1e-3, &mut faults), !jumps, "tick {tick}");
            assert_eq!(faults.contains(Fault::MeasurementImplausible), jumps, "tick {tick}");
            assert!(!validator.has_fallen());
        }
    }

    #[test]
    fn a_jump_of_the_angular_rate_is_implausible() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        assert!(is_valid(&mut validator, &turned(0, 0.1, 0.0), 1e-3, &mut faults));
        assert!(!is_valid(&mut validator, &turned(1, 0.1, 17.0), 1e-3, &mut faults));
        assert!(faults.contains(Fault::MeasurementImplausible));
        assert!(is_valid(&mut validator, &turned(2, 0.1, 0.1), 1e-3, &mut faults));
    }

    /// A gap of 15 ms in a turn of 5 rad/s: 4.3° that the gyro explains.
    #[test]
    fn a_rotation_during_a_gap_is_plausible() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        for tick in (0..10).chain(25..40) {
            let measurement = turned(tick, 0.8 - 5.0 * tick as f64 * 1e-3, -5.0);
            let dt = if tick == 25 { 0.016 } else { 1e-3 };
            assert!(is_valid(&mut validator, &measurement, dt, &mut faults), "tick {tick}");
        }
    }
}
