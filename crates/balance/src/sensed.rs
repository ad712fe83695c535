//! What the robot senses, told in support coordinates.

use dynamics::Kinematics;
use model::{Joint, JointVector, Mirror, Side, Wrench};
use nalgebra::Vector3;

/// Where the inertial measurement unit is.
pub(crate) const TRUNK: Joint = Joint::WaistRoll;

/// A measurement as seen from the bearing foot; on the left foot everything is mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Joint angles [rad]; the bearing leg's are joints 3 to 8.
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Of the ground on the bearing foot, about its sole's origin in sole axes.
    pub bearing_foot: Wrench,
    /// Of the ground on the swinging foot, about its sole's origin in sole axes.
    pub swinging_foot: Wrench,
    /// The vertical, in the trunk's axes.
    pub up_in_trunk: Vector3<f64>,
    /// Angular rate of the trunk, in its own axes [rad/s].
    pub trunk_rate: Vector3<f64>,
}

impl Sensed {
    /// The vertical over the bearing sole, in its axes: joints may give way, and soles tip or stand on a slope.
    pub fn up_over_sole(&self, kinematics: &Kinematics) -> Vector3<f64> {
        kinematics.rotation[TRUNK] * self.up_in_trunk
    }

    /// Tells physical quantities as seen from the foot on `support`.
    ///
    /// * `feet` – wrenches on the right and on the left foot, in sole axes
    pub fn from_support(
        support: Side,
        mirror: &Mirror,
        angles: &JointVector,
        rates: &JointVector,
        feet: &[Wrench; 2],
        up_in_trunk: Vector3<f64>,
        trunk_rate: Vector3<f64>,
    ) -> Self {
        let (mut angles, mut rates) = (*angles, *rates);
        for joint in [Joint::FootRoll, Joint::FootPitch] {
            angles[joint] = 0.0;
            rates[joint] = 0.0;
        }
        match support {
            Side::Right => {
                Self { angles, rates, bearing_foot: feet[0], swinging_foot: feet[1], up_in_trunk, trunk_rate }
            }
            Side::Left => Self {
                angles: mirror.apply(&angles),
                rates: mirror.apply(&rates),
                bearing_foot: feet[1].mirrored(),
                swinging_foot: feet[0].mirrored(),
                up_in_trunk: Vector3::new(up_in_trunk.x, -up_in_trunk.y, up_in_trunk.z),
                trunk_rate: Vector3::new(-trunk_rate.x, trunk_rate.y, -trunk_rate.z),
            },
        }
    }
}
