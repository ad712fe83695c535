//! Leg paths from parameters alone.

use model::{GRAVITY, Mechanism};

use crate::SynthesisParameters;
use crate::jet::{Jet, PointMotion, sinh_cosh};
use crate::leg_path::{LegPath, hip_distance};

/// The pelvis moves as the linear inverted pendulum over O does (Kajita 2001): x ∝ sinh, y = a + b·cosh; the swing foot
/// on an arch which leaves the ground and meets it again vertically.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PendulumPath {
    /// The parameters of the half-step.
    pub parameters: SynthesisParameters,
    /// Distance between the hip joints (m).
    hip_distance: f64,
    /// `√(g/h)·T`: phase of the pendulum over the whole half-step (-).
    phase: f64,
}

impl PendulumPath {
    /// The paths of a half-step with these parameters.
    pub(crate) fn new(mechanism: &Mechanism, parameters: &SynthesisParameters) -> Self {
        let phase = (GRAVITY / parameters.pendulum_height).sqrt() * parameters.duration;
        Self { parameters: *parameters, hip_distance: hip_distance(mechanism), phase }
    }

    /// Lateral position of the pelvis, to the left of O (m): half-way between the feet at both ends, nearer to the
    /// support foot in the middle.
    pub(crate) fn pelvis_y(&self, progress: Jet) -> Jet {
        let (_, cosh_at_end) = sinh_cosh(self.phase / 2.0);
        let excursion = ((progress - 0.5) * self.phase).cosh() - cosh_at_end;
        excursion * (self.parameters.pelvis_sway / (cosh_at_end - 1.0)) + self.hip_distance / 2.0
    }

    /// Motion of the swing sole at a share of its way forward and at a height (m).
    pub(crate) fn swing_at(&self, share: Jet, height: Jet) -> PointMotion {
        let forward = (share * 2.0 - 1.0) * self.parameters.step_length;
        PointMotion::new(forward, Jet::constant(self.hip_distance), height)
    }
}

impl LegPath for PendulumPath {
    fn pelvis(&self, progress: Jet) -> PointMotion {
        let SynthesisParameters { step_length, pelvis_setback, hip_height, .. } = self.parameters;
        let (sinh_at_end, _) = sinh_cosh(self.phase / 2.0);
        let forward = ((progress - 0.5) * self.phase).sinh() * (step_length / 2.0 / sinh_at_end) - pelvis_setback;
        PointMotion::new(forward, self.pelvis_y(progress), Jet::constant(hip_height))
    }

    fn swing_sole(&self, progress: Jet) -> PointMotion {
        self.swing_at(progress.smooth_step(), progress.bump() * self.parameters.clearance)
    }
}
