//! The prescribed part of the half-step: both legs and the arms.

use dynamics::Tree;
use model::{JointVector, LegReach, Mechanism, Motion, Side};
use nalgebra::Vector3;

use crate::arms::ArmSwing;
use crate::jet::{Jet, PointMotion};
use crate::leg_motion::{LegEnd, first_guess, move_leg};
use crate::leg_path::LegPath;
use crate::{SynthesisError, SynthesisParameters};

/// Legs and arms over the half-step, at `points_per_interval` instants of each interval and at the end.
pub(crate) struct Limbs<'a> {
    mechanism: &'a Mechanism,
    tree: &'a Tree,
    path: &'a dyn LegPath,
    parameters: &'a SynthesisParameters,
    points_per_interval: usize,
    reach: LegReach,
    arms: ArmSwing,
    /// Middle between the hips, in the pelvis link's frame (m).
    middle_in_pelvis: Vector3<f64>,
    /// Origin of the left foot's link over its sole (m).
    to_left_foot: Vector3<f64>,
}

impl<'a> Limbs<'a> {
    /// The limbs of a robot whose pelvis and swing foot move on a path.
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        tree: &'a Tree,
        path: &'a dyn LegPath,
        parameters: &'a SynthesisParameters,
        points_per_interval: usize,
    ) -> Self {
        let reach = LegReach::of(mechanism);
        let [right, left] = reach.hips_in_pelvis;
        Self {
            mechanism,
            tree,
            path,
            parameters,
            points_per_interval,
            middle_in_pelvis: right + (left - right) / 2.0,
            to_left_foot: -mechanism.sole_in_foot(Side::Left),
            reach,
            arms: ArmSwing::new(mechanism, parameters),
        }
    }

    /// The number of the last point.
    pub(crate) fn last_point(&self) -> usize {
        self.parameters.intervals * self.points_per_interval
    }

    /// The progress at a point.
    pub(crate) fn progress(&self, point: usize) -> Jet {
        Jet { value: point as f64 / self.last_point() as f64, rate: 1.0 / self.parameters.duration, acceleration: 0.0 }
    }

    /// Both knees bent, from which inverse kinematics begins at the first point (rad).
    pub(crate) fn first_guess(&self) -> JointVector {
        first_guess(self.mechanism)
    }

    /// The motion at every point; waist straight and at rest.
    ///
    /// * `shift` – of the pelvis off its path
    ///
    /// # Errors
    /// A leg is too short, or inverse kinematics finds no angles.
    pub(crate) fn motions(&self, shift: impl Fn(Jet) -> PointMotion) -> Result<Vec<(Jet, Motion)>, SynthesisError> {
        let mut angles = self.first_guess();
        (0..=self.last_point())
            .map(|point| {
                let progress = self.progress(point);
                // Inverse kinematics starts from the angles of the instant before.
                let motion = self.motion(point, &shift(progress), &angles)?;
                angles = motion.angles;
                Ok((progress, motion))
            })
            .collect()
    }

    /// The motion at a point.
    ///
    /// * `shift` – of the pelvis off its path
    /// * `guess` – angles near the solution (rad)
    pub(crate) fn motion(
        &self,
        point: usize,
        shift: &PointMotion,
        guess: &JointVector,
    ) -> Result<Motion, SynthesisError> {
        let progress = self.progress(point);
        let (middle, sole) = (self.path.pelvis(progress).plus(shift), self.path.swing_sole(progress));
        let pelvis = PointMotion { position: middle.position - self.middle_in_pelvis, ..middle };
        self.check_reach(point, &pelvis.position, &sole.position)?;

        let mut motion = Motion::at_rest(*guess);
        let ends = [
            LegEnd { position: pelvis.position, velocity: pelvis.velocity, acceleration: pelvis.acceleration },
            LegEnd {
                position: sole.position + self.to_left_foot,
                velocity: sole.velocity - pelvis.velocity,
                acceleration: sole.acceleration - pelvis.acceleration,
            },
        ];
        for (side, end) in Side::BOTH.into_iter().zip(&ends) {
            move_leg(self.tree, side, end, &mut motion).map_err(|unreachable| SynthesisError::LegUnreachable {
                row: point / self.points_per_interval,
                last: self.parameters.intervals,
                side,
                residual: unreachable.residual,
            })?;
        }
        self.arms.apply(progress, &mut motion);
        Ok(motion)
    }

    fn check_reach(&self, point: usize, pelvis: &Vector3<f64>, sole: &Vector3<f64>) -> Result<(), SynthesisError> {
        let LegReach { hips_in_pelvis, ankles_in_foot, .. } = self.reach;
        let feet = [Vector3::zeros(), sole + self.to_left_foot];
        for side in Side::BOTH {
            let index = side.index();
            let distance = (pelvis + hips_in_pelvis[index] - feet[index] - ankles_in_foot[index]).norm();
            let length = self.reach.length();
            if distance >= length {
                let (row, last) = (point / self.points_per_interval, self.parameters.intervals);
                return Err(SynthesisError::LegTooShort { row, last, side, distance, length });
            }
        }
        Ok(())
    }
}
