//! Sensor faults, injected between the sensors and the controller.
//!
//! They act on samples after noise and delay, and draw no random numbers: the values that they do not affect keep their
//! bits.

use interface::{Measurement, SensorGroup, SensorGroups};
use model::{Joint, JointVector, PerJoint, Side, Wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::Sensors;

/// A fault of the sensors, and when it is active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorFault {
    /// Start of the fault since the plant's start, rounded to control periods (s).
    pub start: f64,
    /// Duration of the fault, rounded to control periods, at least one (s).
    pub duration: f64,
    /// The kind of fault.
    pub kind: SensorFaultKind,
}

/// A kind of sensor fault, with the values that it affects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFaultKind {
    /// Values stay as they were; sample numbers keep counting.
    Freeze(SensedValues),
    /// Values become NaN.
    NotANumber(SensedValues),
    /// Values are said to be missing, each with its whole group.
    Missing(SensedValues),
    /// Values are off by `size`, in their own unit (rad, rad/s, m/s², N, A): of feet the vertical force, of the
    /// orientation the rotation about the trunk's x axis.
    Spike {
        /// The values that are off.
        values: SensedValues,
        /// How much they are off (rad, rad/s, m/s², N, A).
        size: f64,
    },
    /// Values run away by `rate` per second, as of a spike that grows.
    Drift {
        /// The values that run away.
        values: SensedValues,
        /// How fast (rad/s, rad/s², m/s³, N/s, A/s).
        rate: f64,
    },
    /// Values stop at ±`limit`, as of a sensor at the end of its range: of feet the vertical force, of the orientation
    /// the rotation vector from level.
    Saturate {
        /// The values that are limited.
        values: SensedValues,
        /// The end of the range (rad, rad/s, m/s², N, A).
        limit: f64,
    },
    /// Values have the opposite sign: of feet the vertical force, of the orientation the inverse rotation.
    Reverse(SensedValues),
    /// Values of the right and of the left side are exchanged, those of feet and joints alike.
    Swap(SensedValues),
    /// Only every second sample arrives; the one before is repeated, with its number.
    HalfRate,
    /// No new sample arrives: the last one is repeated, with its number.
    DropOut,
    /// Samples arrive this many control periods later than usual, 1 to [`Sensors::DELAY_MAX`], in order: at first none
    /// arrives, then late ones, and after the fault all that are underway arrive at once.
    Delay(u32),
}

/// A group of a measurement's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensedValues {
    /// All values.
    All,
    /// The angle of one joint, or of all.
    Angles(Option<Joint>),
    /// The rate of one joint, or of all.
    Rates(Option<Joint>),
    /// The motor current of one joint, or of all.
    Currents(Option<Joint>),
    /// Force and moment on one foot, or on both.
    Feet(Option<Side>),
    /// Orientation of the trunk.
    Orientation,
    /// Angular rate of the trunk.
    AngularRate,
    /// Specific force at the trunk.
    SpecificForce,
}

impl SensorFault {
    /// Whether the fault is active in control period `tick`; `period` is its length (s).
    fn is_active(&self, tick: u64, period: f64) -> bool {
        let periods = |time: f64| (time / period).round() as u64;
        let first = periods(self.start);
        tick >= first && tick - first < periods(self.duration).max(1)
    }

    /// Time since its start in control period `tick` (s).
    fn age(&self, tick: u64, period: f64) -> f64 {
        (tick as f64 * period - self.start).max(0.0)
    }
}

/// Applies the active faults to the samples on their way to the controller.
#[derive(Clone, Debug, Default)]
pub(crate) struct FaultInjector {
    /// The last samples of the sensors, oldest first.
    sent: heapless::Deque<Measurement, { Sensors::DELAY_MAX + 1 }>,
    /// The sample that arrived last.
    last: Option<Measurement>,
}

impl FaultInjector {
    /// The sample that arrives at the controller in the control period in which the sensors send `sent`; `period` is
    /// its length (s).
    pub(crate) fn receive(&mut self, sent: Measurement, faults: &[SensorFault], period: f64) -> Measurement {
        if self.sent.is_full() {
            self.sent.pop_front();
        }
        // There is room now.
        let _ = self.sent.push_back(sent);
        let active = || faults.iter().filter(|fault| fault.is_active(sent.sample, period));
        let kinds = || active().map(|fault| fault.kind);

        // Later ...
        let late = kinds().filter_map(|kind| if let SensorFaultKind::Delay(late) = kind { Some(late) } else { None });
        let late = late.max().unwrap_or(0) as usize;
        let mut arrives = self.sent.iter().nth_back(late).or(self.sent.front()).copied().unwrap_or(sent);
        let last = self.last.unwrap_or(arrives);
        if arrives.sample < last.sample {
            arrives = last;
        }
        // ... with wrong values ...
        for fault in active() {
            let (values, wrong) = match fault.kind {
                SensorFaultKind::Freeze(values) => (values, last),
                SensorFaultKind::NotANumber(values) => (values, not_a_number()),
                SensorFaultKind::Missing(values) => {
                    values.groups().for_each(|group| arrives.missing.insert(group));
                    (values, not_a_number())
                }
                SensorFaultKind::Spike { values, size } => (values, displaced(&arrives, size)),
                SensorFaultKind::Drift { values, rate } => {
                    (values, displaced(&arrives, rate * fault.age(sent.sample, period)))
                }
                SensorFaultKind::Saturate { values, limit } => {
                    (values, per_value(&arrives, |value| value.clamp(-limit.abs(), limit.abs())))
                }
                SensorFaultKind::Reverse(values) => (values, per_value(&arrives, |value| -value)),
                SensorFaultKind::Swap(values) => (values, swapped(&arrives)),
                SensorFaultKind::DropOut | SensorFaultKind::Delay(_) | SensorFaultKind::HalfRate => continue,
            };
            values.take(&mut arrives, &wrong);
        }
        // ... or not at all.
        let is_lost = |kind| match kind {
            SensorFaultKind::DropOut => true,
            SensorFaultKind::HalfRate => sent.sample % 2 == 1,
            _ => false,
        };
        if kinds().any(is_lost) {
            arrives = last;
        }
        self.last = Some(arrives);
        arrives
    }
}

