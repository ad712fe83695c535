//! Which sensor a value of a measurement comes from.

use std::fmt;

use model::{Joint, Side};

use crate::Fault;

/// A sensor, or all of them: the whole sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensor {
    /// The sample as a whole.
    All,
    /// The encoder of a joint.
    JointAngle(Joint),
    /// The rate of a joint.
    JointRate(Joint),
    /// The force–torque sensor of one foot.
    Foot(Side),
    /// The force–torque sensors of both feet.
    Feet,
    /// The orientation of the trunk.
    Orientation,
    /// The gyro of the trunk.
    AngularRate,
    /// The accelerometer of the trunk.
    Accelerometer,
}

/// Why a measurement was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// What is wrong with it.
    pub fault: Fault,
    /// The sensor whose values are wrong, as far as the others show.
    pub sensor: Sensor,
}

impl Sensor {
    /// Its number in messages: the kind of sensor times 256, plus the number of the joint (1 to 20) or of the foot (0
    /// right, 1 left, 255 both).
    pub const fn code(self) -> u32 {
        match self {
            Self::All => 0,
            Self::JointAngle(joint) => 0x100 | joint.number() as u32,
            Self::JointRate(joint) => 0x200 | joint.number() as u32,
            Self::Foot(side) => 0x300 | side.index() as u32,
            Self::Feet => 0x3ff,
            Self::Orientation => 0x400,
            Self::AngularRate => 0x500,
            Self::Accelerometer => 0x600,
        }
    }

    /// The sensor with a number; `None` if there is none.
    pub fn from_code(code: u32) -> Option<Self> {
        let joint = || Joint::from_number((code & 0xff) as u8);
        Some(match code {
            0 => Self::All,
            0x100..0x200 => Self::JointAngle(joint()?),
            0x200..0x300 => Self::JointRate(joint()?),
            0x300 | 0x301 => Self::Foot(Side::BOTH[(code & 1) as usize]),
            0x3ff => Self::Feet,
            0x400 => Self::Orientation,
            0x500 => Self::AngularRate,
            0x600 => Self::Accelerometer,
            _ => return None,
        })
    }
}

impl fmt::Display for Sensor {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let words = |joint: Joint| joint.name().split('_').collect::<Vec<_>>().join(" ");
        match self {
            Self::All => formatter.write_str("all sensors"),
            Self::JointAngle(joint) => write!(formatter, "angle of the {}", words(*joint)),
            Self::JointRate(joint) => write!(formatter, "rate of the {}", words(*joint)),
            Self::Foot(side) => write!(formatter, "force sensor of the {} foot", ["right", "left"][side.index()]),
            Self::Feet => formatter.write_str("force sensors of the feet"),
            Self::Orientation => formatter.write_str("orientation of the trunk"),
            Self::AngularRate => formatter.write_str("angular rate of the trunk"),
            Self::Accelerometer => formatter.write_str("accelerometer of the trunk"),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{}: {}", self.sensor, self.fault)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sensor_has_a_code_that_leads_back() {
        let joints = Joint::ALL.into_iter().flat_map(|joint| [Sensor::JointAngle(joint), Sensor::JointRate(joint)]);
        let others = [
            Sensor::All,
            Sensor::Foot(Side::Right),
            Sensor::Foot(Side::Left),
            Sensor::Feet,
            Sensor::Orientation,
            Sensor::AngularRate,
            Sensor::Accelerometer,
        ];
        for sensor in joints.chain(others) {
            assert_eq!(Sensor::from_code(sensor.code()), Some(sensor));
        }
        assert_eq!([0x100, 0x302, u32::MAX].map(Sensor::from_code), [None; 3]);
    }

    #[test]
    fn a_rejection_names_sensor_and_fault() {
        let rejection = Rejection { fault: Fault::MeasurementFrozen, sensor: Sensor::JointAngle(Joint::LeftKnee) };
        assert_eq!(rejection.to_string(), "angle of the left knee: a sensor's value has stopped changing");
    }
}
