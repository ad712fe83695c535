//! Rising: after a reset the joints go from wherever they were held to a stand, slowly.

use balance::preview::smooth_step;
use model::{JointVector, Motion};

/// How long it takes [s].
const DURATION: f64 = 3.0;

/// The way from one posture to another, in physical joints.
#[derive(Clone, Debug)]
pub struct Rising {
    from: JointVector,
    to: JointVector,
    elapsed: f64,
}

impl Rising {
    /// Begins.
    pub fn begin(from: &JointVector, to: &JointVector) -> Self {
        Self { from: *from, to: *to, elapsed: 0.0 }
    }

    /// Moves on by `dt` [s]; `None` when it has arrived.
    pub fn advance(&mut self, dt: f64) -> Option<Motion> {
        let before = self.posture();
        self.elapsed += dt;
        let rates = (self.posture() - before) * (1.0 / dt);
        (self.elapsed < DURATION).then(|| Motion { rates, ..Motion::at_rest(self.posture()) })
    }

    fn posture(&self) -> JointVector {
        self.from + (self.to - self.from) * smooth_step((self.elapsed / DURATION).min(1.0))
    }
}
