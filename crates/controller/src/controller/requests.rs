//! Requests to the controller, between its ticks: decided at once, or by an admission job.

use interface::{ControlAuthority, Fault, GaitChange, Intent, Objection, Reason, Reply, Request, Verdict};
use pattern::{Gait, GaitPhase, Stance};

use super::Controller;
use super::robot_posture::STAND_TILT_MAX;
use crate::admission_job::{AdmissionJob, Decision};
use crate::pattern::{Pattern, goal_of};

impl Controller {
    /// Whether any request can be submitted: the one before has been replied to.
    pub fn accepts_request(&self) -> bool {
        self.admission.is_idle()
    }

    /// Whether an [urgent](Request::is_urgent) request can be submitted, which need not wait for the evaluation of
    /// another one: at most one reply leaves with a tick.
    pub fn accepts_urgent_request(&self) -> bool {
        !self.admission.has_reply()
    }

    /// Submits a request, between two ticks, if the controller [accepts](Self::accepts_request) it. The tick in which
    /// it is decided returns the reply. A stop takes effect at once, whatever is under evaluation.
    pub fn submit(&mut self, request: &Request) {
        let authority = self.arbiter.admit(request).err();
        if request.is_stop() && self.state.latched().is_none() {
            self.submit_stop(request, authority);
        } else if authority.is_some() && !request.is_stop() {
            self.admission.reply(Reply { authority, ..self.refused(Reason::Outranked) });
        } else if request.intent == Some(Intent::Reset) {
            let nothing = Objection { reason: Reason::NothingToReset, active_limit: None };
            let objection = if self.state.latched().is_some() { self.objection_to_reset() } else { Some(nothing) };
            if objection.is_none() {
                self.reset();
            }
            self.admission.reply(objection.map_or_else(
                || self.unchanged(),
                |Objection { reason, active_limit }| Reply { active_limit, ..self.refused(reason) },
            ));
        } else if self.state.has_fallen() {
            self.admission.reply(self.refused(Reason::Fallen));
        } else if request.is_stop() {
            self.admission.reply(self.stopped_by_fault(request));
        } else if request.is_empty() {
            self.admission.reply(self.unchanged());
        } else if self.state.latched().is_some() {
            self.admission.reply(self.refused(Reason::Faulted));
        } else if request.is_contradictory() {
            self.admission.reply(self.refused(Reason::Contradictory));
        } else if !self.pattern.gait().can_restart() && request.intent.is_none_or(Intent::steps) {
            self.admission.reply(self.refused(Reason::CannotRestart));
        } else {
            self.evaluate(request);
        }
    }

    /// Stops at once, and evaluates the gait parameters of the same request unless another source outranks it.
    fn submit_stop(&mut self, request: &Request, authority: Option<ControlAuthority>) {
        let is_hold = request.intent == Some(Intent::Hold);
        let effect_half_step = self.stop(if is_hold { Stance::Stride } else { Stance::Parallel });
        let stopped = Reply { effect_half_step, ..self.unchanged() };
        if request.is_contradictory() {
            let (verdict, reason) = (Verdict::Limited, Reason::Contradictory);
            self.admission.reply(Reply { verdict, reason, ..stopped });
        } else if request.gait == GaitChange::NONE {
            self.admission.reply(stopped);
        } else if authority.is_some() {
            let (verdict, reason) = (Verdict::Limited, Reason::Outranked);
            self.admission.reply(Reply { verdict, reason, authority, ..stopped });
        } else {
            self.evaluate(&Request { intent: None, ..*request });
        }
    }

    /// The reply to a stop of a robot that a fault has stopped: it stands already or is about to, but moves no foot for
    /// another stance and takes no gait parameters.
    fn stopped_by_fault(&self, request: &Request) -> Reply {
        let stands_parallel = self.pattern.gait().phase() == GaitPhase::Standing(Stance::Parallel);
        let stays_in_stride =
            request.intent == Some(Intent::Stop) && self.state.intent() == Intent::Hold && !stands_parallel;
        if stays_in_stride || request.gait != GaitChange::NONE {
            return Reply { verdict: Verdict::Limited, reason: Reason::Faulted, ..self.unchanged() };
        }
        self.unchanged()
    }

