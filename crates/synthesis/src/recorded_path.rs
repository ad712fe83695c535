//! Leg paths with the shape of a recorded gait.
//!
//! The stance half of the recording carries the pelvis over a foot that stays flat, the swing half carries the other
//! foot. Both paths are scaled to the step length and closed: the pelvis such that it ends with the rate with which it
//! began, the swing foot such that it starts and lands at rest on the ground.

use model::{LegReach, Mechanism};

use crate::fourier::FourierSeries;
use crate::gait_recording::{GaitRecording, Sample};
use crate::jet::{Jet, PointMotion};
use crate::leg_path::LegPath;
use crate::pendulum_path::PendulumPath;
use crate::{SynthesisError, SynthesisParameters};

/// Number of instants at which the height of the swing foot is sampled.
const HEIGHT_SAMPLES: usize = 240;

/// A recorded gait over one half-step.
#[derive(Clone, Debug)]
pub(crate) struct RecordedPath {
    /// Provides what the recording lacks: step length, heights, lateral sway.
    pendulum: PendulumPath,
    /// Position of the hip ahead of the ankle, over the cycle (m).
    ahead: FourierSeries,
    /// Height of the hip above the ankle, over the cycle (m).
    above: FourierSeries,
    /// Ratio of the step length to the recorded one (-).
    scale: f64,
    /// Ratio of the clearance to that of the recorded foot (-).
    lift_scale: f64,
}

impl RecordedPath {
    /// The paths of a half-step with the shape of a recording.
    ///
    /// # Errors
    /// The recording does not determine a shape, goes backwards, or has its swing foot below the ground.
    pub(crate) fn new(
        mechanism: &Mechanism,
        pendulum: PendulumPath,
        recording: &GaitRecording,
    ) -> Result<Self, SynthesisError> {
        let LegReach { thigh, shank, .. } = LegReach::of(mechanism);
        // With an upright trunk the thigh is pitched by the hip's flexion, the shank by that minus the knee's flexion.
        let fit = |hip_part: fn(Jet) -> Jet, sign: f64| {
            let samples = recording.samples.iter().map(|sample| {
                let Sample { cycle, hip_flexion, knee_flexion } = *sample;
                let thigh_part = hip_part(Jet::constant(hip_flexion)).value * thigh;
                let shank_part = hip_part(Jet::constant(hip_flexion - knee_flexion)).value * shank;
                (cycle, sign * (thigh_part + shank_part))
            });
            FourierSeries::fit(&samples.collect::<Vec<_>>()).ok_or(SynthesisError::RecordingUndetermined)
        };
        let (ahead, above) = (fit(Jet::sin, -1.0)?, fit(Jet::cos, 1.0)?);

        let mut path = Self { pendulum, ahead, above, scale: 1.0, lift_scale: 1.0 };
        let recorded_step = path.hip_ahead(Jet::constant(1.0)).value - path.hip_ahead(Jet::constant(0.0)).value;
        if recorded_step <= 0.0 {
            return Err(SynthesisError::RecordingGoesBackwards { step: recorded_step });
        }
        path.scale = path.pendulum.parameters.step_length / recorded_step;
        path.lift_scale = path.pendulum.parameters.clearance / path.highest_lift()?;
        Ok(path)
    }

    /// Position of the hip ahead of the support ankle, as recorded (m).
    fn hip_ahead(&self, progress: Jet) -> Jet {
        self.ahead.at(progress * 0.5)
    }

    /// Height of the hip above the support ankle, as recorded (m).
    fn hip_above(&self, progress: Jet) -> Jet {
        self.above.at(progress * 0.5)
    }

    /// Position of the swing ankle ahead of the support ankle, as recorded (m).
    fn foot_ahead(&self, progress: Jet) -> Jet {
        self.hip_ahead(progress) - self.ahead.at(progress * 0.5 + 0.5)
    }

    /// Height of the swing foot, forced to rest at both ends, before it is scaled to the clearance (m).
    fn lift(&self, progress: Jet) -> Jet {
        let above = |progress: Jet| self.hip_above(progress) - self.above.at(progress * 0.5 + 0.5);
        (above(progress) - chord(above, progress)) * progress.bump()
    }

    /// Greatest height of the unscaled swing foot (m).
    fn highest_lift(&self) -> Result<f64, SynthesisError> {
        let mut highest = 0.0_f64;
        for sample in 1..HEIGHT_SAMPLES {
            let progress = sample as f64 / HEIGHT_SAMPLES as f64;
            let lift = self.lift(Jet::constant(progress)).value;
            if lift < 0.0 {
                return Err(SynthesisError::RecordedFootBelowGround { percent: 50.0 * (1.0 + progress) });
            }
            highest = highest.max(lift);
        }
        Ok(highest)
    }
}

impl LegPath for RecordedPath {
    fn pelvis(&self, progress: Jet) -> PointMotion {
        let SynthesisParameters { step_length, pelvis_setback, hip_height, .. } = self.pendulum.parameters;
        let middle = self.hip_ahead(Jet::constant(0.0)).value * self.scale + step_length / 2.0;
        let forward = closed(|at| self.hip_ahead(at) * self.scale, progress) - (middle + pelvis_setback);
        let vault = |at: Jet| self.hip_above(at) * self.scale;
        let height = closed(|at| vault(at) - chord(vault, at), progress) + hip_height;
        PointMotion::new(forward, self.pendulum.pelvis_y(progress), height)
    }

    fn swing_sole(&self, progress: Jet) -> PointMotion {
        let (start, end) = (self.foot_ahead(Jet::constant(0.0)).value, self.foot_ahead(Jet::constant(1.0)).value);
        let recorded = (self.foot_ahead(progress) - start) * (1.0 / (end - start));
        // The recorded foot moves at both ends: there a smooth step takes over.
        let at_rest = progress.smooth_step();
        let share = at_rest + (recorded - at_rest) * progress.bump();
        self.pendulum.swing_at(share, self.lift(progress) * self.lift_scale)
    }
}

/// The straight line between the ends of a path.
fn chord(path: impl Fn(Jet) -> Jet, progress: Jet) -> Jet {
    let (start, end) = (path(Jet::constant(0.0)).value, path(Jet::constant(1.0)).value);
    progress * (end - start) + start
}

/// The path with the least parabola added that makes the rates at both ends equal; the ends stay.
fn closed(path: impl Fn(Jet) -> Jet, progress: Jet) -> Jet {
    let rate_at = |end: f64| path(Jet { value: end, rate: 1.0, acceleration: 0.0 }).rate;
    let mismatch = rate_at(1.0) - rate_at(0.0);
    path(progress) + progress * (-progress + 1.0) * (mismatch / 2.0)
}
