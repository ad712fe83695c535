//! Values that stay the same to the bit although the robot moves.

use interface::{Fault, Measurement, Sensor};
use model::{Joint, JointVector, PerJoint, Side};

use crate::rejected_sensors::RejectedSensors;

/// Longest time for which values may stay the same while the robot moves (s).
const FROZEN_MAX: f64 = 0.02;
/// Samples in a row that must differ before a value is known to change with every sample.
const NOISY_AFTER: u32 = 100;
/// Commanded rate above which a joint moves (rad/s).
const MOVING: f64 = 0.2;
/// Share of the weight above which a foot is loaded, so that its force changes (-).
const LOADED: f64 = 0.07;

/// Finds values that have stopped changing. At rest nothing is suspected: nothing is lost by it.
///
/// * The angle of a joint must change while the joint is commanded to move.
/// * A joint rate, the wrench of a foot, the orientation, and the angular rate must change while any joint moves, if
///   they changed with every sample before: a sensor without noise may well repeat a value.
#[derive(Clone, Debug, Default)]
pub(super) struct FrozenValues {
    angles: PerJoint<Repetition>,
    rates: PerJoint<Repetition>,
    feet: [Repetition; 2],
    orientation: Repetition,
    angular_rate: Repetition,
}

/// How often a value repeats itself.
#[derive(Clone, Copy, Debug, Default)]
struct Repetition {
    /// How long it has stayed the same although it had to change (s).
    repeated: f64,
    /// Samples in a row in which it has changed.
    changed: u32,
    /// Whether it is known to change with every sample.
    is_noisy: bool,
}

impl FrozenValues {
    /// Absorbs a sample, and rejects the sensors that are frozen.
    ///
    /// * `last` – the sample before
    /// * `commanded` – joint rates (rad/s)
    /// * `weight` – of the robot (N)
    pub(super) fn update(
        &mut self,
        sample: &Measurement,
        last: &Measurement,
        commanded: &JointVector,
        weight: f64,
        dt: f64,
        rejected: &mut RejectedSensors,
    ) {
        let moves = |joint: Joint| commanded[joint].abs() > MOVING;
        let is_moving = Joint::ALL.into_iter().any(moves);
        let mut suspect = |is_frozen: bool, sensor: Sensor| {
            if is_frozen {
                rejected.insert(Fault::MeasurementFrozen, sensor);
            }
        };
        for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
            let is_same = sample.angles[joint] == last.angles[joint];
            suspect(self.angles[joint].repeats(is_same && moves(joint), dt), Sensor::JointAngle(joint));
            let is_same = sample.rates[joint] == last.rates[joint];
            suspect(self.rates[joint].is_frozen(is_same, is_moving, dt), Sensor::JointRate(joint));
        }
        for side in Side::BOTH {
            let (foot, before) = (&sample.feet[side.index()], &last.feet[side.index()]);
            let is_loaded = foot.force.z.abs() > LOADED * weight;
            suspect(self.feet[side.index()].is_frozen(foot == before, is_moving && is_loaded, dt), Sensor::Foot(side));
        }
        let is_same = sample.orientation == last.orientation;
        suspect(self.orientation.is_frozen(is_same, is_moving, dt), Sensor::Orientation);
        let is_same = sample.angular_rate == last.angular_rate;
        suspect(self.angular_rate.is_frozen(is_same, is_moving, dt), Sensor::AngularRate);
    }
}

impl Repetition {
    /// Counts a sample of a value that must change if it is known to be noisy; whether it is frozen.
    fn is_frozen(&mut self, is_same: bool, must_change: bool, dt: f64) -> bool {
        self.changed = if is_same { 0 } else { self.changed.saturating_add(1) };
        self.is_noisy |= self.changed >= NOISY_AFTER;
        self.repeats(is_same && must_change && self.is_noisy, dt)
    }

    /// Counts a sample; whether the value has repeated itself for too long.
    fn repeats(&mut self, is_repeated: bool, dt: f64) -> bool {
        self.repeated = if is_repeated { self.repeated + dt } else { 0.0 };
        self.repeated > FROZEN_MAX
    }
}
