//! The parameters of the half-step, and their defaults, from which `config/nominal_half_step.csv` is made.

use model::{Joint, LegReach, Mechanism};

use crate::SynthesisError;

/// Length from hip to ankle of the robot for which the defaults were chosen (m).
const DEFAULT_LEG: f64 = 0.856;
/// Height of its ankle above the sole (m).
const DEFAULT_ANKLE: f64 = 0.07;
/// Shortest half-step (s).
const TIME_MIN: f64 = 0.05;

/// What moves so that the ground reaction stays in O.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Balance {
    /// The trunk where there is a waist that pitches and rolls, else the pelvis.
    #[default]
    Auto,
    /// The trunk.
    Trunk,
    /// The pelvis, with the trunk upright.
    Pelvis,
}

impl Balance {
    /// What moves in a robot.
    pub(crate) fn of(self, mechanism: &Mechanism) -> Result<Balance, SynthesisError> {
        let has_waist = [Joint::WaistPitch, Joint::WaistRoll].into_iter().all(|joint| mechanism.has(joint));
        match self {
            Balance::Trunk if !has_waist => Err(SynthesisError::NoWaist),
            Balance::Auto if has_waist => Ok(Balance::Trunk),
            Balance::Auto => Ok(Balance::Pelvis),
            other => Ok(other),
        }
    }
}

/// The parameters of a half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynthesisParameters {
    /// Distance between the feet at the support change (m); the swing foot travels twice as far.
    pub step_length: f64,
    /// Duration `T` of the half-step (s).
    pub duration: f64,
    /// Greatest height of the swing sole above the ground (m).
    pub clearance: f64,
    /// Height of the hip joints above the ground (m); at the support change, where it varies. Lower hips bend the knees
    /// and leave room for longer steps.
    pub hip_height: f64,
    /// Sway of the pelvis towards the support foot, between the support change and the middle of the half-step (m). The
    /// centre of mass has to sway; trunk roll makes up for what the pelvis leaves out.
    pub pelvis_sway: f64,
    /// Distance of the pelvis behind the middle between the feet at the support change (m). Bent knees carry the thighs
    /// ahead, and without setback the trunk leans back in return (13° by default); but with it front and rear leg
    /// differ at the support change, so that a step extended by `β` ends with the foot `setback · β` above the ground.
    pub pelvis_setback: f64,
    /// Height of the inverted pendulum whose forward motion the pelvis copies (m): it determines how much the pelvis
    /// slows down over the support foot. The centre of mass has to slow down; trunk pitch makes up for what the pelvis
    /// leaves out. Because of the swing leg, the height that keeps the trunk stillest is not that of the centre of
    /// mass.
    pub pendulum_height: f64,
    /// Amplitude of the shoulders' swing, opposite to the legs (rad).
    pub arm_swing: f64,
    /// Flexion of the elbows (rad).
    pub elbow_flexion: f64,
    /// `n_int`: number of intervals of the table.
    pub intervals: usize,
    /// What moves so that the ground reaction stays in O.
    pub balance: Balance,
}

impl Default for SynthesisParameters {
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
            balance: Balance::Auto,
        }
    }
}

impl SynthesisParameters {
    /// The default half-step in a robot's proportions: lengths scale as the leg, times as its square root (Froude's
    /// law).
    pub fn for_robot(mechanism: &Mechanism) -> Self {
        let default = Self::default();
        let scale = LegReach::of(mechanism).length() / DEFAULT_LEG;
        // What a person would type.
        let rounded = |value: f64| (value * 1e4).round() / 1e4;
        Self {
            step_length: rounded(default.step_length * scale),
            duration: rounded(default.duration * scale.sqrt()),
            clearance: rounded(default.clearance * scale),
            hip_height: rounded(mechanism.sole.ankle_height + (default.hip_height - DEFAULT_ANKLE) * scale),
            pelvis_sway: rounded(default.pelvis_sway * scale),
            pelvis_setback: rounded(default.pelvis_setback * scale),
            pendulum_height: rounded(default.pendulum_height * scale),
            ..default
        }
    }

    /// Checks that a walk can have these parameters.
    ///
    /// # Errors
    /// [`SynthesisError::ParameterOutOfRange`] names the first parameter that is out of range.
    pub fn check(&self) -> Result<(), SynthesisError> {
        let ranges = [
            ("step length [m]", self.step_length, 0.0, 1.0),
            ("duration [s]", self.duration, TIME_MIN, 3.0),
            ("clearance [m]", self.clearance, 0.001, 0.3),
            ("hip height [m]", self.hip_height, 0.05, 3.0),
            ("pelvis sway [m]", self.pelvis_sway, 0.0, 0.2),
            ("pelvis setback [m]", self.pelvis_setback, -0.1, 0.1),
            ("pendulum height [m]", self.pendulum_height, 0.03, 5.0),
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
