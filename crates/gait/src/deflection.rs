//! A modification in pairs of half-steps: one deflects, the next restores.
//!
//! A turn or a sidestep can only lead with the foot on its own side: the other one would be in the way. So to the left
//! it deflects while the robot stands on its right foot, to the right while it stands on the left one, and in canonical
//! coordinates either offset is positive, away from the other foot. The half-step after it takes the offset back.

use model::{JointVector, Motion, Side};

use crate::{Ramp, RampKind, RampState};

/// The part of a half-step in a modification of half-step pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeflectionPhase {
    /// The feet stay as in the nominal.
    Straight,
    /// The swing foot lands away from where the nominal puts it.
    Deflect,
    /// The deflection is removed.
    Restore,
}

/// A [turn](Self::turn) or a [sidestep](Self::sidestep): an angle per full step, positive to the left, and its share on
/// either leg in the present half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deflection {
    /// One on each joint that deflects, with the sign that brings the feet apart.
    apart: JointVector,
    /// Shape of the ramps.
    kind: RampKind,
    /// As commanded (rad).
    angle: f64,
    /// The part of the present half-step.
    phase: DeflectionPhase,
    /// Offset of either leg over progress (rad).
    ramp: Ramp,
}

impl Deflection {
    /// No deflection yet.
    ///
    /// * `apart` – one on each joint that deflects, with the sign that brings the feet apart
    pub(crate) fn new(apart: JointVector, kind: RampKind) -> Self {
        Self { apart, kind, angle: 0.0, phase: DeflectionPhase::Straight, ramp: Ramp::hold(0.0) }
    }

    /// As commanded (rad per full step).
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// The part of the present half-step.
    pub fn phase(&self) -> DeflectionPhase {
        self.phase
    }

    /// Commands another angle (rad per full step), from the next deflecting half-step on.
    pub fn request(&mut self, angle: f64) {
        self.angle = angle;
    }

    /// Number of half-steps from the present one, on `support`, until a change to `angle` takes effect: where the next
    /// deflection for it begins; for a change to zero, where the next deflection is omitted.
    pub fn delay(&self, angle: f64, support: Side) -> u64 {
        let (delay, foot) = match self.phase {
            DeflectionPhase::Deflect => (2, support),
            DeflectionPhase::Straight | DeflectionPhase::Restore => (1, support.other()),
        };
        let deflecting = deflecting_support(if angle == 0.0 { self.angle } else { angle });
        if deflecting.is_some_and(|deflecting| deflecting != foot) { delay + 1 } else { delay }
    }

    /// Begins a half-step on `support`. After a deflection it restores, whatever the command.
    pub fn begin_half_step(&mut self, support: Side) {
        use DeflectionPhase::{Deflect, Restore, Straight};
        self.phase = match self.phase {
            Deflect => Restore,
            Straight | Restore if deflecting_support(self.angle) == Some(support) => Deflect,
            Straight | Restore => Straight,
        };
        let to = if self.phase == Deflect { 0.5 * self.angle.abs() } else { 0.0 };
        self.ramp = Ramp::new(self.kind, self.ramp.end(), to);
    }

    /// Lets the present half-step on `support` end as the angle commanded last asks for, from a progress on. Returns
    /// whether that angle is in effect in it; a half-step that restores goes on restoring.
    pub(crate) fn redirect(&mut self, support: Side, progress: f64) -> bool {
        use DeflectionPhase::{Deflect, Restore, Straight};
        let leads = deflecting_support(self.angle) == Some(support);
        if self.phase != Restore {
            let to = if leads { 0.5 * self.angle.abs() } else { 0.0 };
            self.phase = if leads { Deflect } else { Straight };
            self.ramp = self.ramp.redirected(self.kind, progress, to);
        }
        self.phase == Deflect || self.angle == 0.0
    }

    /// Ends the present half-step with another offset of either hip than commanded (rad), from where it began. The
    /// next half-step restores.
    pub(crate) fn aim(&mut self, per_hip: f64) {
        use DeflectionPhase::{Deflect, Restore, Straight};
        let began = self.ramp.at(0.0);
        self.phase = match per_hip {
            0.0 if began.value == 0.0 => Straight,
            0.0 => Restore,
            _ => Deflect,
        };
        self.ramp = Ramp::new(self.kind, began, per_hip);
    }

    /// The offset of either hip at `progress` (rad), with derivatives by progress.
    pub fn per_hip(&self, progress: f64) -> RampState {
        self.ramp.at(progress)
    }

    /// The offsets of all joints at `progress`, canonical, at nominal speed in a half-step of `duration` (s).
    pub fn at(&self, progress: f64, duration: f64) -> Motion {
        let per_hip = self.per_hip(progress).by(duration.recip());
        Motion {
            angles: self.apart * per_hip.value,
            rates: self.apart * per_hip.rate,
            accelerations: self.apart * per_hip.acceleration,
        }
    }
}

/// The support foot while the other foot leads; `None` when there is no deflection.
fn deflecting_support(angle: f64) -> Option<Side> {
    if angle > 0.0 {
        Some(Side::Right)
    } else if angle < 0.0 {
        Some(Side::Left)
    } else {
        None
    }
}