impl SensedValues {
    /// Replaces these values of a sample by those of another one.
    fn take(self, sample: &mut Measurement, other: &Measurement) {
        fn of_joints(joint: Option<Joint>, values: &mut JointVector, other: &JointVector) {
            match joint {
                Some(joint) => values[joint] = other[joint],
                None => *values = *other,
            }
        }
        match self {
            Self::All => *sample = Measurement { sample: sample.sample, missing: sample.missing, ..*other },
            Self::Angles(joint) => of_joints(joint, &mut sample.angles, &other.angles),
            Self::Rates(joint) => of_joints(joint, &mut sample.rates, &other.rates),
            Self::Currents(joint) => of_joints(joint, &mut sample.currents, &other.currents),
            Self::Feet(Some(side)) => sample.feet[side.index()] = other.feet[side.index()],
            Self::Feet(None) => sample.feet = other.feet,
            Self::Orientation => sample.orientation = other.orientation,
            Self::AngularRate => sample.angular_rate = other.angular_rate,
            Self::SpecificForce => sample.specific_force = other.specific_force,
        }
    }

    /// The groups of a measurement to which these values belong.
    fn groups(self) -> impl Iterator<Item = SensorGroup> {
        SensorGroup::ALL.iter().copied().filter(move |group| match self {
            Self::All => true,
            Self::Angles(_) | Self::Rates(_) => *group == SensorGroup::Joints,
            Self::Currents(_) => false,
            Self::Feet(None) => matches!(group, SensorGroup::RightFoot | SensorGroup::LeftFoot),
            Self::Feet(Some(side)) => *group == SensorGroup::of_foot(side),
            Self::Orientation => *group == SensorGroup::Orientation,
            Self::AngularRate => *group == SensorGroup::AngularRate,
            Self::SpecificForce => *group == SensorGroup::SpecificForce,
        })
    }
}

/// A measurement whose values are all NaN.
fn not_a_number() -> Measurement {
    let joints = PerJoint([f64::NAN; Joint::COUNT]);
    let vector = Vector3::repeat(f64::NAN);
    Measurement {
        sample: 0,
        angles: joints,
        rates: joints,
        feet: [Wrench { force: vector, moment: vector }; 2],
        orientation: Quaternion::from_parts(f64::NAN, vector),
        angular_rate: vector,
        currents: joints,
        specific_force: vector,
        missing: SensorGroups::NONE,
    }
}

/// A measurement whose values are all off by `size`, in their own units.
fn displaced(sample: &Measurement, size: f64) -> Measurement {
    let joints = |values: &JointVector| PerJoint(values.0.map(|value| value + size));
    Measurement {
        sample: sample.sample,
        angles: joints(&sample.angles),
        rates: joints(&sample.rates),
        feet: sample.feet.map(|foot| Wrench { force: foot.force + Vector3::z() * size, ..foot }),
        orientation: sample.orientation * UnitQuaternion::from_scaled_axis(Vector3::x() * size).into_inner(),
        angular_rate: sample.angular_rate.add_scalar(size),
        currents: joints(&sample.currents),
        specific_force: sample.specific_force.add_scalar(size),
        missing: sample.missing,
    }
}

/// A measurement with every value changed by `change`: of feet the vertical force, of the orientation its rotation
/// vector.
fn per_value(sample: &Measurement, change: impl Fn(f64) -> f64) -> Measurement {
    let joints = |values: &JointVector| PerJoint(values.0.map(&change));
    let rotation = UnitQuaternion::new_normalize(sample.orientation).scaled_axis();
    Measurement {
        sample: sample.sample,
        angles: joints(&sample.angles),
        rates: joints(&sample.rates),
        feet: sample.feet.map(|foot| {
            let vertical = change(foot.force.z);
            Wrench { force: Vector3::new(foot.force.x, foot.force.y, vertical), ..foot }
        }),
        orientation: UnitQuaternion::from_scaled_axis(rotation.map(&change)).into_inner(),
        angular_rate: sample.angular_rate.map(&change),
        currents: joints(&sample.currents),
        specific_force: sample.specific_force.map(&change),
        missing: sample.missing,
    }
}

/// A measurement with right and left exchanged.
fn swapped(sample: &Measurement) -> Measurement {
    let joints = |values: &JointVector| PerJoint::from_fn(|joint| values[model::partner(joint)]);
    let [right, left] = sample.feet;
    Measurement {
        sample: sample.sample,
        angles: joints(&sample.angles),
        rates: joints(&sample.rates),
        feet: [left, right],
        orientation: sample.orientation,
        angular_rate: sample.angular_rate,
        currents: joints(&sample.currents),
        specific_force: sample.specific_force,
        missing: sample.missing,
    }
}
