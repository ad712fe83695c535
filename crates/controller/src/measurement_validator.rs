//! The measurement validator: rejects measurements that are stale, out of order, not finite, implausible, or
//! inconsistent with each other and with the setpoint.

use interface::{Fault, Faults, Measurement, Setpoint};
use model::{GRAVITY, JointLimits, Mechanism, PerJoint, Wrench};
use nalgebra::{UnitQuaternion, Vector3};

use crate::sensor_consistency::{ConsistencyParameters, Inconsistency, SensorConsistency};

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
            consistency: ConsistencyParameters { orientation_error_max: 0.012, tracking_error_max: 0.15 },
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
}

impl MeasurementValidator {
    /// A validator that has seen no measurement; the timeout begins now.
    pub fn new(mechanism: &Mechanism, parameters: ValidatorParameters) -> Self {
        Self {
            parameters,
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            force_max: parameters.load_factor_max * mechanism.mass() * GRAVITY,
            newest: None,
            age: 0.0,
            trunk: None,
            trunk_age: 0.0,
            tilted: 0.0,
            consistency: SensorConsistency::new(parameters.consistency),
            unchecked: 0.0,
        }
    }

    /// Absorbs what arrived within the last `dt` seconds; a valid measurement is returned with the vertical (unit
    /// vector) in its trunk's axes.
    ///
    /// * `setpoint` – the last one, if the robot is to follow it: then measurements must be consistent with it and with
    ///   each other
    pub fn update<'m>(
        &mut self,
        measurement: Option<&'m Measurement>,
        setpoint: Option<&Setpoint>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<(&'m Measurement, Vector3<f64>)> {
        self.age += dt;
        self.trunk_age += dt;
        self.unchecked += dt;
        let plausible = measurement.and_then(|measurement| match up_in_trunk(measurement) {
            // After the timeout, a plant that counts from the start again is a new one.
            _ if !self.is_stale() && self.newest.is_some_and(|newest| measurement.sample < newest) => {
                faults.insert(Fault::MeasurementOutOfOrder);
                None
            }
            // The same sample again adds nothing, but is no fault: the periods of the two processes drift.
            _ if self.newest == Some(measurement.sample) => None,
            Some(up) if self.is_implausible(measurement) || self.contradicts_gyro(&up, &measurement.angular_rate) => {
                faults.insert(Fault::MeasurementImplausible);
                None
            }
            Some(up) => Some((measurement, up)),
            None => {
                faults.insert(Fault::MeasurementNotFinite);
                None
            }
        });
        let mut valid = None;
        if let Some((measurement, up)) = plausible {
            let inconsistency = self.inconsistency(measurement, &up, setpoint);
            if inconsistency != Some(Inconsistency::Orientation) {
                let is_tilted = up.z < self.parameters.tilt_max.cos();
                self.tilted = if is_tilted { self.tilted + self.trunk_age } else { 0.0 };
                self.trunk = Some([up, measurement.angular_rate]);
                self.trunk_age = 0.0;
            }
            self.newest = Some(measurement.sample);
            if inconsistency.is_none() {
                self.age = 0.0;
                valid = Some((measurement, up));
            } else {
                faults.insert(Fault::MeasurementImplausible);
            }
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        valid
    }

    /// What of a plausible sample contradicts other values or the setpoint.
    fn inconsistency(
        &mut self,
        measurement: &Measurement,
        up: &Vector3<f64>,
        setpoint: Option<&Setpoint>,
    ) -> Option<Inconsistency> {
        let dt = std::mem::take(&mut self.unchecked);
        if setpoint.is_none() || dt >= self.parameters.gyro_horizon {
            self.consistency.reset();
        }
        self.consistency.update(measurement, up, setpoint?, dt)
    }

    /// Whether some value is one that no working sensor of this robot produces.
    fn is_implausible(&self, measurement: &Measurement) -> bool {
        let ValidatorParameters { angle_tolerance, rate_factor_max, trunk_rate_max, .. } = self.parameters;
        let limited = self.limits.iter().filter_map(|(joint, limits)| limits.map(|limits| (joint, limits)));
        let joints = limited.into_iter().any(|(joint, limits)| {
            measurement.angles[joint] < limits.angle_min - angle_tolerance
                || measurement.angles[joint] > limits.angle_max + angle_tolerance
                || measurement.rates[joint].abs() > rate_factor_max * limits.rate_max
        });
        let feet = measurement.feet.iter().any(|foot| foot.force.amax().max(foot.moment.amax()) > self.force_max);
        joints || feet || measurement.angular_rate.amax() > trunk_rate_max
    }

    /// Whether no valid measurement has arrived for longer than the timeout.
    pub fn is_stale(&self) -> bool {
        self.age > self.parameters.timeout
    }

    /// Whether the angular rate jumps, or the vertical is not where the last one turns to at the mean rate of both
    /// samples (`u̇ = u × ω` in trunk axes). After a gap beyond the gyro's horizon nothing can contradict.
    fn contradicts_gyro(&self, up: &Vector3<f64>, rate: &Vector3<f64>) -> bool {
        let ValidatorParameters { orientation_jump_max, trunk_rate_jump_max, gyro_horizon, .. } = self.parameters;
        self.trunk.filter(|_| self.trunk_age < gyro_horizon).is_some_and(|[last_up, last_rate]| {
            let expected = last_up + last_up.cross(&((last_rate + rate) * (self.trunk_age / 2.0)));
            up.dot(&expected.normalize()) < orientation_jump_max.cos()
                || (rate - last_rate).amax() > trunk_rate_jump_max
        })
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
fn up_in_trunk(measurement: &Measurement) -> Option<Vector3<f64>> {
    let finite = measurement.angles.is_finite()
        && measurement.rates.is_finite()
        && measurement.feet.iter().all(Wrench::is_finite)
        && measurement.angular_rate.iter().all(|rate| rate.is_finite());
    let is_unit = (measurement.orientation.norm() - 1.0).abs() < NORM_TOLERANCE;
    (finite && is_unit).then(|| UnitQuaternion::new_normalize(measurement.orientation).inverse() * Vector3::z())
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
            feet: [Wrench::ZERO; 2],
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
