//! Watches the measurements: what is stale, out of order, no number or absurd does not get through.

use model::{GRAVITY, JointLimits, Mechanism, PerJoint};
use nalgebra::Vector3;

use crate::{Fault, Faults, Measurement, WatchParameters};

/// How far beyond its range a joint may be told to be [rad]: stops give way, encoders are mounted by hand.
const ANGLE_SLACK: f64 = 0.5;
/// How many times faster than its limit a joint may be told to move.
const RATE_SLACK: f64 = 5.0;
/// Largest rate of the trunk [rad/s].
const TRUNK_RATE_MAX: f64 = 50.0;
/// Largest force on a foot, in weights of the robot; moments likewise, at an arm of a metre.
const WEIGHTS_MAX: f64 = 50.0;

/// How far an orientation may be off where the gyro takes the last one [rad]: 10°, much more than any noise.
const JUMP_MAX: f64 = 0.175;
/// How far an angular rate may be off the last one [rad/s]: no push turns a trunk so suddenly.
const RATE_JUMP_MAX: f64 = 5.0;
/// How long two samples of the gyro say what was between them [s].
const GYRO_TRUSTED: f64 = 0.25;
/// How long the trunk must tilt beyond recovery before the robot counts as fallen [s]: no fall ends sooner.
const TILT_LASTS: f64 = 0.05;

/// Remembers how long ago a measurement was good.
#[derive(Clone, Debug)]
pub struct Watch {
    parameters: WatchParameters,
    limits: PerJoint<Option<JointLimits>>,
    force_max: f64,
    newest: Option<u64>,
    silence: f64,
    /// The vertical and the angular rate in the trunk's axes when last good [-, rad/s].
    trunk: Option<[Vector3<f64>; 2]>,
    /// How long the trunk has been tilting beyond recovery [s].
    tilted: f64,
}

impl Watch {
    /// Nothing seen yet; the allowed silence begins now.
    pub fn new(mechanism: &Mechanism, parameters: WatchParameters) -> Self {
        Self {
            parameters,
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            force_max: WEIGHTS_MAX * mechanism.mass() * GRAVITY,
            newest: None,
            silence: 0.0,
            trunk: None,
            tilted: 0.0,
        }
    }

    /// Absorbs what came within the last `dt` seconds and lets a good measurement through, with the vertical in its
    /// trunk's axes.
    pub fn update<'m>(
        &mut self,
        measurement: Option<&'m Measurement>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<(&'m Measurement, Vector3<f64>)> {
        self.silence += dt;
        let good = measurement.and_then(|measurement| match measurement.up_in_trunk() {
            // After a long silence a plant that counts from the start again is a new one.
            _ if !self.is_stale() && self.newest.is_some_and(|newest| measurement.tick < newest) => {
                faults.insert(Fault::MeasurementOutOfOrder);
                None
            }
            // The same sample again is no news, but no fault either: the two processes' periods drift.
            _ if self.newest == Some(measurement.tick) => None,
            Some(up) if self.is_absurd(measurement) || self.contradicts_gyro(&up, &measurement.angular_rate) => {
                faults.insert(Fault::MeasurementAbsurd);
                None
            }
            Some(up) => Some((measurement, up)),
            None => {
                faults.insert(Fault::MeasurementNotFinite);
                None
            }
        });
        if let Some((measurement, up)) = good {
            let is_tilted = up.z < self.parameters.tilt_max.cos();
            self.tilted = if is_tilted { self.tilted + self.silence } else { 0.0 };
            self.trunk = Some([up, measurement.angular_rate]);
            self.newest = Some(measurement.tick);
            self.silence = 0.0;
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        good
    }

    /// Whether some value is one that no working sensor of this robot gives.
    fn is_absurd(&self, measurement: &Measurement) -> bool {
        let joints = self.limits.iter().filter_map(|(joint, limits)| limits.map(|limits| (joint, limits)));
        let joints_absurd = joints.into_iter().any(|(joint, limits)| {
            measurement.angles[joint] < limits.angle_min - ANGLE_SLACK
                || measurement.angles[joint] > limits.angle_max + ANGLE_SLACK
                || measurement.rates[joint].abs() > RATE_SLACK * limits.rate_max
        });
        let feet_absurd =
            measurement.feet.iter().any(|foot| foot.force.amax().max(foot.moment.amax()) > self.force_max);
        joints_absurd || feet_absurd || measurement.angular_rate.amax() > TRUNK_RATE_MAX
    }

    /// Whether nothing good came for longer than allowed.
    pub fn is_stale(&self) -> bool {
        self.silence > self.parameters.silence_max
    }

    /// Whether the angular rate jumps, or the vertical is not where the last one turns to at the rates of both samples
    /// (`u̇ = u × ω` in axes of the trunk). After a long silence nothing is known to contradict.
    fn contradicts_gyro(&self, up: &Vector3<f64>, rate: &Vector3<f64>) -> bool {
        self.trunk.filter(|_| self.silence < GYRO_TRUSTED).is_some_and(|[last_up, last_rate]| {
            let expected = last_up + last_up.cross(&((last_rate + rate) * (self.silence / 2.0)));
            up.dot(&expected.normalize()) < JUMP_MAX.cos() || (rate - last_rate).amax() > RATE_JUMP_MAX
        })
    }

    /// Whether the trunk was within recovery when last heard of.
    pub fn is_upright(&self) -> bool {
        self.tilted == 0.0
    }

    /// Whether the trunk has been tilting beyond recovery for a while.
    pub fn has_fallen(&self) -> bool {
        self.tilted > TILT_LASTS
    }
}

