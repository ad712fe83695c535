//! Where a leg pivots, for questions of reach: hip and ankle as points, and the length of the stretched leg.
//!
//! Real hips and ankles are several axes that need not meet. What bounds a step are the pitch axes, seen from the side.

use nalgebra::{Vector2, Vector3};

use crate::{Joint, Mechanism, Side};

/// Hips and ankles as points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegReach {
    /// The right and the left hip in the pelvis link's frame (m): on the pitch axis, as far aside as the ankle when the
    /// robot stands straight.
    pub hips_in_pelvis: [Vector3<f64>; 2],
    /// The right and the left ankle in the foot link's frame (m): on the pitch axis, as far aside as the roll axis.
    pub ankles_in_foot: [Vector3<f64>; 2],
    /// Distance from hip to knee, seen from the side (m).
    pub thigh: f64,
    /// Distance from knee to ankle, seen from the side (m).
    pub shank: f64,
}

impl LegReach {
    /// Length of the paper's robot's leg from ankle over knee to hip (m).
    pub const PAPER_LENGTH: f64 = 0.434 + 0.422;

    /// The legs of a mechanism.
    pub fn of(mechanism: &Mechanism) -> Self {
        let joints = mechanism.leg(Side::Right);
        let place = |joint: Joint| joints.iter().position(|other| *other == joint).unwrap_or(0);
        // From the first joint (exclusive) to the second one, which are in this order up the leg.
        let way = |from: Joint, to: Joint| -> Vector3<f64> {
            joints[place(from) + 1..=place(to)].iter().map(|joint| mechanism.links[*joint].origin).sum()
        };
        let from_foot = |to: Joint| mechanism.links[joints[0]].origin + way(joints[0], to);
        let (pitch, roll) = (from_foot(Joint::RightAnklePitch), from_foot(Joint::RightAnkleRoll));
        let ankle = Vector3::new(pitch.x, roll.y, pitch.z);
        let to_pelvis = way(Joint::RightHipPitch, mechanism.pelvis());
        let aside = ankle.y - from_foot(mechanism.pelvis()).y;
        let hip = Vector3::new(0.0 - to_pelvis.x, aside, 0.0 - to_pelvis.z);
        let across = mechanism.foot_distance();
        let seen_from_the_side = |way: Vector3<f64>| Vector2::new(way.x, way.z).norm();
        let to_left_foot = mechanism.sole_in_foot(Side::Left);
        Self {
            hips_in_pelvis: [hip, hip + Vector3::new(0.0, across, 0.0)],
            ankles_in_foot: [ankle, to_left_foot + Vector3::new(ankle.x, 0.0 - ankle.y, ankle.z)],
            thigh: seen_from_the_side(way(Joint::RightKnee, Joint::RightHipPitch)),
            shank: seen_from_the_side(way(Joint::RightAnklePitch, Joint::RightKnee)),
        }
    }

    /// Distance from hip to ankle of the stretched leg (m).
    pub fn length(&self) -> f64 {
        self.shank + self.thigh
    }

    /// Length of the leg per that of the paper's robot, 0.856 m (-). A length that was found for that robot suits
    /// another one when multiplied by it, a time when multiplied by its square root (Froude's law).
    pub fn scale(&self) -> f64 {
        self.length() / Self::PAPER_LENGTH
    }
}
