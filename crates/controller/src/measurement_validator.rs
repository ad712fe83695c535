//! The measurement validator: rejects measurements that are stale, out of order, not finite, implausible, or
//! inconsistent with each other and with the setpoint.

use interface::{Fault, Faults, Measurement, Rejection, Sensor};
use model::{GRAVITY, Joint, JointLimits, Mechanism, PerJoint, Side};
use nalgebra::{UnitQuaternion, Vector3};

use crate::sensor_consistency::{ConsistencyParameters, Expectation, SensorConsistency};

/// What counts as a valid measurement and as a fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValidatorParameters {
    /// Longest time without a valid measurement (s); beyond it the robot stops.
    pub timeout: f64,
    /// Tilt of the trunk beyond which the robot cannot recover (rad).
    pub tilt_max: f64,
    /// Time that the trunk must be tilted beyond recovery before the robot counts as fallen (s). No fall ends sooner.
    pub fall_confirmation: f64,
    /// Tolerance of the measured joint angles beyond their range (rad): stops give way, encoders are mounted by hand.
    pub angle_tolerance: f64,
    /// Largest measured joint rate, as a multiple of the joint's rate limit (-).
    pub rate_factor_max: f64,
    /// Largest measured angular rate of the trunk about an axis (rad/s).
    pub trunk_rate_max: f64,
    /// Largest measured force on a foot, as a multiple of the robot's weight (-); likewise for moments, at an arm of 1
    /// m.
    pub load_factor_max: f64,
    /// Largest angle between the measured vertical and the one that the gyro predicts from the last sample (rad).
    pub orientation_jump_max: f64,
    /// Largest change of the trunk's angular rate between two samples (rad/s): no push turns a trunk more suddenly.
    pub trunk_rate_jump_max: f64,
    /// Longest gap between two samples that the gyro can bridge (s).
    pub gyro_horizon: f64,
    /// How far measurements may contradict each other and the setpoint.
    pub consistency: ConsistencyParameters,
}

/// Deviation of a measured quaternion's norm from 1 up to which it is an orientation.
const NORM_TOLERANCE: f64 = 0.01;

impl ValidatorParameters {
    /// Thresholds for a `timeout` (s) and a `tilt_max` (rad) where the configuration has no others.
    pub const fn with_default_thresholds(timeout: f64, tilt_max: f64) -> Self {
        Self {
            timeout,
            tilt_max,
            fall_confirmation: 0.05,
            angle_tolerance: 0.5,
            rate_factor_max: 5.0,
            trunk_rate_max: 50.0,
            load_factor_max: 50.0,
            orientation_jump_max: 0.175,
            trunk_rate_jump_max: 5.0,
            gyro_horizon: 0.25,
            consistency: ConsistencyParameters {
                orientation_error_max: 0.012,
                tracking_error_max: 0.15,
                tracking_bias_max: 0.02,
                rate_error_max: 0.01,
                load_share: [0.6, 1.5],
            },
        }
    }
}