#[cfg(test)]
mod tests {
    use model::{JointVector, Wrench};
    use nalgebra::UnitQuaternion;

    use super::*;

    fn watch() -> Watch {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        Watch::new(&mechanism, WatchParameters { silence_max: 0.02, tilt_max: 40_f64.to_radians() })
    }

    /// A trunk turned about an axis that is not x, y or z, at a rate [rad, rad/s].
    fn turned(tick: u64, angle: f64, rate: f64) -> Measurement {
        let axis = nalgebra::Unit::new_normalize(Vector3::new(0.8, -0.6, 0.1));
        Measurement {
            tick,
            angles: JointVector::ZERO,
            rates: JointVector::ZERO,
            feet: [Wrench::ZERO; 2],
            orientation: UnitQuaternion::from_axis_angle(&axis, angle).into_inner(),
            angular_rate: axis.into_inner() * rate,
        }
    }

    /// At 6 rad/s the trunk is tilted beyond 40° after 0.12 s; the robot counts as fallen 50 ms later.
    #[test]
    fn a_fall_is_believed_when_it_lasts() {
        let (mut watch, mut faults) = (watch(), Faults::default());
        let mut fallen_at = None;
        for tick in 0..200 {
            let time = tick as f64 * 1e-3;
            assert!(watch.update(Some(&turned(tick, 6.0 * time, 6.0)), 1e-3, &mut faults).is_some());
            fallen_at = fallen_at.or(watch.has_fallen().then_some(time));
        }
        assert!((0.16..0.18).contains(&fallen_at.unwrap()), "{fallen_at:?}");
        assert_eq!(faults, Faults::default());
    }

    #[test]
    fn a_jump_that_the_gyro_did_not_see_is_absurd() {
        let mut watch = watch();
        for tick in 0..100 {
            let jumps = (50..60).contains(&tick);
            let mut faults = Faults::default();
            let measurement = turned(tick, if jumps { 1.57 } else { 0.1 }, 0.0);
            assert_eq!(watch.update(Some(&measurement), 1e-3, &mut faults).is_some(), !jumps, "tick {tick}");
            assert_eq!(faults.contains(Fault::MeasurementAbsurd), jumps, "tick {tick}");
            assert!(!watch.has_fallen());
        }
    }

    #[test]
    fn a_jump_of_the_gyro_is_absurd() {
        let (mut watch, mut faults) = (watch(), Faults::default());
        assert!(watch.update(Some(&turned(0, 0.1, 0.0)), 1e-3, &mut faults).is_some());
        assert!(watch.update(Some(&turned(1, 0.1, 17.0)), 1e-3, &mut faults).is_none());
        assert!(faults.contains(Fault::MeasurementAbsurd));
        assert!(watch.update(Some(&turned(2, 0.1, 0.1)), 1e-3, &mut faults).is_some());
    }

    /// A gap of 15 ms in a turn of 5 rad/s: 4.3° that the gyro explains.
    #[test]
    fn a_turn_during_a_gap_is_no_jump() {
        let (mut watch, mut faults) = (watch(), Faults::default());
        for tick in (0..10).chain(25..40) {
            let measurement = turned(tick, 0.8 - 5.0 * tick as f64 * 1e-3, -5.0);
            let dt = if tick == 25 { 0.016 } else { 1e-3 };
            assert!(watch.update(Some(&measurement), dt, &mut faults).is_some(), "tick {tick}");
        }
    }
}
