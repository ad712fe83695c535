//! The reply to a request.

use model::Joint;

use crate::{Command, Intent, LatchedFault, Mode, Reason, Source, SteadyWalk, Verdict};

/// The reply to a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The request's [`id`](crate::Request::id).
    pub id: u64,
    /// Accepted, limited or refused.
    pub verdict: Verdict,
    /// Why it was limited or refused; [`Reason::None`] if it was accepted.
    pub reason: Reason,
    /// The half-step, counted from 0, at which all of it is in effect; the present one if nothing changes.
    pub effect_half_step: u64,
    /// Gait parameters in force from then on; after a refusal, those in force already.
    pub granted: Command,
    /// What these gait parameters come to once the walk is steady; on the way to way-points the largest steps and
    /// speeds, each alone.
    pub walk: SteadyWalk,
    /// The intent in force from then on, if the controller has received one.
    pub intent: Option<Intent>,
    /// The limit that restricted the request, if the reason is a limit.
    pub active_limit: Option<ActiveLimit>,
    /// The way-point or footstep that the reason is about, counted from 1.
    pub place: Option<u32>,
    /// Foreseen time until the robot stands at its destination (s); `None` without one, and if it is far away.
    pub arrival: Option<f64>,
    /// The source that outranks the request's, if the reason is [`Reason::Outranked`]; of a granted request, another
    /// source whose stream stays in control: its timeout still stops the robot, unless that walks to the destination of
    /// a source of higher priority.
    pub authority: Option<ControlAuthority>,
    /// Least predicted distance of the ZMP to the edge of the support polygon (m), negative outside; `None` if nothing
    /// was predicted.
    pub predicted_margin: Option<f64>,
    /// What the controller is doing; `None` before its first tick.
    pub mode: Option<Mode>,
    /// The fault that is latched, if any, and since when.
    pub latched: Option<LatchedFault>,
}

/// A limit, and by what it would have been exceeded. Both numbers have the unit of the [`Reason`]: rad for turn,
/// extension and joint range, rad/s for joint rate, N·m for torque, V for voltage, m for margin, clearance and reach;
/// speed is a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveLimit {
    /// The physical joint whose limit it is, if it is a joint's.
    pub joint: Option<Joint>,
    /// What the request would have needed.
    pub value: f64,
    /// What is permitted.
    pub limit: f64,
}

/// Why a request cannot be granted as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Objection {
    /// The reason.
    pub reason: Reason,
    /// The limit in numbers, if the reason is a limit.
    pub active_limit: Option<ActiveLimit>,
}

/// The source in control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlAuthority {
    /// The source that has control authority.
    pub source: Source,
    /// Time until its authority expires if it sends nothing more (s).
    pub remaining: f64,
}

impl Reply {
    /// A refusal that leaves `granted` and `intent` in force.
    pub const fn refused(reason: Reason, effect_half_step: u64, granted: Command, intent: Option<Intent>) -> Self {
        Self {
            id: 0,
            verdict: Verdict::Refused,
            reason,
            effect_half_step,
            granted,
            walk: SteadyWalk::ZERO,
            intent,
            active_limit: None,
            place: None,
            arrival: None,
            authority: None,
            predicted_margin: None,
            mode: None,
            latched: None,
        }
    }
}
