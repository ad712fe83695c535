//! The nominal half-step as a table: one row per interval boundary.

use model::{Joint, JointVector, Mirror, Mirrored, Motion, Wrench};

use crate::hermite::{interpolate, interpolate_angles};

/// The nominal half-step: in single support on the right foot, at `n_int + 1` equally spaced instants from 0 to T.
#[derive(Clone, Debug, PartialEq)]
pub struct NominalTable {
    /// Duration `T` of the half-step (s).
    pub duration: f64,
    /// The rows from t = 0 to t = T inclusive.
    pub rows: Vec<NominalRow>,
    /// The command that made the table, for the file's header.
    pub made_by: String,
    /// Fingerprint of the mechanism for which it was made.
    pub mechanism: u64,
}

/// Motion, joint torques and ground wrench at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NominalRow {
    /// Joint angles, rates and accelerations at nominal speed.
    pub motion: Motion,
    /// Torques that hold the posture against gravity (N·m).
    pub torque_gravity: JointVector,
    /// Torques of the motion itself (N·m); they grow with the square of the speed (Hollerbach 1984).
    pub torque_dynamic: JointVector,
    /// Gravity part of the ground's wrench about O, in support axes.
    pub ground_gravity: Wrench,
    /// Dynamic part of the ground's wrench about O, in support axes; it grows with the square of the speed.
    pub ground_dynamic: Wrench,
}

/// Why a table is not a nominal half-step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// The table has less than two rows: an interval needs one at each end.
    #[error("the table has {0} rows: a half-step needs at least 2, one at each end")]
    TooFewRows(usize),
    /// The duration `T` is not finite and positive.
    #[error("the half-step's duration is {0} s: it must be finite and positive")]
    DurationNotPositive(f64),
    /// A row holds NaN or infinity.
    #[error("row {0} holds a value that is not a finite number")]
    NotFinite(usize),
    /// A joint would jump in angle or rate at the support change.
    #[error(
        "the end does not mirror the start: {quantity} of joint {} ({}) ends as {found}, mirrored, and starts as \
         {expected}; the two must agree to {tolerance:e}",
        joint.number(), joint.name(), tolerance = NominalTable::SWAP_TOLERANCE
    )]
    EndDoesNotMirrorStart {
        /// The joint that would jump.
        joint: Joint,
        /// The quantity that would jump: `angle` or `rate`.
        quantity: &'static str,
        /// The mirrored end's value (rad or rad/s).
        found: f64,
        /// The start's value (rad or rad/s).
        expected: f64,
    },
}

impl NominalTable {
    /// Largest difference between the mirrored end and the start (DESIGN §3) (rad, rad/s).
    pub const SWAP_TOLERANCE: f64 = 1e-6;

    /// `n_int`: number of intervals of the half-step.
    pub fn intervals(&self) -> usize {
        self.rows.len() - 1
    }

    /// Checks that the half-step can be repeated from foot to foot: it is finite, has at least one interval, and its
    /// end mirrors its start in angle and rate. (Accelerations may jump at the support change, as the ZMP does.)
    ///
    /// # Errors
    /// The first reason why it cannot.
    pub fn check(&self, mirror: &Mirror) -> Result<(), TableError> {
        if !(self.duration.is_finite() && self.duration > 0.0) {
            return Err(TableError::DurationNotPositive(self.duration));
        }
        let [first, .., last] = self.rows.as_slice() else {
            return Err(TableError::TooFewRows(self.rows.len()));
        };
        if let Some(row) = self.rows.iter().position(|row| !row.is_finite()) {
            return Err(TableError::NotFinite(row));
        }
        let (start, end) = (first.motion, last.motion.mirrored(mirror));
        for (quantity, start, end) in [("angle", start.angles, end.angles), ("rate", start.rates, end.rates)] {
            for (joint, &expected) in start.iter() {
                let found = end[joint];
                if (found - expected).abs() > Self::SWAP_TOLERANCE {
                    return Err(TableError::EndDoesNotMirrorStart { joint, quantity, found, expected });
                }
            }
        }
        Ok(())
    }

    /// The motion at `progress` from 0 to 1, at nominal speed: angles are twice continuously differentiable across the
    /// rows, and rates and accelerations are their exact derivatives. Progress outside 0 to 1 counts as the nearer end.
    ///
    /// Like all lookups it needs a table that passes [`check`](Self::check).
    pub fn at(&self, progress: f64) -> Motion {
        let (start, end, x) = self.around(progress);
        interpolate(&start.motion, &end.motion, x, self.duration / self.intervals() as f64)
    }

    /// The angles of [`at`](Self::at) alone.
    pub fn angles_at(&self, progress: f64) -> JointVector {
        let (start, end, x) = self.around(progress);
        interpolate_angles(&start.motion, &end.motion, x, self.duration / self.intervals() as f64)
    }

    /// The rows before and after `progress`, and its position between them, 0 to 1.
    fn around(&self, progress: f64) -> (&NominalRow, &NominalRow, f64) {
        let place = progress.clamp(0.0, 1.0) * self.intervals() as f64;
        let interval = (place as usize).min(self.intervals() - 1);
        (&self.rows[interval], &self.rows[interval + 1], place - interval as f64)
    }
}

impl NominalRow {
    /// Whether no value is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.motion.is_finite()
            && self.torque_gravity.is_finite()
            && self.torque_dynamic.is_finite()
            && self.ground_gravity.is_finite()
            && self.ground_dynamic.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn row(angle: f64, force: f64) -> NominalRow {
        let mut motion = Motion::default();
        motion.angles[Joint::RightKnee] = angle;
        let wrench = |x| Wrench { force: Vector3::new(0.0, 0.0, x), moment: Vector3::zeros() };
        NominalRow {
            motion,
            torque_gravity: JointVector::unit(Joint::RightKnee) * force,
            torque_dynamic: JointVector::unit(Joint::RightKnee) * 10.0,
            ground_gravity: wrench(force),
            ground_dynamic: wrench(10.0),
        }
    }

    fn table() -> NominalTable {
        let rows = vec![row(0.1, 1.0), row(0.3, 2.0), row(0.2, 4.0)];
        NominalTable { duration: 0.6, rows, made_by: "a test".into(), mechanism: 1 }
    }

    #[test]
    fn lookups_meet_the_rows_exactly_and_clamp_at_the_ends() {
        let table = table();
        for (progress, row) in [(-1.0, 0), (0.0, 0), (0.5, 1), (1.0, 2), (7.0, 2)] {
            assert_eq!(table.at(progress), table.rows[row].motion, "at progress {progress}");
        }
    }
}
