//! Admission control: one request at a time, from its submission to its reply.

use interface::{Command, Intent, Reason, Reply, Request, Verdict};
use pattern::PatternGenerator;

use crate::admission_job::{AdmissionJob, Decision};

/// The state of the one request that may be under evaluation.
#[derive(Clone, Debug)]
enum Pending {
    /// No request is under evaluation.
    Idle(Box<AdmissionJob>),
    /// A job waits to be taken.
    Ready(Box<AdmissionJob>),
    /// The job was taken and has not come back.
    InProgress,
}

/// Admission control.
#[derive(Clone, Debug)]
pub(crate) struct AdmissionControl {
    pending: Pending,
    /// Waits for the next tick.
    reply: Option<Reply>,
}

impl AdmissionControl {
    /// No request yet; jobs are evaluated with `job`.
    pub(crate) fn new(job: AdmissionJob) -> Self {
        Self { pending: Pending::Idle(Box::new(job)), reply: None }
    }

    /// Whether a request can be submitted: the one before has been replied to.
    pub(crate) fn is_idle(&self) -> bool {
        matches!(self.pending, Pending::Idle(_)) && self.reply.is_none()
    }

    /// Replies with the next tick.
    pub(crate) fn reply(&mut self, reply: Reply) {
        self.reply = Some(reply);
    }

    /// The reply for this tick, if there is one.
    pub(crate) fn take_reply(&mut self) -> Option<Reply> {
        self.reply.take()
    }

    /// Opens a job for a request.
    pub(crate) fn open(&mut self, generator: &PatternGenerator, request: &Request) {
        self.pending = match std::mem::replace(&mut self.pending, Pending::InProgress) {
            Pending::Idle(mut job) => {
                job.open(generator, request);
                Pending::Ready(job)
            }
            busy => busy,
        };
    }

    /// The job that is to be evaluated, if there is one.
    pub(crate) fn take_job(&mut self) -> Option<Box<AdmissionJob>> {
        match std::mem::replace(&mut self.pending, Pending::InProgress) {
            Pending::Ready(job) => Some(job),
            other => {
                self.pending = other;
                None
            }
        }
    }

    /// The job is done with.
    pub(crate) fn finish(&mut self, job: Box<AdmissionJob>) {
        self.pending = Pending::Idle(job);
    }

    /// The plan has changed meanwhile: the job is to be evaluated again.
    pub(crate) fn reopen(&mut self, mut job: Box<AdmissionJob>, generator: &PatternGenerator) {
        job.renew(generator);
        self.pending = Pending::Ready(job);
    }
}

impl Decision {
    /// The reply that tells it, with the intent in force then.
    pub(crate) fn reply(&self, intent: Intent) -> Reply {
        let Self { verdict, granted, effect_half_step, objection, predicted_margin } = *self;
        Reply {
            verdict,
            reason: objection.map_or(Reason::None, |objection| objection.reason),
            effect_half_step,
            granted,
            intent: Some(intent),
            active_limit: objection.and_then(|objection| objection.active_limit),
            authority: None,
            predicted_margin,
        }
    }

    /// The decision on a change that needs no simulation.
    pub(crate) fn at_once(admission: &gait::RangeCheck) -> Self {
        let gait::RangeCheck { verdict, objection, granted, effect_half_step } = *admission;
        Self { verdict, granted, effect_half_step, objection, predicted_margin: None }
    }

    /// The decision on a request that changes no gait parameter.
    pub(crate) fn unchanged(granted: Command, effect_half_step: u64) -> Self {
        Self { verdict: Verdict::Accepted, granted, effect_half_step, objection: None, predicted_margin: None }
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
