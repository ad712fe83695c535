//! The operating state: what moves the joints, and every transition of it.
//!
//! | from | event | to |
//! |---|---|---|
//! | any | the trunk stays tilted beyond recovery | fallen, latched: no joint moves |
//! | gait, recovering | a measurement times out, a setpoint is not finite | the same, latched; a walk stops in stride |
//! | fallen | reset while upright and measured | recovering, intent stop |
//! | gait, latched | reset while upright and measured | gait |
//! | recovering | the joints have arrived | gait, standing |
//!
//! Within the gait, the transitions between standing, starting, walking, stepping in place and stopping are
//! [`GaitState`](pattern::GaitState)'s. The [`Mode`] that is reported follows from both.

use interface::{Fault, Intent, Mode};
use model::Motion;
use pattern::{GaitPhase, Stance};

use crate::recovery::Recovery;

/// What moves the joints.
// The loop must not allocate a box for the largest.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug)]
enum Activity {
    /// The gait pattern is played.
    Gait,
    /// After a fall, or found in a posture that is none of the gait's: the joints hold.
    HoldingPosture,
    /// After a reset, or found near a stand: the joints move to the stand.
    Recovering(Recovery),
}

/// What moves the joints, what is intended, and which fault is latched.
#[derive(Clone, Debug)]
pub(crate) struct OperatingState {
    activity: Activity,
    /// What is intended.
    intent: Intent,
    /// The fault that keeps the robot from walking on until a reset.
    latched: Option<Fault>,
}

impl OperatingState {
    /// A gait is played with an intent.
    pub(crate) fn new(intent: Intent) -> Self {
        Self { activity: Activity::Gait, intent, latched: None }
    }

    /// What is intended.
    pub(crate) fn intent(&self) -> Intent {
        self.intent
    }

    /// Another intent is granted.
    pub(crate) fn set_intent(&mut self, intent: Intent) {
        self.intent = intent;
    }

    /// The fault that is latched, if any.
    pub(crate) fn latched(&self) -> Option<Fault> {
        self.latched
    }

    /// Whether the robot has fallen and was not reset since.
    pub(crate) fn has_fallen(&self) -> bool {
        self.holds_posture() && self.latched == Some(Fault::Fallen)
    }

    /// Whether the joints hold a posture that is none of the gait's.
    pub(crate) fn holds_posture(&self) -> bool {
        matches!(self.activity, Activity::HoldingPosture)
    }

    /// Whether the joints move to a stand.
    pub(crate) fn is_recovering(&self) -> bool {
        matches!(self.activity, Activity::Recovering(_))
    }

    /// Whether the gait pattern is played.
    pub(crate) fn plays_gait(&self) -> bool {
        matches!(self.activity, Activity::Gait)
    }

    /// Latches a fall.
    pub(crate) fn fall(&mut self) {
        self.activity = Activity::HoldingPosture;
        self.latched = Some(Fault::Fallen);
    }

    /// Holds the posture in which the robot was found until a reset, and latches `fault` if none is latched.
    pub(crate) fn hold_posture(&mut self, fault: Fault) {
        self.activity = Activity::HoldingPosture;
        self.latched = self.latched.or(Some(fault));
    }

    /// Latches another fault than a fall, and returns whether a walk has to be stopped because of it. While a posture
    /// is held nothing changes.
    pub(crate) fn latch(&mut self, fault: Fault) -> bool {
        if self.holds_posture() {
            return false;
        }
        self.latched = Some(fault);
        self.intent.steps()
    }

    /// Clears a latched fault after which the gait goes on.
    pub(crate) fn clear_fault(&mut self) {
        self.latched = None;
    }

    /// Clears a fall: the joints return to a stand.
    pub(crate) fn recover(&mut self, recovery: Recovery) {
        *self = Self { activity: Activity::Recovering(recovery), intent: Intent::Stop, latched: None };
    }

    /// Moves a recovery on by `dt` (s) and returns its motion, by physical joint; `None` once the gait is played.
    pub(crate) fn advance_recovery(&mut self, dt: f64) -> Option<Motion> {
        let Activity::Recovering(recovery) = &mut self.activity else { return None };
        let motion = recovery.advance(dt);
        if motion.is_none() {
            self.activity = Activity::Gait;
        }
        motion
    }

    /// The mode to report while the gait is in `phase`.
    pub(crate) fn mode(&self, phase: GaitPhase) -> Mode {
        match (&self.activity, phase) {
            (Activity::HoldingPosture, _) if self.latched == Some(Fault::Fallen) => Mode::Fallen,
            (Activity::HoldingPosture, _) => Mode::Faulted,
            (Activity::Recovering(_), _) => Mode::Starting,
            (Activity::Gait, GaitPhase::Standing(_)) if self.latched.is_some() => Mode::Faulted,
            (Activity::Gait, GaitPhase::Standing(Stance::Parallel)) => Mode::Standing,
            (Activity::Gait, GaitPhase::Standing(Stance::Stride)) => Mode::Holding,
            (Activity::Gait, GaitPhase::Starting) => Mode::Starting,
            (Activity::Gait, GaitPhase::Walking) => Mode::Walking,
            (Activity::Gait, GaitPhase::InPlace) => Mode::InPlace,
            (Activity::Gait, GaitPhase::Stopping) => Mode::Stopping,
        }
    }
}
