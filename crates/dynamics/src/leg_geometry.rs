//! Inverse kinematics of the usual leg in closed form: hip axes that meet in one point, a knee, ankle axes that meet in
//! one point.
//!
//! From the foot up the joints are ankle roll (x), ankle pitch (y), knee (y), hip pitch (y), hip yaw (z), hip roll (x).
//! The distance from ankle to hip gives the knee (law of cosines), the direction of the hip seen from the foot gives
//! the ankle, and the remaining rotation gives the hip; as S. Kajita et al., "Introduction to Humanoid Robotics",
//! Springer 2014, section 2.5, with our order of axes. Every angle is that of a direction whose two components are
//! polynomials of the given poses and a few square roots, so that nothing is lost near the stretched leg and no angle
//! is needed to find the next.

use model::{Joint, JointVector, Mechanism, Side};
use nalgebra::{Isometry3, Vector3};

use crate::atan2;
use crate::inverse_kinematics::{TOLERANCE, Unreachable};

/// A leg of that structure: its lengths and the senses of its joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegGeometry {
    /// The joints from the foot up.
    joints: [Joint; 6],
    /// 1 where a positive angle rotates the upper link against the lower one about +x, +y or +z; else −1.
    senses: [f64; 6],
    /// Position of the ankle in the foot link's frame (m).
    ankle_in_foot: Vector3<f64>,
    /// Position of the hip in the pelvis link's frame (m).
    hip_in_pelvis: Vector3<f64>,
    /// Distance from ankle to knee (m).
    shank: f64,
    /// Distance from knee to hip (m).
    thigh: f64,
}

impl LegGeometry {
    /// The geometry of a leg; `None` if the mechanism's leg has another structure.
    pub(crate) fn new(mechanism: &Mechanism, side: Side) -> Option<Self> {
        let up = if side == Side::Right { 1.0 } else { -1.0 };
        let chain = mechanism.leg(side);
        let mut joints = chain;
        // From the first joint in its parent, then from each joint to the next one.
        let [root, mut steps @ ..] = chain.map(|joint| mechanism.links[joint].origin);
        if side == Side::Left {
            joints.reverse();
            steps.reverse();
        }
        let (ankle_in_foot, hip_in_pelvis) = match side {
            Side::Right => (root, Vector3::zeros()),
            Side::Left => (Vector3::zeros(), root),
        };

        let axes = [Vector3::x(), Vector3::y(), Vector3::y(), Vector3::y(), Vector3::z(), Vector3::x()];
        let mut senses = [up; 6];
        for ((sense, joint), usual) in senses.iter_mut().zip(joints).zip(axes) {
            let axis = mechanism.links[joint].axis.into_inner();
            if axis == -usual {
                *sense = -up;
            } else if axis != usual {
                return None;
            }
        }
        let [in_ankle, shank, thigh, in_hip, in_hip_too] = steps.map(|step| step * up);
        let one_point = [in_ankle, in_hip, in_hip_too].iter().all(|step| *step == Vector3::zeros());
        let straight = [shank, thigh].iter().all(|bone| bone.x == 0.0 && bone.y == 0.0 && bone.z > 0.0);
        (one_point && straight).then_some(Self {
            joints,
            senses,
            ankle_in_foot,
            hip_in_pelvis,
            shank: shank.z,
            thigh: thigh.z,
        })
    }

    /// As [`LegSolver::solve`](crate::LegSolver::solve).
    #[inline]
    pub(crate) fn solve(
        &self,
        pelvis_to_support: &Isometry3<f64>,
        foot_to_support: &Isometry3<f64>,
        angles: &mut JointVector,
    ) -> Result<(), Unreachable> {
        let pelvis_to_foot = foot_to_support.inv_mul(pelvis_to_support);
        let rotation = pelvis_to_foot.rotation.to_rotation_matrix().into_inner();
        let hip_in_foot = pelvis_to_foot.translation.vector + rotation * self.hip_in_pelvis - self.ankle_in_foot;
        let squared = hip_in_foot.norm_squared();
        if !squared.is_finite() {
            return Err(Unreachable { residual: f64::INFINITY });
        }

        // The knee's cosine and sine times 2·shank·thigh; it bends backward, and stays straight or folded out of reach.
        let (longest, shortest) = (self.shank + self.thigh, self.shank - self.thigh);
        let spare = (longest * longest - squared).max(0.0) * (squared - shortest * shortest).max(0.0);
        let bend = squared - self.shank * self.shank - self.thigh * self.thigh;
        let knee = Direction { cosine: bend, sine: -spare.sqrt() };
        // The hip in the shank's frame, 2·shank times as far: z is the cosine's and x the sine's axis.
        let hip_in_shank = Direction { cosine: 2.0 * self.shank * self.shank + knee.cosine, sine: knee.sine };

        // Ankle roll brings the hip above the pitch axis, ankle pitch brings the shank beneath the hip.
        let height = (hip_in_foot.y * hip_in_foot.y + hip_in_foot.z * hip_in_foot.z).sqrt();
        let ankle_roll = if height > 0.0 {
            Direction { cosine: hip_in_foot.z / height, sine: -hip_in_foot.y / height }
        } else {
            Direction::ZERO
        };
        let ankle_pitch = Direction { cosine: height, sine: hip_in_foot.x }.less(hip_in_shank).or_zero();

        // Above the ankle roll all pitches add up: pelvis = pitch · hip yaw · hip roll, of which the first column and
        // the second row are enough.
        let rolled = |column: usize| {
            let (y, z) = (rotation[(1, column)], rotation[(2, column)]);
            (ankle_roll.cosine * y + ankle_roll.sine * z, ankle_roll.cosine * z - ankle_roll.sine * y)
        };
        let (ahead_y, ahead_z) = rolled(0);
        let pitch = Direction { cosine: rotation[(0, 0)], sine: -ahead_z };
        let hip_pitch = pitch.less(ankle_pitch).less(knee);
        let level = (pitch.cosine * pitch.cosine + pitch.sine * pitch.sine).sqrt();
        let hip_yaw = Direction { cosine: level, sine: ahead_y };
        let hip_roll = Direction { cosine: rolled(1).0, sine: -rolled(2).0 };

        let found = Direction::angles(&[ankle_roll, ankle_pitch, knee, hip_pitch, hip_yaw, hip_roll]);
        for ((joint, sense), angle) in self.joints.into_iter().zip(self.senses).zip(found) {
            angles[joint] = sense * angle;
        }

        let distance = squared.sqrt();
        let residual = (distance - longest).max(shortest.abs() - distance);
        if residual > TOLERANCE { Err(Unreachable { residual }) } else { Ok(()) }
    }
}

/// An angle by its cosine and sine, both scaled by any positive factor.
#[derive(Clone, Copy)]
struct Direction {
    cosine: f64,
    sine: f64,
}

impl Direction {
    const ZERO: Self = Self { cosine: 1.0, sine: 0.0 };

    /// The angle, or zero if the direction is undefined.
    #[inline(always)]
    fn or_zero(self) -> Self {
        if self.cosine == 0.0 && self.sine == 0.0 { Self::ZERO } else { self }
    }

    /// The difference of two angles.
    #[inline(always)]
    fn less(self, other: Self) -> Self {
        Self {
            cosine: self.cosine * other.cosine + self.sine * other.sine,
            sine: self.sine * other.cosine - self.cosine * other.sine,
        }
    }

    /// The angles (rad). Not inlined, so that the compiler turns the loop into vector code.
    #[inline(never)]
    fn angles(directions: &[Self; 6]) -> [f64; 6] {
        directions.map(|direction| atan2(direction.sine, direction.cosine))
    }
}
