//! Where the walk is: dead reckoning over the soles that bear, with the heading of the inertial measurement unit.
//!
//! A sole that bears stands still. The next one is where the measured joints put it when it takes over. Headings would
//! drift by the slip of every turn; the inertial measurement unit tells them without.

use dynamics::{Kinematics, arc_between, atan2, pose_seen_from, poses_in_frame_of, sin_cos};
use interface::{Odometry, WalkPose, WalkVelocity};
use model::{Joint, Mechanism, Side};
use nalgebra::{Quaternion, Vector2, Vector3};

/// Time constant with which the heading of the support sole follows the measured one (s): shorter than a half-step,
/// longer than noise.
const HEADING_TIME_CONSTANT: f64 = 0.05;

/// Dead reckoning of the walk. Everything is in physical coordinates: nothing is mirrored.
#[derive(Clone, Debug)]
pub struct WalkOdometry {
    /// The left foot, which swings in support coordinates, and the place of its sole (m).
    swing_foot: (Joint, Vector3<f64>),
    support: Side,
    /// The support sole in the walk frame.
    sole: WalkPose,
    /// The swing sole in the frame of the support sole.
    swing_in_support: WalkPose,
    /// Heading of the walk frame against that of the inertial measurement unit, as a direction (-); once one was
    /// measured.
    heading_offset: Option<Vector2<f64>>,
    /// The pose at the last support changes, the newest first, with the time since each (s).
    changes: [Option<(WalkPose, f64)>; 3],
    /// Mean velocity over the last full step.
    velocity: WalkVelocity,
}

impl WalkOdometry {
    /// At the start.
    ///
    /// * `kinematics` – of the first posture, in support coordinates of the foot on `support`
    pub fn new(mechanism: &Mechanism, kinematics: &Kinematics, support: Side) -> Self {
        let mut odometry = Self {
            swing_foot: (mechanism.foot(Side::Left), mechanism.sole_in_foot(Side::Left)),
            support,
            sole: WalkPose::default(),
            swing_in_support: WalkPose::default(),
            heading_offset: None,
            changes: [None; 3],
            velocity: WalkVelocity::default(),
        };
        odometry.swing_in_support = odometry.swing_sole(kinematics);
        // The middle between the feet is the origin.
        odometry.sole.heading = -odometry.pose().heading;
        let turned = odometry.pose();
        (odometry.sole.x, odometry.sole.y) = (-turned.x, -turned.y);
        odometry
    }

    /// Absorbs a period.
    ///
    /// * `support` – the support foot
    /// * `kinematics` – of the joint angles, measured or else commanded, in support coordinates
    /// * `orientation` – of the trunk as the inertial measurement unit has it, if there is a valid sample
    /// * `dt` – length of the period (s)
    pub fn update(&mut self, support: Side, kinematics: &Kinematics, orientation: Option<&Quaternion<f64>>, dt: f64) {
        self.support_on(support);
        self.swing_in_support = self.swing_sole(kinematics);
        for (_, since) in self.changes.iter_mut().flatten() {
            *since += dt;
        }
        self.forget_velocity();
        let Some(orientation) = orientation else { return };
        let trunk = kinematics.rotation[Mechanism::TRUNK].column(0).xy();
        let over_sole = Vector2::new(trunk.x, support.lateral_sign() * trunk.y);
        let (sine, cosine) = sin_cos(self.sole.heading);
        let expected = product(&Vector2::new(cosine, sine), &over_sole);
        let sensed = ahead(orientation);
        let offset = *self.heading_offset.get_or_insert(quotient(&expected, &sensed));
        let off = quotient(&product(&sensed, &offset), &expected);
        self.sole.heading += atan2(off.y, off.x) * dt / (HEADING_TIME_CONSTANT + dt);
    }

