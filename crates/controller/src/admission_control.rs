//! Admission control: one request at a time, from its submission to its reply.

use interface::{Command, Intent, Reason, Reply, Request, Source, SteadyWalk, Verdict};
use pattern::PatternGenerator;

use crate::admission_job::{AdmissionJob, Decision};
use crate::localization::Localization;

/// The state of the one request that may be under evaluation.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "nothing is allocated for a request")]
enum Pending {
    /// No request is under evaluation.
    Idle(Box<AdmissionJob>),
    /// A job waits to be taken.
    Ready(Box<AdmissionJob>),
    /// The job was taken and has not come back.
    InProgress,
    /// The job was taken; its result no longer matters. Another request may wait for the job.
    Cancelled(Option<Request>),
}

/// Admission control.
#[derive(Clone, Debug)]
pub(crate) struct AdmissionControl {
    pending: Pending,
    /// The source of the request under evaluation.
    source: Option<Source>,
    /// Waits for the next tick.
    reply: Option<Reply>,
    /// The reply to the request whose evaluation was cancelled; waits for the next tick.
    superseded: Option<Reply>,
}

impl AdmissionControl {
    /// No request yet; jobs are evaluated with `job`.
    pub(crate) fn new(job: AdmissionJob) -> Self {
        Self { pending: Pending::Idle(Box::new(job)), source: None, reply: None, superseded: None }
    }

    /// Whether any request can be submitted: the one before has been replied to.
    pub(crate) fn is_idle(&self) -> bool {
        matches!(self.pending, Pending::Idle(_)) && self.reply.is_none()
    }

    /// Whether there is a reply for the next tick.
    pub(crate) fn has_reply(&self) -> bool {
        self.reply.is_some()
    }

    /// The source that waits for the reply to its request, if any.
    pub(crate) fn waiting(&self) -> Option<Source> {
        self.source
    }

    /// Replies with the next tick.
    pub(crate) fn reply(&mut self, reply: Reply) {
        self.reply = Some(reply);
    }

    /// The reply for this tick, if there is one.
    pub(crate) fn take_reply(&mut self) -> Option<Reply> {
        self.reply.take()
    }

    /// The reply of this tick to a cancelled request, if there is one.
    pub(crate) fn take_superseded(&mut self) -> Option<Reply> {
        self.superseded.take()
    }

    /// Opens a job for a request, at once or when a cancelled one has come back.
    pub(crate) fn open(&mut self, generator: &PatternGenerator, localization: &Localization, request: &Request) {
        self.source = Some(request.source);
        self.pending = match std::mem::replace(&mut self.pending, Pending::InProgress) {
            Pending::Idle(mut job) => {
                job.open(generator, localization, request);
                Pending::Ready(job)
            }
            Pending::Cancelled(_) => Pending::Cancelled(Some(*request)),
            busy @ (Pending::Ready(_) | Pending::InProgress) => busy,
        };
    }

    /// Cancels the evaluation of a request, if one is under evaluation, and replies `refusal` to it.
    pub(crate) fn cancel(&mut self, refusal: Reply) {
        if self.source.take().is_some() {
            self.superseded = Some(refusal);
        }
        self.pending = match std::mem::replace(&mut self.pending, Pending::InProgress) {
            Pending::Idle(job) | Pending::Ready(job) => Pending::Idle(job),
            Pending::InProgress | Pending::Cancelled(_) => Pending::Cancelled(None),
        };
    }

    /// Whether the job that was taken no longer matters.
    pub(crate) fn is_cancelled(&self) -> bool {
        matches!(self.pending, Pending::Cancelled(_))
    }

    /// The job that is to be evaluated, if there is one. It waits while a reply does, so that no tick has two.
    pub(crate) fn take_job(&mut self) -> Option<Box<AdmissionJob>> {
        if self.has_reply() {
            return None;
        }
        match std::mem::replace(&mut self.pending, Pending::InProgress) {
            Pending::Ready(job) => Some(job),
            other => {
                self.pending = other;
                None
            }
        }
    }

    /// The job is done with. Opens it again for the request that waits for it, if one does.
    pub(crate) fn finish(&mut self, mut job: Box<AdmissionJob>, present: Option<(&PatternGenerator, &Localization)>) {
        self.pending = match (&self.pending, present) {
            (Pending::Cancelled(Some(next)), Some((generator, localization))) => {
                job.open(generator, localization, next);
                Pending::Ready(job)
            }
            _ => {
                self.source = None;
                Pending::Idle(job)
            }
        };
    }

    /// The plan has changed meanwhile: the job is to be evaluated again.
    pub(crate) fn reopen(
        &mut self,
        mut job: Box<AdmissionJob>,
        generator: &PatternGenerator,
        localization: &Localization,
    ) {
        job.renew(generator, localization);
        self.pending = Pending::Ready(job);
    }
}

impl Decision {
    /// The reply that tells it, with the intent in force then.
    pub(crate) fn reply(&self, intent: Intent) -> Reply {
        let Self { verdict, granted, effect_half_step, objection, predicted_margin, place, arrival, walk } = *self;
        Reply {
            walk: walk.unwrap_or(SteadyWalk::ZERO),
            id: 0,
            verdict,
            reason: objection.map_or(Reason::None, |objection| objection.reason),
            effect_half_step,
            granted,
            intent: Some(intent),
            active_limit: objection.and_then(|objection| objection.active_limit),
            place,
            arrival,
            authority: None,
            predicted_margin,
            mode: None,
            latched: None,
        }
    }

    /// The decision on a change that needs no simulation.
    pub(crate) fn at_once(admission: &gait::RangeCheck) -> Self {
        let gait::RangeCheck { verdict, objection, granted, effect_half_step } = *admission;
        Self { verdict, objection, ..Self::unchanged(granted, effect_half_step) }
    }

    /// The decision on a request that changes no gait parameter.
    pub(crate) fn unchanged(granted: Command, effect_half_step: u64) -> Self {
        Self {
            verdict: Verdict::Accepted,
            granted,
            effect_half_step,
            objection: None,
            predicted_margin: None,
            place: None,
            arrival: None,
            walk: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use interface::{ActiveLimit, Objection};

    use super::*;

    #[test]
    fn a_limited_decision_is_replied_with_its_limit() {
        let active_limit = Some(ActiveLimit { joint: None, value: 9.0, limit: 1.4 });
        let objection = Some(Objection { reason: Reason::SpeedLimit, active_limit });
        let decision = Decision { verdict: Verdict::Limited, objection, ..Decision::unchanged(Command::NOMINAL, 7) };
        let reply = decision.reply(Intent::Walk);
        assert_eq!((reply.verdict, reply.reason, reply.effect_half_step), (Verdict::Limited, Reason::SpeedLimit, 7));
        assert_eq!((reply.active_limit, reply.intent, reply.authority), (active_limit, Some(Intent::Walk), None));
    }
}
