//! Sensors that fail: faults injected between the sensors and the controller.
//!
//! They act on what arrives, after noise and delay, and draw nothing: whatever they do not touch keeps its bits.

use model::{Joint, JointVector, PerJoint, Side, Wrench};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::{Measurement, Sensors};

/// What goes wrong with the sensors, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorFault {
    /// Since the plant's start, rounded to control periods [s].
    pub start: f64,
    /// Rounded to control periods, at least one [s].
    pub duration: f64,
    /// What goes wrong.
    pub kind: SensorFaultKind,
}

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFaultKind {
    /// Values stay as they were; samples go on being counted.
    Freeze(SensedValues),
    /// Values are NaN.
    NotANumber(SensedValues),
    /// Values are off by `size` [rad, rad/s, N or A, as they are]. Of feet the vertical force is; the orientation is
    /// turned about the trunk's x axis.
    Spike {
        /// Which ones.
        values: SensedValues,
        /// By how much.
        size: f64,
    },
    /// No new sample arrives: the last one stays, with its number.
    DropOut,
    /// Samples arrive so many control periods later than usual, 1 to [`Sensors::DELAY_MAX`], in order: first none for as
    /// long, then late ones, in the end all that were underway at once.
    Delay(u32),
}

/// Some of a measurement's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensedValues {
    /// Every one.
    All,
    /// Of one joint, or of all.
    Angles(Option<Joint>),
    /// Of one joint, or of all.
    Rates(Option<Joint>),
    /// Of one joint, or of all.
    Currents(Option<Joint>),
    /// Force and moment on one foot, or on both.
    Feet(Option<Side>),
    /// Of the trunk.
    Orientation,
    /// Of the trunk.
    AngularRate,
}

impl SensorFault {
    /// Whether it is there in a control period of a length [s].
    fn is_active(&self, tick: u64, period: f64) -> bool {
        let periods = |time: f64| (time / period).round() as u64;
        let first = periods(self.start);
        tick >= first && tick - first < periods(self.duration).max(1)
    }
}

/// What arrives at the controller.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arrival {
    /// What the sensors sent, oldest first.
    sent: heapless::Deque<Measurement, { Sensors::DELAY_MAX + 1 }>,
    /// What arrived last.
    last: Option<Measurement>,
}

impl Arrival {
    /// What arrives of the sample that the sensors send in its control period.
    pub fn receive(&mut self, sent: Measurement, faults: &[SensorFault], period: f64) -> Measurement {
        if self.sent.is_full() {
            self.sent.pop_front();
        }
        // There is a place now.
        let _ = self.sent.push_back(sent);
        let active = || faults.iter().filter(|fault| fault.is_active(sent.sample, period)).map(|fault| fault.kind);

        // Later ...
        let late = active().filter_map(|kind| if let SensorFaultKind::Delay(late) = kind { Some(late) } else { None });
        let late = late.max().unwrap_or(0) as usize;
        let mut arrives = self.sent.iter().nth_back(late).or(self.sent.front()).copied().unwrap_or(sent);
        let last = self.last.unwrap_or(arrives);
        if arrives.sample < last.sample {
            arrives = last;
        }
        // ... with wrong values ...
        for kind in active() {
            match kind {
                SensorFaultKind::Freeze(values) => values.take(&mut arrives, &last),
                SensorFaultKind::NotANumber(values) => values.take(&mut arrives, &not_a_number()),
                SensorFaultKind::Spike { values, size } => {
                    let off = displaced(&arrives, size);
                    values.take(&mut arrives, &off);
                }
                SensorFaultKind::DropOut | SensorFaultKind::Delay(_) => {}
            }
        }
        // ... or not at all.
        if active().any(|kind| kind == SensorFaultKind::DropOut) {
            arrives = last;
        }
        self.last = Some(arrives);
        arrives
    }
}

impl SensedValues {
    /// Replaces these values of a sample by another one's.
    fn take(self, sample: &mut Measurement, other: &Measurement) {
        fn of_joints(joint: Option<Joint>, values: &mut JointVector, other: &JointVector) {
            match joint {
                Some(joint) => values[joint] = other[joint],
                None => *values = *other,
            }
        }
        match self {
            Self::All => *sample = Measurement { sample: sample.sample, ..*other },
            Self::Angles(joint) => of_joints(joint, &mut sample.angles, &other.angles),
            Self::Rates(joint) => of_joints(joint, &mut sample.rates, &other.rates),
            Self::Currents(joint) => of_joints(joint, &mut sample.currents, &other.currents),
            Self::Feet(Some(side)) => sample.feet[side.index()] = other.feet[side.index()],
            Self::Feet(None) => sample.feet = other.feet,
            Self::Orientation => sample.orientation = other.orientation,
            Self::AngularRate => sample.angular_rate = other.angular_rate,
        }
    }
}

/// A measurement with nothing in it.
fn not_a_number() -> Measurement {
    let joints = PerJoint([f64::NAN; Joint::COUNT]);
    let vector = Vector3::repeat(f64::NAN);
    Measurement {
        sample: 0,
        angles: joints,
        rates: joints,
        feet: [Wrench { force: vector, moment: vector }; 2],
        orientation: UnitQuaternion::new_unchecked(Quaternion::from_parts(f64::NAN, vector)),
        angular_rate: vector,
        currents: joints,
    }
}

/// A measurement of which everything is off by `size`.
fn displaced(sample: &Measurement, size: f64) -> Measurement {
    let joints = |values: &JointVector| PerJoint(values.0.map(|value| value + size));
    Measurement {
        sample: sample.sample,
        angles: joints(&sample.angles),
        rates: joints(&sample.rates),
        feet: sample.feet.map(|foot| Wrench { force: foot.force + Vector3::z() * size, ..foot }),
        orientation: sample.orientation * UnitQuaternion::from_scaled_axis(Vector3::x() * size),
        angular_rate: sample.angular_rate.add_scalar(size),
        currents: joints(&sample.currents),
    }
}