    /// The foot on `support` bears from now on, if it does not yet.
    pub fn support_on(&mut self, support: Side) {
        if support == self.support {
            return;
        }
        let pose = self.pose();
        let before = self.sole;
        [self.sole] = poses_in_frame_of(&before, &[self.swing_in_support]);
        self.swing_in_support = pose_seen_from(&self.sole, &before);
        self.support = support;
        self.changes.rotate_right(1);
        self.changes[0] = Some((pose, 0.0));
        if let [_, Some((between, _)), Some((earlier, since))] = self.changes {
            let [first, second] = [arc_between(&earlier, &between), arc_between(&between, &pose)];
            let moved = WalkVelocity {
                ahead: first.x + second.x,
                left: first.y + second.y,
                turn: first.heading + second.heading,
            };
            self.velocity = moved.scaled(1.0 / since);
        }
    }

    /// Once no step follows the last one for longer than a full step has taken, the robot does not move.
    fn forget_velocity(&mut self) {
        if let [Some((_, since)), _, Some((_, earlier))] = self.changes
            && since > earlier - since
        {
            self.changes = [None; 3];
            self.velocity = WalkVelocity::default();
        }
    }

    /// The swing sole in the frame of the support sole, not mirrored.
    fn swing_sole(&self, kinematics: &Kinematics) -> WalkPose {
        let (foot, sole_in_foot) = &self.swing_foot;
        let (rotation, side) = (&kinematics.rotation[*foot], self.support.lateral_sign());
        let place = kinematics.origin[*foot] + rotation * sole_in_foot;
        WalkPose { x: place.x, y: side * place.y, heading: side * atan2(rotation.m21, rotation.m11) }
    }

    /// The middle between both soles, in the frame of the support sole.
    fn middle(&self) -> WalkPose {
        let WalkPose { x, y, heading } = self.swing_in_support;
        WalkPose { x: x / 2.0, y: y / 2.0, heading: heading / 2.0 }
    }

    /// The sole of the support foot.
    pub fn support_sole(&self) -> WalkPose {
        self.sole
    }

    /// The middle between both soles.
    pub fn pose(&self) -> WalkPose {
        let [pose] = poses_in_frame_of(&self.sole, &[self.middle()]);
        pose
    }

    /// Where the walk is.
    ///
    /// * `landings` – of the swing foot and of the support foot after it, in the frame of the support sole
    pub fn report(&self, [next, after]: &[WalkPose; 2]) -> Odometry {
        let [pose, next, after] = poses_in_frame_of(&self.sole, &[self.middle(), *next, *after]);
        Odometry { pose, velocity: self.velocity, support_sole: self.sole, landings: [next, after] }
    }
}

/// The direction whose angle is the sum of those of two directions (-); all of any length.
fn product(one: &Vector2<f64>, other: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(one.x * other.x - one.y * other.y, one.x * other.y + one.y * other.x)
}

/// The direction whose angle is that of one direction less that of another.
fn quotient(one: &Vector2<f64>, other: &Vector2<f64>) -> Vector2<f64> {
    product(one, &Vector2::new(other.x, -other.y))
}

/// Where the x axis points that is rotated by a quaternion of any length, seen from above.
fn ahead(Quaternion { coords }: &Quaternion<f64>) -> Vector2<f64> {
    let [x, y, z, w]: [f64; 4] = (*coords).into();
    Vector2::new(w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z))
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;

    #[test]
    fn a_rotated_x_axis_points_where_the_quaternion_says() {
        for [roll, pitch, yaw] in [[0.1, -0.2, 0.5], [0.0, 0.3, -2.5], [-0.4, 0.1, 3.0]] {
            let orientation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            let expected = (orientation * Vector3::x()).xy();
            assert!((ahead(&orientation) - expected).norm() < 1e-12, "{roll} {pitch} {yaw}");
        }
    }

    #[test]
    fn angles_of_directions_add_and_subtract() {
        let at = |angle: f64| Vector2::new(angle.cos(), angle.sin()) * 1.3;
        let angle_of = |direction: Vector2<f64>| direction.y.atan2(direction.x);
        assert!((angle_of(product(&at(0.4), &at(1.1))) - 1.5).abs() < 1e-12);
        assert!((angle_of(quotient(&at(0.4), &at(1.1))) + 0.7).abs() < 1e-12);
    }
}
