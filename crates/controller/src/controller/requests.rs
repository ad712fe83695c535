//! Requests to the controller, between its ticks: decided at once, or by an admission job.

use interface::{Fault, Intent, Reason, Reply, Request, Verdict};
use pattern::Gait;

use super::Controller;
use crate::admission_job::{AdmissionJob, Decision};
use crate::pattern::{Pattern, goal_of};
use crate::recovery::Recovery;

impl Controller {
    /// Whether a request can be submitted: the one before has been replied to.
    pub fn accepts_request(&self) -> bool {
        self.admission.is_idle()
    }

    /// Submits a request, between two ticks, while [`accepts_request`](Self::accepts_request). The tick in which it is
    /// decided returns the reply.
    pub fn submit(&mut self, request: &Request) {
        let changes_walk = !request.is_empty() && !request.is_stop();
        let steps = request.intent.is_none_or(Intent::steps);
        if let Err(authority) = self.arbiter.admit(request) {
            let refused = self.refused(Reason::Outranked);
            self.admission.reply(Reply { authority: Some(authority), ..refused });
        } else if request.intent == Some(Intent::Reset) {
            let can_reset = self.state.latched().is_none() || self.can_reset();
            if can_reset {
                self.reset();
            }
            self.admission.reply(if can_reset { self.unchanged() } else { self.refused(Reason::FaultPersists) });
        } else if self.state.has_fallen() {
            self.admission.reply(self.refused(Reason::Fallen));
        } else if self.state.latched().is_some() && changes_walk {
            self.admission.reply(self.refused(Reason::Faulted));
        } else if !self.pattern.gait().can_restart() && steps && !request.is_empty() {
            self.admission.reply(self.refused(Reason::CannotRestart));
        } else if request.is_empty() || self.state.latched().is_some() {
            // A faulted robot stands already, or is about to.
            self.admission.reply(self.unchanged());
        } else {
            self.evaluate(request);
        }
    }

    /// The admission job that is to be evaluated, if there is one. Until it is [completed](Self::complete) no other
    /// request can be submitted.
    pub fn take_job(&mut self) -> Option<Box<AdmissionJob>> {
        self.admission.take_job()
    }

    /// Takes an evaluated job back, between two ticks. The controller adopts its plan if that is still one for the
    /// present; else the job has to be evaluated again.
    pub fn complete(&mut self, job: Box<AdmissionJob>) {
        let Pattern::Planned(generator) = &mut self.pattern else { return self.admission.finish(job) };
        let refusal = match self.state.latched() {
            Some(Fault::Fallen) => Some(Reason::Fallen),
            Some(_) if !job.intent().is_some_and(Intent::is_stop) => Some(Reason::Faulted),
            _ => None,
        };
        if let Some(reason) = refusal {
            generator.cancel_speed_override();
            self.admission.reply(self.refused(reason));
        } else {
            let Some((plan, decision)) = job.decided_for(generator) else {
                return self.admission.reopen(job, generator);
            };
            if decision.verdict == Verdict::Refused {
                generator.cancel_speed_override();
            } else {
                generator.adopt(plan);
                self.state.set_intent(job.intent().unwrap_or(self.state.intent()));
            }
            self.admission.reply(decision.reply(self.state.intent()));
        }
        self.admission.finish(job);
    }

    /// Decides on a request that may change the walk: at once, or by a job where the walk is planned.
    fn evaluate(&mut self, request: &Request) {
        match &mut self.pattern {
            Pattern::Planned(generator) => {
                generator.override_speed(&request.gait);
                self.admission.open(generator, request);
            }
            Pattern::Uncompensated(gait) => {
                let decision = Decision::at_once(&gait.admit(&request.gait));
                if decision.verdict != Verdict::Refused
                    && let Some(intent) = request.intent
                {
                    self.state.set_intent(intent);
                    if let Some(goal) = goal_of(intent) {
                        gait.set_goal(goal);
                    }
                }
                self.admission.reply(decision.reply(self.state.intent()));
            }
        }
    }

    /// Whether the cause of the latched fault is gone.
    fn can_reset(&self) -> bool {
        let is_well = self.validator.is_upright() && !self.validator.is_stale();
        is_well && (!self.state.has_fallen() || matches!(self.pattern, Pattern::Planned(_)))
    }

    /// Clears the latched fault. After a fall the joints return to a stand first.
    fn reset(&mut self) {
        match &mut self.pattern {
            Pattern::Planned(generator) if self.state.has_fallen() => {
                generator.clone_from(&self.rest);
                let stand = generator.physical_motion().angles;
                self.state.recover(Recovery::begin(&self.limiter.hold().angles, &stand));
            }
            _ => self.state.clear_fault(),
        }
    }

    /// The reply to a request that changes nothing.
    fn unchanged(&self) -> Reply {
        let gait = self.pattern.gait();
        Decision::unchanged(gait.command(), gait.half_step().index).reply(self.state.intent())
    }

    /// The reply to a refused request.
    fn refused(&self, reason: Reason) -> Reply {
        let gait = self.pattern.gait();
        Reply::refused(reason, gait.half_step().index, gait.command(), Some(self.state.intent()))
    }
}
