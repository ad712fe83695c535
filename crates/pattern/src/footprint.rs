//! Poses of the feet: soles in support coordinates, footprints in the walk frame.

use std::f64::consts::{PI, TAU};

use dynamics::{atan2, pose_seen_from, sin_cos};
use interface::WalkPose;
use model::Side;
use nalgebra::{Isometry2, Isometry3, Quaternion, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

/// The pose of a level sole, in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SolePose {
    /// The point under the ankle (m).
    pub position: Vector3<f64>,
    /// Heading against the support foot (rad).
    pub yaw: f64,
}

/// The support foot in the walk frame, which has its origin where the walk began, x ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Footprint {
    /// Maps coordinates of the foot to the walk frame.
    pub foot_to_walk: Isometry2<f64>,
    /// Which foot.
    pub side: Side,
}

impl SolePose {
    /// A sole at a place (m), heading where its x axis points.
    pub(crate) fn new(position: Vector3<f64>, ahead: &Vector3<f64>) -> Self {
        Self { position, yaw: atan2(ahead.y, ahead.x) }
    }

    /// The former support sole in the support coordinates of this one, once this one has landed and supports.
    pub(crate) fn former_support(&self) -> Self {
        let back = Rotation2::new(-self.yaw) * -self.position.xy();
        Self { position: Vector3::new(back.x, -back.y, 0.0), yaw: self.yaw }
    }

    /// Maps sole coordinates to support coordinates.
    pub(crate) fn to_support(self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(self.position), rotation_about_z(self.yaw))
    }
}

impl Footprint {
    /// The first support foot, at the origin of the walk frame.
    pub(crate) fn first(side: Side) -> Self {
        Self { foot_to_walk: Isometry2::identity(), side }
    }

    /// The next support foot, once it has landed.
    ///
    /// * `landed` – its pose in support coordinates of this one
    pub(crate) fn next(&self, landed: &SolePose) -> Self {
        let step = Isometry2::new(self.mirrored(landed.position.xy()), self.side.lateral_sign() * landed.yaw);
        Self { foot_to_walk: self.foot_to_walk * step, side: self.side.other() }
    }

    /// Its pose in the walk frame.
    pub(crate) fn pose(&self) -> WalkPose {
        let (place, turn) = (self.foot_to_walk.translation.vector, self.foot_to_walk.rotation);
        WalkPose { x: place.x, y: place.y, heading: atan2(turn.im, turn.re) }
    }

    /// Another footprint in the frame of this foot, not mirrored.
    pub(crate) fn sees(&self, other: &Footprint) -> WalkPose {
        pose_seen_from(&self.pose(), &other.pose())
    }

    /// A sole of the walk frame in support coordinates of this foot, on the ground. Its heading is within ±π of this
    /// one's.
    pub(crate) fn sole_at(&self, sole: &WalkPose) -> SolePose {
        let seen = pose_seen_from(&self.pose(), sole);
        let position = self.mirrored(Vector2::new(seen.x, seen.y)).push(0.0);
        SolePose { position, yaw: self.side.lateral_sign() * within_half_turn(seen.heading) }
    }

    /// Expresses a point of support coordinates in the walk frame.
    pub(crate) fn point_to_walk(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.foot_to_walk.translation.vector + self.direction_to_walk(point)
    }

    /// Expresses a direction of support coordinates in the walk frame.
    pub(crate) fn direction_to_walk(&self, direction: Vector2<f64>) -> Vector2<f64> {
        self.foot_to_walk.rotation * self.mirrored(direction)
    }

    /// Expresses a point of the walk frame in support coordinates.
    pub(crate) fn point_to_support(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.mirrored(self.foot_to_walk.rotation.inverse() * (point - self.foot_to_walk.translation.vector))
    }

    /// Expresses a direction of the walk frame in support coordinates.
    pub(crate) fn direction_to_support(&self, direction: Vector2<f64>) -> Vector2<f64> {
        self.mirrored(self.foot_to_walk.rotation.inverse() * direction)
    }

    /// Between support coordinates and those of the physical foot, either way.
    fn mirrored(&self, vector: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(vector.x, self.side.lateral_sign() * vector.y)
    }
}

/// The same angle, within ±π (rad).
pub(crate) fn within_half_turn(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// A rotation about the vertical. It calls no mathematical library of the system, which would round differently
/// elsewhere.
pub(crate) fn rotation_about_z(angle: f64) -> UnitQuaternion<f64> {
    let (sin, cos) = sin_cos(angle / 2.0);
    UnitQuaternion::new_unchecked(Quaternion::new(cos, 0.0, 0.0, sin))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walk_and_support_coordinates_are_inverse() {
        let foot_to_walk = Isometry2::new(Vector2::new(1.0, 2.0), 0.7);
        let foot = Footprint { foot_to_walk, side: Side::Left };
        let point = Vector2::new(0.3, -0.2);
        assert!((foot.point_to_support(foot.point_to_walk(point)) - point).norm() < 1e-15);
    }

    #[test]
    fn former_support_foot_is_where_the_old_footprint_was() {
        for side in Side::BOTH {
            let first = Footprint { foot_to_walk: Isometry2::new(Vector2::new(1.0, 2.0), 0.4), side };
            let landed = SolePose { position: Vector3::new(0.3, 0.2, 0.0), yaw: 0.25 };
            let second = first.next(&landed);
            let behind = second.point_to_walk(landed.former_support().position.xy());
            assert!((behind - first.foot_to_walk.translation.vector).norm() < 1e-15);
            assert_eq!(second.next(&landed.former_support()).side, side);
            let back = second.next(&landed.former_support()).foot_to_walk;
            assert!((back.rotation.angle() - 0.4).abs() < 1e-15, "{}", back.rotation.angle());
        }
    }

    #[test]
    fn a_sole_that_lands_where_it_is_seen_is_there() {
        for side in Side::BOTH {
            let foot = Footprint { foot_to_walk: Isometry2::new(Vector2::new(1.0, 2.0), 3.0), side };
            let sole = WalkPose { x: 0.7, y: 2.1, heading: -3.1 };
            let landed = foot.next(&foot.sole_at(&sole)).pose();
            assert!((landed.x - sole.x).abs() < 1e-14 && (landed.y - sole.y).abs() < 1e-14, "{landed:?}");
            assert!(within_half_turn(landed.heading - sole.heading).abs() < 1e-14, "{landed:?}");
        }
    }
}