    /// The admission job that is to be evaluated, if there is one. Until it is [completed](Self::complete) no other
    /// request can be submitted.
    pub fn take_job(&mut self) -> Option<Box<AdmissionJob>> {
        self.admission.take_job()
    }

    /// Takes an evaluated job back, between two ticks. The controller adopts its plan if that is still one for the
    /// present; else the job has to be evaluated again.
    pub fn complete(&mut self, job: Box<AdmissionJob>) {
        let localization = self.localization();
        let Pattern::Planned(generator) = &mut self.pattern else { return self.admission.finish(job, None) };
        if self.admission.is_cancelled() {
            return self.admission.finish(job, Some((generator, &localization)));
        }
        let refusal = match self.state.latched() {
            Some(Fault::Fallen) => Some(Reason::Fallen),
            Some(_) => Some(Reason::Faulted),
            None => None,
        };
        if let Some(reason) = refusal {
            generator.cancel_speed_override();
            self.admission.reply(self.refused(reason));
        } else {
            let Some((plan, decision)) = job.decided_for(generator) else {
                return self.admission.reopen(job, generator, &localization);
            };
            if decision.verdict == Verdict::Refused {
                generator.cancel_speed_override();
            } else {
                generator.adopt(plan);
                self.state.set_intent(job.intent().unwrap_or(self.state.intent()));
                if job.is_to_destination() {
                    self.destination_source = self.admission.waiting();
                }
            }
            let authority = self.admission.waiting().and_then(|source| self.arbiter.other_in_control(source));
            self.admission.reply(Reply { authority, ..decision.reply(self.state.intent()) });
        }
        self.admission.finish(job, None);
    }

    /// Decides on a request that may change the walk: at once, or by a job where the walk is planned.
    fn evaluate(&mut self, request: &Request) {
        let localization = self.localization();
        match &mut self.pattern {
            Pattern::Uncompensated(_) if request.destination.is_some() => {
                self.admission.reply(self.refused(Reason::NoDestination));
            }
            Pattern::Planned(generator) => {
                // A robot that is to stop does not hurry before.
                if self.state.intent().steps() && request.destination.is_none() {
                    generator.override_speed(&request.gait);
                }
                self.admission.open(generator, &localization, request);
            }
            Pattern::Uncompensated(gait) => {
                let limits = gait.walk().limits();
                let change = request
                    .velocity
                    .map_or(request.gait, |velocity| self.velocity_map.command(&velocity, limits).into());
                let decision = Decision::at_once(&gait.admit(&change));
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

    /// Why the latched fault cannot be cleared; `None` if its cause is gone. A refused reset makes the check of sensors
    /// begin anew.
    fn objection_to_reset(&mut self) -> Option<Objection> {
        let persists = Some(Objection { reason: Reason::FaultPersists, active_limit: None });
        if !self.validator.is_upright() || self.validator.is_stale() {
            // What a sensor was cannot be told for ever from what it is: if its values are consistent from now on, the
            // next reset finds nothing.
            self.validator.begin_anew();
            return persists;
        }
        if !self.state.holds_posture() {
            return None;
        }
        let (Pattern::Planned(_), Some(measured)) = (&self.pattern, self.measured_angles) else { return persists };
        let is_level = self.attitude.up_in_trunk().is_some_and(|up| up.z > dynamics::sin_cos(STAND_TILT_MAX).1);
        if !is_level {
            return persists;
        }
        // Feet that bear the robot would slip on the way to a stand. Who hangs in the air may move as it likes.
        let is_on_its_feet = self.contact.in_contact != [false, false];
        is_on_its_feet.then(|| self.objection_to_posture(&measured)).flatten()
    }

    /// Clears the latched fault. A robot that holds its posture moves to a stand first.
    fn reset(&mut self) {
        self.gravity.reset();
        match self.measured_angles {
            Some(measured) if self.state.holds_posture() => self.recover(&measured),
            _ => self.state.clear_fault(),
        }
    }

    /// The reply to a request that changes nothing.
    fn unchanged(&self) -> Reply {
        let gait = self.pattern.gait();
        Decision::unchanged(gait.command(), gait.half_step().index).reply(self.state.intent())
    }

    /// The reply to a refused request.
    pub(super) fn refused(&self, reason: Reason) -> Reply {
        let gait = self.pattern.gait();
        Reply::refused(reason, gait.half_step().index, gait.command(), Some(self.state.intent()))
    }
}
