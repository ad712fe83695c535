//! Whether the robot can still be kept from falling: by its ankles, by steps, or not.
//!
//! Two things fell a robot that is pushed. Either its divergent component of motion runs away faster than any landing
//! can follow, or its body tips over the edge of a sole, where steps land on their edges, too. What the best step
//! leaves of the first, and the tilt of the body, each as a share of what is mostly survived, add up.

use interface::Capturability;
use model::Mechanism;
use signal::LowPass;

use crate::proportions::StabilizerProportions;

/// Sees how far a robot is from being kept from falling.
#[derive(Clone, Debug)]
pub struct CapturabilityEstimator {
    proportions: StabilizerProportions,
    /// What the best step leaves of the error of the divergent component (m), as last known.
    shortfall: f64,
    /// How much of what can be survived is used up (-).
    share: LowPass<f64>,
    is_recovering: bool,
}

/// What capturability is judged by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CaptureEvidence {
    /// Whether steps answer a push.
    pub is_recovering: bool,
    /// What the best step, or in a stand both feet, leave of the error of the divergent component (m); `None` late in a
    /// half-step, when it stays as it was.
    pub shortfall: Option<f64>,
    /// Whether steps can correct the rest.
    pub can_step: bool,
    /// Tilt of the body beyond the plan (rad).
    pub tilt: f64,
}

/// Tilt of the body that is mostly not survived (rad): of 480 pushes around the limit of the paper's robot.
const TILT_LOST: f64 = 0.26;
/// Time constant of the judgement (s): longer than noise, shorter than a push.
const TIME_CONSTANT: f64 = 0.01;

impl CapturabilityEstimator {
    /// An estimator of a robot that is balanced.
    pub fn new(mechanism: &Mechanism) -> Self {
        Self {
            proportions: StabilizerProportions::of(mechanism),
            shortfall: 0.0,
            share: LowPass::new(TIME_CONSTANT, 0.0),
            is_recovering: false,
        }
    }

    /// Absorbs what is known after `dt` (s).
    pub fn update(&mut self, evidence: &CaptureEvidence, dt: f64) {
        let StabilizerProportions { shortfall_lost, shortfall_lost_in_stand, .. } = self.proportions;
        let most = if evidence.can_step { shortfall_lost } else { shortfall_lost_in_stand };
        self.shortfall = evidence.shortfall.unwrap_or(self.shortfall);
        self.is_recovering = evidence.is_recovering;
        self.share.update(self.shortfall / most + evidence.tilt / TILT_LOST, dt);
    }

    /// What it takes to keep the robot from falling.
    pub fn capturability(&self) -> Capturability {
        if self.share.value() > 1.0 {
            Capturability::Lost
        } else if self.is_recovering {
            Capturability::BySteps
        } else {
            Capturability::ByAnkles
        }
    }
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    fn after(evidence: CaptureEvidence) -> Capturability {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mut estimator = CapturabilityEstimator::new(&Mechanism::load(file).unwrap());
        for _ in 0..100 {
            estimator.update(&evidence, 1e-3);
        }
        estimator.capturability()
    }

    #[test]
    fn a_robot_is_balanced_catches_itself_or_falls() {
        use Capturability::{ByAnkles, BySteps, Lost};
        let walking = CaptureEvidence { can_step: true, shortfall: Some(0.0), ..CaptureEvidence::default() };
        let pushed = CaptureEvidence { is_recovering: true, ..walking };
        let seen = [
            walking,
            pushed,
            CaptureEvidence { shortfall: Some(0.1), tilt: 0.1, ..pushed },
            CaptureEvidence { shortfall: Some(0.2), tilt: 0.2, ..pushed },
            CaptureEvidence { tilt: 0.4, ..walking },
        ];
        assert_eq!(seen.map(after), [ByAnkles, BySteps, BySteps, Lost, Lost]);
    }

    #[test]
    fn a_stand_that_cannot_step_is_lost_sooner() {
        let beyond_the_feet = CaptureEvidence { shortfall: Some(0.06), ..CaptureEvidence::default() };
        let seen = [false, true].map(|can_step| after(CaptureEvidence { can_step, ..beyond_the_feet }));
        assert_eq!(seen, [Capturability::Lost, Capturability::ByAnkles]);
    }

    #[test]
    fn what_a_step_leaves_stays_known_until_the_next_can_be_judged() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mut estimator = CapturabilityEstimator::new(&Mechanism::load(file).unwrap());
        let pushed = CaptureEvidence { is_recovering: true, shortfall: Some(0.5), can_step: true, tilt: 0.0 };
        for shortfall in [Some(0.5), None] {
            for _ in 0..100 {
                estimator.update(&CaptureEvidence { shortfall, ..pushed }, 1e-3);
            }
            assert_eq!(estimator.capturability(), Capturability::Lost);
        }
    }
}
