//! Leg paths from parameters alone.

use model::{GRAVITY, Mechanism};

use crate::Parameters;
use crate::jet::{Jet, PointMotion, sinh_cosh};
use crate::leg_path::{LegPath, hip_distance};

/// The pelvis moves as the linear inverted pendulum over O does (Kajita 2001): x ∝ sinh, y = a + b·cosh; the swing foot
/// on an arch which leaves the ground and meets it again vertically.
#[derive(Clone, Copy, Debug)]
pub struct PendulumPath {
    pub parameters: Parameters,
    hip_distance: f64,
    /// `√(g/h)·T`: the pendulum's phase over the whole half-step.
    phase: f64,
}

impl PendulumPath {
    pub fn new(mechanism: &Mechanism, parameters: &Parameters) -> Self {
        let phase = (GRAVITY / parameters.pendulum_height).sqrt() * parameters.duration;
        Self { parameters: *parameters, hip_distance: hip_distance(mechanism), phase }
    }

    /// Pelvis to the left of O: half-way between the feet at both ends, nearer to the support foot in the middle.
    pub fn pelvis_y(&self, progress: Jet) -> Jet {
        let (_, cosh_at_end) = sinh_cosh(self.phase / 2.0);
        let excursion = ((progress - 0.5) * self.phase).cosh() - cosh_at_end;
        excursion * (self.parameters.pelvis_sway / (cosh_at_end - 1.0)) + self.hip_distance / 2.0
    }

    /// The swing sole's path with a given share of the way forward and a height [m].
    pub fn swing_at(&self, share: Jet, height: Jet) -> PointMotion {
        let forward = (share * 2.0 - 1.0) * self.parameters.step_length;
        PointMotion::new(forward, Jet::constant(self.hip_distance), height)
    }
}

impl LegPath for PendulumPath {
    fn pelvis(&self, progress: Jet) -> PointMotion {
        let Parameters { step_length, pelvis_setback, hip_height, .. } = self.parameters;
        let (sinh_at_end, _) = sinh_cosh(self.phase / 2.0);
        let forward = ((progress - 0.5) * self.phase).sinh() * (step_length / 2.0 / sinh_at_end) - pelvis_setback;
        PointMotion::new(forward, self.pelvis_y(progress), Jet::constant(hip_height))
    }

    fn swing_sole(&self, progress: Jet) -> PointMotion {
        self.swing_at(progress.smooth_step(), progress.bump() * self.parameters.clearance)
    }
}