/// Lets valid measurements through, and knows how long ago the last one arrived.
#[derive(Clone, Debug)]
pub struct MeasurementValidator {
    parameters: ValidatorParameters,
    limits: PerJoint<Option<JointLimits>>,
    /// Largest plausible force on a foot (N).
    force_max: f64,
    /// Number of the newest valid sample.
    newest: Option<u64>,
    /// Time since the last valid measurement (s).
    age: f64,
    /// The vertical (unit vector) and the angular rate (rad/s) of the last valid measurement, in trunk axes.
    trunk: Option<[Vector3<f64>; 2]>,
    /// Time since that measurement (s).
    trunk_age: f64,
    /// How long the trunk has been tilted beyond recovery (s).
    tilted: f64,
    consistency: SensorConsistency,
    /// Time since the last sample that was checked for consistency (s).
    unchecked: f64,
    /// Why the newest sample was rejected, if it was.
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
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            force_max: parameters.load_factor_max * weight,
            newest: None,
            age: 0.0,
            trunk: None,
            trunk_age: 0.0,
            tilted: 0.0,
            consistency: SensorConsistency::new(parameters.consistency, weight),
            unchecked: 0.0,
            rejection: None,
            has_found_robot: false,
        }
    }

    /// Absorbs what arrived within the last `dt` seconds; a valid measurement is returned with the vertical (unit
    /// vector) in its trunk's axes.
    ///
    /// * `expected` – what is commanded, if the robot is to follow it: then measurements must be consistent with it and
    ///   with each other
    pub(crate) fn update<'m>(
        &mut self,
        measurement: Option<&'m Measurement>,
        expected: Option<&Expectation>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<(&'m Measurement, Vector3<f64>)> {
        self.age += dt;
        self.trunk_age += dt;
        self.unchecked += dt;
        let mut valid = None;
        // The same sample again adds nothing, but is no fault: the periods of the two processes drift.
        if let Some(measurement) = measurement.filter(|measurement| self.newest != Some(measurement.sample)) {
            match self.check(measurement, expected) {
                Ok(up) => {
                    self.age = 0.0;
                    self.rejection = None;
                    valid = Some((measurement, up));
                }
                Err(rejection) => {
                    self.rejection = Some(rejection);
                    faults.insert(rejection.fault);
                }
            }
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        valid
    }

    /// Whether the newest sample is the first one of a robot: the first ever, or the first after the timeout of one
    /// that counts from the start again.
    pub fn has_found_robot(&self) -> bool {
        self.has_found_robot
    }

    /// Why the newest sample was rejected, if it was.
    pub fn rejection(&self) -> Option<Rejection> {
        self.rejection
    }

    /// Forgets what former samples say about present ones, as if a sensor had been repaired.
    pub(crate) fn begin_anew(&mut self) {
        self.consistency.reset();
    }

    /// Checks a new sample, and returns the vertical in its trunk's axes.
    fn check(&mut self, measurement: &Measurement, expected: Option<&Expectation>) -> Result<Vector3<f64>, Rejection> {
        let is_earlier = self.newest.is_some_and(|newest| measurement.sample < newest);
        if is_earlier && !self.is_stale() {
            return Err(Rejection { fault: Fault::MeasurementOutOfOrder, sensor: Sensor::All });
        }
        // After the timeout, a plant that counts from the start again is a new one.
        let is_new_robot = self.newest.is_none() || is_earlier;
        // It is where it is, whatever was commanded.
        let expected = expected.filter(|_| !is_new_robot);
        let up = up_in_trunk(measurement)?;
        let implausible =
            self.implausible(measurement).or_else(|| self.contradicts_gyro(&up, &measurement.angular_rate));
        if let Some(sensor) = implausible {
            return Err(Rejection { fault: Fault::MeasurementImplausible, sensor });
        }
        self.newest = Some(measurement.sample);
        self.has_found_robot = is_new_robot;
        let inconsistent = self.inconsistent(measurement, &up, expected);
        if !matches!(inconsistent, Some(Rejection { sensor: Sensor::Orientation, .. })) {
            let is_tilted = up.z < self.parameters.tilt_max.cos();
            self.tilted = if is_tilted { self.tilted + self.trunk_age } else { 0.0 };
            self.trunk = Some([up, measurement.angular_rate]);
            self.trunk_age = 0.0;
        }
        inconsistent.map_or(Ok(up), Err)
    }

    /// What of a plausible sample contradicts other values or what is commanded.
    fn inconsistent(
        &mut self,
        measurement: &Measurement,
        up: &Vector3<f64>,
        expected: Option<&Expectation>,
    ) -> Option<Rejection> {
        let dt = std::mem::take(&mut self.unchecked);
        if expected.is_none() || dt >= self.parameters.gyro_horizon {
            self.consistency.reset();
        }
        self.consistency.update(measurement, up, expected?, dt)
    }

    /// The sensor with a value that no working sensor of this robot produces, if there is one.
    fn implausible(&self, measurement: &Measurement) -> Option<Sensor> {
        let ValidatorParameters { angle_tolerance, rate_factor_max, trunk_rate_max, .. } = self.parameters;
        for joint in Joint::ALL {
            let Some(limits) = &self.limits[joint] else { continue };
            let range = limits.angle_min - angle_tolerance..=limits.angle_max + angle_tolerance;
            if !range.contains(&measurement.angles[joint]) {
                return Some(Sensor::JointAngle(joint));
            } else if measurement.rates[joint].abs() > rate_factor_max * limits.rate_max {
                return Some(Sensor::JointRate(joint));
            }
        }
        for side in Side::BOTH {
            let foot = &measurement.feet[side.index()];
            if foot.force.amax().max(foot.moment.amax()) > self.force_max {
                return Some(Sensor::Foot(side));
            }
        }
        (measurement.angular_rate.amax() > trunk_rate_max).then_some(Sensor::AngularRate)
    }

    /// Whether no valid measurement has arrived for longer than the timeout.
    pub fn is_stale(&self) -> bool {
        self.age > self.parameters.timeout
    }

    /// Whether the angular rate jumps, or the vertical is not where the last one turns to at the mean rate of both
    /// samples (`u̇ = u × ω` in trunk axes). After a gap beyond the gyro's horizon nothing can contradict.
    fn contradicts_gyro(&self, up: &Vector3<f64>, rate: &Vector3<f64>) -> Option<Sensor> {
        let ValidatorParameters { orientation_jump_max, trunk_rate_jump_max, gyro_horizon, .. } = self.parameters;
        let [last_up, last_rate] = self.trunk.filter(|_| self.trunk_age < gyro_horizon)?;
        let expected = last_up + last_up.cross(&((last_rate + rate) * (self.trunk_age / 2.0)));
        if (rate - last_rate).amax() > trunk_rate_jump_max {
            Some(Sensor::AngularRate)
        } else if up.dot(&expected.normalize()) < orientation_jump_max.cos() {
            Some(Sensor::Orientation)
        } else {
            None
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

/// The vertical in trunk axes, if every value is finite and the orientation is a rotation.
fn up_in_trunk(measurement: &Measurement) -> Result<Vector3<f64>, Rejection> {
    let not_finite = Joint::ALL
        .into_iter()
        .find_map(|joint| {
            let [angle, rate] = [measurement.angles[joint], measurement.rates[joint]].map(f64::is_finite);
            match (angle, rate) {
                (false, _) => Some(Sensor::JointAngle(joint)),
                (_, false) => Some(Sensor::JointRate(joint)),
                _ => None,
            }
        })
        .or_else(|| {
            let side = Side::BOTH.into_iter().find(|side| !measurement.feet[side.index()].is_finite())?;
            Some(Sensor::Foot(side))
        });
    let is_unit = (measurement.orientation.norm() - 1.0).abs() < NORM_TOLERANCE;
    let not_finite = not_finite
        .or_else(|| (!is_unit).then_some(Sensor::Orientation))
        .or_else(|| measurement.angular_rate.iter().any(|rate| !rate.is_finite()).then_some(Sensor::AngularRate));
    match not_finite {
        Some(sensor) => Err(Rejection { fault: Fault::MeasurementNotFinite, sensor }),
        None => Ok(UnitQuaternion::new_normalize(measurement.orientation).inverse() * Vector3::z()),
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
        }
    }

    /// At 6 rad/s the trunk is tilted beyond 40° after 0.12 s; the robot counts as fallen 50 ms later.
    #[test]
    fn a_tilt_that_lasts_is_a_fall() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        let mut fallen_at = None;
        for tick in 0..200 {
            let time = tick as f64 * 1e-3;
            assert!(validator.update(Some(&turned(tick, 6.0 * time, 6.0)), None, 1e-3, &mut faults).is_some());
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
            assert_eq!(validator.update(Some(&measurement), None, 1e-3, &mut faults).is_some(), !jumps, "tick {tick}");
            assert_eq!(faults.contains(Fault::MeasurementImplausible), jumps, "tick {tick}");
            assert!(!validator.has_fallen());
        }
    }

    #[test]
    fn a_jump_of_the_angular_rate_is_implausible() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        assert!(validator.update(Some(&turned(0, 0.1, 0.0)), None, 1e-3, &mut faults).is_some());
        assert!(validator.update(Some(&turned(1, 0.1, 17.0)), None, 1e-3, &mut faults).is_none());
        assert!(faults.contains(Fault::MeasurementImplausible));
        assert!(validator.update(Some(&turned(2, 0.1, 0.1)), None, 1e-3, &mut faults).is_some());
    }

    /// A gap of 15 ms in a turn of 5 rad/s: 4.3° that the gyro explains.
    #[test]
    fn a_rotation_during_a_gap_is_plausible() {
        let (mut validator, mut faults) = (validator(), Faults::default());
        for tick in (0..10).chain(25..40) {
            let measurement = turned(tick, 0.8 - 5.0 * tick as f64 * 1e-3, -5.0);
            let dt = if tick == 25 { 0.016 } else { 1e-3 };
            assert!(validator.update(Some(&measurement), None, dt, &mut faults).is_some(), "tick {tick}");
        }
    }
}
