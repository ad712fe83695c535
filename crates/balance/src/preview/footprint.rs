//! Where the feet are put: soles in support coordinates, footprints in the walk's own frame.

use dynamics::{Kinematics, atan2, sin_cos};
use model::{Mechanism, Side};
use nalgebra::{Isometry2, Isometry3, Quaternion, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

/// A level sole in support coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolePose {
    /// Of the point under the ankle [m].
    pub position: Vector3<f64>,
    /// Heading against the bearing foot [rad].
    pub yaw: f64,
}

/// The bearing foot in the walk's frame, which has its origin where the walk began, x ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Maps the foot's coordinates to the walk's.
    pub place: Isometry2<f64>,
    /// Which foot.
    pub side: Side,
}

impl SolePose {
    /// Of the swinging foot as the joints have it, its tilt left out.
    pub fn swinging(mechanism: &Mechanism, kinematics: &Kinematics) -> Self {
        let sole = kinematics.sole_to_world(mechanism, Side::Left);
        let ahead = sole.rotation * Vector3::x();
        Self { position: sole.translation.vector, yaw: atan2(ahead.y, ahead.x) }
    }

    /// Where the bearing foot is as seen, and mirrored, from this one, once this one bears.
    pub fn seen_from_landed(&self) -> Self {
        let back = Rotation2::new(-self.yaw) * -self.position.xy();
        Self { position: Vector3::new(back.x, -back.y, 0.0), yaw: self.yaw }
    }

    /// Maps sole coordinates to support coordinates.
    pub fn to_support(self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(self.position), turned_about_z(self.yaw))
    }
}

impl Footprint {
    /// The foot that bears first, at the walk's origin.
    pub fn first(side: Side) -> Self {
        Self { place: Isometry2::identity(), side }
    }

    /// The next foot to bear, once it has landed at `landed` in support coordinates.
    pub fn next(&self, landed: &SolePose) -> Self {
        let step = Isometry2::new(
            self.mirrored(landed.position.xy()),
            if self.side == Side::Left { -landed.yaw } else { landed.yaw },
        );
        Self { place: self.place * step, side: self.side.other() }
    }

    /// Tells a point of support coordinates in the walk's.
    pub fn point_to_walk(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.place.translation.vector + self.direction_to_walk(point)
    }

    /// Tells a direction of support coordinates in the walk's.
    pub fn direction_to_walk(&self, direction: Vector2<f64>) -> Vector2<f64> {
        self.place.rotation * self.mirrored(direction)
    }

    /// Tells a point of the walk's coordinates in support coordinates.
    pub fn point_to_support(&self, point: Vector2<f64>) -> Vector2<f64> {
        self.mirrored(self.place.rotation.inverse() * (point - self.place.translation.vector))
    }

    /// Tells a direction of the walk's coordinates in support coordinates.
    pub fn direction_to_support(&self, direction: Vector2<f64>) -> Vector2<f64> {
        self.mirrored(self.place.rotation.inverse() * direction)
    }

    fn mirrored(&self, vector: Vector2<f64>) -> Vector2<f64> {
        match self.side {
            Side::Right => vector,
            Side::Left => Vector2::new(vector.x, -vector.y),
        }
    }
}

/// A rotation about the vertical; no function of the system's mathematical library gets into a joint.
pub(super) fn turned_about_z(angle: f64) -> UnitQuaternion<f64> {
    let (sin, cos) = sin_cos(angle / 2.0);
    UnitQuaternion::new_unchecked(Quaternion::new(cos, 0.0, 0.0, sin))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_where_it_was() {
        let foot = Footprint { place: Isometry2::new(Vector2::new(1.0, 2.0), 0.7), side: Side::Left };
        let point = Vector2::new(0.3, -0.2);
        assert!((foot.point_to_support(foot.point_to_walk(point)) - point).norm() < 1e-15);
    }

    /// The foot left behind is where the old footprint was.
    #[test]
    fn the_landed_foot_sees_the_other_where_it_stands() {
        for side in Side::BOTH {
            let first = Footprint { place: Isometry2::new(Vector2::new(1.0, 2.0), 0.4), side };
            let landed = SolePose { position: Vector3::new(0.3, 0.2, 0.0), yaw: 0.25 };
            let second = first.next(&landed);
            let behind = second.point_to_walk(landed.seen_from_landed().position.xy());
            assert!((behind - first.place.translation.vector).norm() < 1e-15);
            assert_eq!(second.next(&landed.seen_from_landed()).side, side);
            let back = second.next(&landed.seen_from_landed()).place;
            assert!((back.rotation.angle() - 0.4).abs() < 1e-15, "{}", back.rotation.angle());
        }
    }
}
