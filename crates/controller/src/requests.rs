//! How requests get into the controller and answers out of it.
//!
//! [`Controller::ask`] refuses at once what cannot be; anything else that changes a previewed walk becomes an [`Inquiry`],
//! which is settled beside the loop and adopted as it is given back.

use balance::preview::{Goal, Stance};
use gait::{Admission, Verdict};

use crate::mode::Rising;
use crate::{Answer, Asked, Controller, Fault, Inquiry, Intent, Pattern, Refusal};

/// Where the one inquiry is.
#[derive(Clone, Debug)]
pub(crate) enum Desk {
    /// Nothing is being looked into.
    Free(Box<Inquiry>),
    /// Something is to be looked into.
    Open(Box<Inquiry>),
    /// It was taken.
    Away,
}

impl Controller {
    /// Whether a request can be taken: the one before has been answered.
    pub fn is_free(&self) -> bool {
        matches!(self.desk, Desk::Free(_)) && self.answer.is_none()
    }

    /// Takes a request; the report of a coming tick has the answer. To be called between ticks, while
    /// [`is_free`](Self::is_free).
    pub fn ask(&mut self, asked: &Asked) {
        let heard = self.sources.hear(asked.source, asked.lasting, asked.is_stop());
        let refusal = match (self.latched, asked.intent) {
            _ if heard.is_err() => heard.err().map(Refusal::Outranked),
            (Some(_), Some(Intent::Reset)) if !self.can_reset() => Some(Refusal::NotWell),
            (_, Some(Intent::Reset)) => None,
            (Some(Fault::Fallen), _) => Some(Refusal::Fallen),
            (Some(_), _) if !asked.is_stop() && !asked.is_empty() => Some(Refusal::Faulted),
            (_, None | Some(Intent::Walk | Intent::InPlace)) if self.holding.is_some() && !asked.is_empty() => {
                Some(Refusal::Standing)
            }
            _ => None,
        };
        if refusal.is_some() {
            self.answer = Some(Answer { refusal, ..self.unchanged(Verdict::Refused) });
        } else if asked.intent == Some(Intent::Reset) {
            self.reset();
            self.answer = Some(self.unchanged(Verdict::Accepted));
        } else if asked.is_empty() || self.latched.is_some() {
            // A faulted robot stands already, or is about to.
            self.answer = Some(self.unchanged(Verdict::Accepted));
        } else {
            self.look_into(asked);
        }
    }

    /// What is to be looked into, if something is. To be settled and given back; until then requests wait.
    pub fn inquiry(&mut self) -> Option<Box<Inquiry>> {
        match std::mem::replace(&mut self.desk, Desk::Away) {
            Desk::Open(inquiry) => Some(inquiry),
            other => {
                self.desk = other;
                None
            }
        }
    }

    /// Takes an inquiry back, between ticks. The controller walks by what was granted if the plan for it is still of now;
    /// else the plan has to be made again.
    pub fn give_back(&mut self, mut inquiry: Box<Inquiry>) {
        let is_stop = matches!(inquiry.intent(), Some(Intent::Stop | Intent::Hold));
        let refusal = match self.latched {
            Some(Fault::Fallen) => Some(Refusal::Fallen),
            Some(_) if !is_stop => Some(Refusal::Faulted),
            _ => None,
        };
        if refusal.is_some() {
            if let Pattern::Preview(preview) = &mut self.pattern {
                preview.keep_pace();
            }
            self.answer = Some(Answer { refusal, ..self.unchanged(Verdict::Refused) });
        } else if let Pattern::Preview(preview) = &mut self.pattern {
            let Some((settled, ruling, intent)) = inquiry.settled_for(preview) else {
                inquiry.renew(preview);
                self.desk = Desk::Open(inquiry);
                return;
            };
            if ruling.admission.verdict == Verdict::Refused {
                preview.keep_pace();
            } else {
                preview.follow(settled);
                self.intent = intent.unwrap_or(self.intent);
            }
            self.answer = Some(Answer {
                admission: ruling.admission,
                strain: ruling.strain,
                predicted_margin: ruling.margin,
                ..self.unchanged(ruling.admission.verdict)
            });
        }
        self.desk = Desk::Free(inquiry);
    }

    /// Stops by itself: at once, whoever else might have something looked into.
    pub(crate) fn stop(&mut self, stance: Stance) {
        self.intent = if stance == Stance::Parallel { Intent::Stop } else { Intent::Hold };
        if let Pattern::Preview(preview) = &mut self.pattern {
            preview.aim_soon(Goal::Stand(stance));
        }
    }

    fn look_into(&mut self, asked: &Asked) {
        match &mut self.pattern {
            Pattern::Preview(preview) => {
                preview.hasten(&asked.request);
                self.desk = match std::mem::replace(&mut self.desk, Desk::Away) {
                    Desk::Free(mut inquiry) => {
                        inquiry.open(preview, &asked.request, asked.intent);
                        Desk::Open(inquiry)
                    }
                    busy => busy,
                };
            }
            Pattern::Plain(walk) => {
                let admission = walk.admit(&asked.request);
                if admission.verdict != Verdict::Refused {
                    self.intent = asked.intent.unwrap_or(self.intent);
                }
                self.answer = Some(Answer { admission, ..self.unchanged(admission.verdict) });
            }
        }
    }

    fn can_reset(&self) -> bool {
        let can_rise = matches!(self.pattern, Pattern::Preview(_));
        self.is_well() && (self.latched != Some(Fault::Fallen) || can_rise)
    }

    /// Forgets the fault. After a fall the joints go back to a stand first.
    fn reset(&mut self) {
        if self.latched.take() == Some(Fault::Fallen)
            && let Pattern::Preview(preview) = &mut self.pattern
        {
            preview.clone_from(&self.rest);
            self.rising = Some(Rising::begin(&self.guard.hold().angles, &preview.physical_motion().angles));
            self.intent = Intent::Stop;
        }
    }

    /// The answer to what changes nothing.
    fn unchanged(&self, verdict: Verdict) -> Answer {
        let (granted, effect_half_step) = (self.pattern.command(), self.pattern.half_step().index);
        Answer {
            admission: Admission { verdict, reasons: [None; 3], granted, effect_half_step },
            strain: None,
            predicted_margin: None,
            intent: self.intent,
            refusal: None,
        }
    }
}
