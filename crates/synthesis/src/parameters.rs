//! The parameters of the half-step and their defaults, which make `config/nominal_half_step.csv`.

use crate::SynthesisError;

/// What the half-step shall be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Distance between the feet at the swap; the swing foot travels twice as far [m].
    pub step_length: f64,
    /// `T` [s].
    pub duration: f64,
    /// Greatest height of the swing sole above the ground [m].
    pub clearance: f64,
    /// Hip joints above the ground; at the swap, where it varies [m]. Lower bends the knees and leaves room for longer
    /// steps.
    pub hip_height: f64,
    /// How far the pelvis moves towards the support foot, between the swap and the middle of the half-step [m]. The
    /// centre of mass has to; what the pelvis leaves out, trunk roll makes up for.
    pub pelvis_sway: f64,
    /// How far the pelvis stays behind the middle between the feet at the swap [m]. Bent knees carry the thighs ahead, and
    /// without setback the trunk leans back in return (13° by default); but with it front and rear leg are unlike at the
    /// swap, so that a step extended by `β` ends with the foot `setback · β` above the ground.
    pub pelvis_setback: f64,
    /// Height of the inverted pendulum after whose motion the pelvis moves forward [m]: how much it slows down over the
    /// support foot. The centre of mass has to; what the pelvis leaves out, trunk pitch makes up for. The swing leg changes
    /// it, so that the height which keeps the trunk stillest is not the centre of mass's.
    pub pendulum_height: f64,
    /// Shoulder swing to either side, against the legs [rad].
    pub arm_swing: f64,
    /// How far the elbows are bent [rad].
    pub elbow_flexion: f64,
    /// `n_int`: intervals of the table.
    pub intervals: usize,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            step_length: 0.25,
            duration: 0.6,
            clearance: 0.05,
            hip_height: 0.88,
            pelvis_sway: 0.035,
            pelvis_setback: 0.03,
            pendulum_height: 0.65,
            arm_swing: 15_f64.to_radians(),
            elbow_flexion: 20_f64.to_radians(),
            intervals: 60,
        }
    }
}

impl Parameters {
    /// Refuses what no walk can be made of.
    ///
    /// # Errors
    /// [`SynthesisError::ParameterOutOfRange`] names the first parameter that is out of range.
    pub fn check(&self) -> Result<(), SynthesisError> {
        let ranges = [
            ("step length [m]", self.step_length, 0.0, 1.0),
            ("duration [s]", self.duration, 0.1, 3.0),
            ("clearance [m]", self.clearance, 0.001, 0.3),
            ("hip height [m]", self.hip_height, 0.1, 2.0),
            ("pelvis sway [m]", self.pelvis_sway, 0.0, 0.2),
            ("pelvis setback [m]", self.pelvis_setback, -0.1, 0.1),
            ("pendulum height [m]", self.pendulum_height, 0.3, 3.0),
            ("arm swing [degrees]", self.arm_swing.to_degrees(), -60.0, 60.0),
            ("elbow flexion [degrees]", self.elbow_flexion.to_degrees(), 0.0, 120.0),
            ("intervals", self.intervals as f64, 20.0, 1000.0),
        ];
        for (name, value, min, max) in ranges {
            if !(min..=max).contains(&value) {
                return Err(SynthesisError::ParameterOutOfRange { name, value, min, max });
            }
        }
        Ok(())
    }
}
