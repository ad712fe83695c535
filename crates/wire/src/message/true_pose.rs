//! True pose, simulated plant → anyone: where the robot is, which no sensor measures.

use iceoryx2::prelude::ZeroCopySend;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::{Latest, NEVER_WRITTEN};

/// The true pose of a simulated robot, as it lies in shared memory.
#[derive(Clone, Copy, Debug, PartialEq, ZeroCopySend)]
#[type_name("halfstep.TruePose.v1")]
#[repr(C)]
pub struct TruePoseMessage {
    /// Periods since the plant started.
    pub tick: u64,
    /// When it was written, `CLOCK_MONOTONIC` (ns).
    pub time_ns: u64,
    /// The right sole's origin in the world (m).
    pub position: [f64; 3],
    /// Unit quaternion w x y z that takes the right sole's coordinates to the world's.
    pub orientation: [f64; 4],
}

impl TruePoseMessage {
    /// The pose of the right sole after `tick` periods, written at `time_ns` (`CLOCK_MONOTONIC`).
    pub fn new(tick: u64, time_ns: u64, right_sole: &Isometry3<f64>) -> Self {
        let Isometry3 { translation, rotation: q } = right_sole;
        Self { tick, time_ns, position: translation.vector.into(), orientation: [q.w, q.i, q.j, q.k] }
    }

    /// The pose of the right sole in the world; `None` if a number is not finite or the quaternion no rotation.
    pub fn right_sole(&self) -> Option<Isometry3<f64>> {
        let [w, i, j, k] = self.orientation;
        let is_finite = self.position.iter().chain(&self.orientation).all(|number| number.is_finite());
        let rotation = is_finite.then(|| UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 0.5)).flatten()?;
        Some(Isometry3::from_parts(Translation3::from(Vector3::from(self.position)), rotation))
    }
}

impl Latest for TruePoseMessage {
    const EMPTY: Self = Self { tick: NEVER_WRITTEN, time_ns: 0, position: [0.0; 3], orientation: [1.0, 0.0, 0.0, 0.0] };

    fn tick(&self) -> u64 {
        self.tick
    }

    fn time_ns(&self) -> u64 {
        self.time_ns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_true_pose_survives_its_message() {
        let rotation = UnitQuaternion::from_euler_angles(0.1, -0.2, 2.0);
        let pose = Isometry3::from_parts(Translation3::new(1.0, 2.0, 3.0), rotation);
        let back = TruePoseMessage::new(7, 8, &pose).right_sole().expect("a pose");
        assert!((back.inverse() * pose).translation.vector.norm() < 1e-12 && back.rotation.angle_to(&rotation) < 1e-12);
        for broken in [[f64::NAN, 0.0, 0.0, 0.0], [0.0; 4]] {
            let message = TruePoseMessage { orientation: broken, ..TruePoseMessage::new(7, 8, &pose) };
            assert_eq!(message.right_sole(), None, "{broken:?}");
        }
    }
}
