//! From when on the robot obeys a controller, and which setpoint it obeys.

use interface::{Measurement, Setpoint};
use model::JointVector;

use crate::Plant;

/// Largest differences of a setpoint from the initial posture (rad) and its rates (rad/s) with which the robot is let
/// go.
const RELEASE_TOLERANCE: [f64; 2] = [0.05, 0.3];

/// The last setpoint, and whether the robot is let go. It is held where it is until a controller begins there: one that
/// commands another posture would throw the robot over, and one that only keeps the joints where they are balances
/// nothing.
#[derive(Clone, Copy, Debug)]
pub struct Obedience {
    initial: Setpoint,
    setpoint: Setpoint,
    is_held: bool,
}

impl Obedience {
    /// Of a plant that has heard nothing yet.
    pub fn of(plant: &Plant) -> Self {
        let initial = Setpoint { angles: plant.robot.angles, rates: plant.robot.rates, ..Setpoint::default() };
        Self { initial, setpoint: initial, is_held: true }
    }

    /// Takes the next setpoint.
    pub fn hear(&mut self, setpoint: &Setpoint) {
        self.setpoint = *setpoint;
    }

    /// Moves the plant on by a control period with the last setpoint: holds it, or calls `step` for its physics.
    ///
    /// # Errors
    /// That of `step`.
    pub fn obey<E>(
        &mut self,
        plant: &mut Plant,
        step: impl FnOnce(&mut Plant, &Setpoint) -> Result<Measurement, E>,
    ) -> Result<Measurement, E> {
        self.is_held &= self.only_holds() || !self.begins();
        if self.is_held { Ok(plant.hold()) } else { step(plant, &self.setpoint) }
    }

    /// Whether the setpoint is near the initial posture, and as fast.
    fn begins(&self) -> bool {
        let Self { initial, setpoint, .. } = self;
        let [angle, rate] = RELEASE_TOLERANCE;
        (setpoint.angles - initial.angles).max_abs() <= angle && (setpoint.rates - initial.rates).max_abs() <= rate
    }

    /// Whether the setpoint does no more than keep the joints where they are, as after a fault.
    fn only_holds(&self) -> bool {
        self.setpoint.rates == JointVector::ZERO && self.setpoint.feed_forward == JointVector::ZERO
    }
}
