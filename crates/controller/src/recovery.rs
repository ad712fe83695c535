//! Recovery: after a fall and a reset the joints move slowly from where they are held to a stand.

use model::{JointVector, Motion};
use signal::smooth_step;

/// How long it takes (s).
const DURATION: f64 = 3.0;

/// The motion from one posture to another, by physical joint.
#[derive(Clone, Debug)]
pub(crate) struct Recovery {
    from: JointVector,
    to: JointVector,
    elapsed: f64,
}

impl Recovery {
    /// Begins at the posture `from` and ends at the posture `to` (rad).
    pub(crate) fn begin(from: &JointVector, to: &JointVector) -> Self {
        Self { from: *from, to: *to, elapsed: 0.0 }
    }

    /// Moves on by `dt` (s) and returns the commanded motion; `None` when it has arrived.
    pub(crate) fn advance(&mut self, dt: f64) -> Option<Motion> {
        let before = self.posture();
        self.elapsed += dt;
        let rates = (self.posture() - before) * (1.0 / dt);
        (self.elapsed < DURATION).then(|| Motion { rates, ..Motion::at_rest(self.posture()) })
    }

    fn posture(&self) -> JointVector {
        self.from + (self.to - self.from) * smooth_step((self.elapsed / DURATION).min(1.0))
    }
}
