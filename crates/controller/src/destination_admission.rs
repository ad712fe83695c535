//! What of a request to walk to a destination can be granted: the whole way is simulated, with slower or smaller steps
//! as long as it violates a limit, and from a stand if it cannot be reached in stride.

use std::cell::Cell;

use interface::{ActiveLimit, Command, Footstep, Objection, Places, Reason, Verdict};
use pattern::{
    Departure, Feasibility, FootstepFault, FootstepProblem, Gait, GaitState, Goal, KNOT, PatternGenerator, Stance,
};

use crate::admission_job::{AdmissionJob, Decision};
use crate::limit_objection::objection;

/// Shares of the speed factor at which footsteps are tried, and of the largest half-steps to way-points.
const SHARES: [f64; 6] = [1.0, 0.85, 0.7, 0.55, 0.4, 0.28];
/// Most knots of a way that are simulated: 40 s. The rest is more of the same.
const KNOTS_MAX: usize = 4000;
/// Farthest place (m): longer than anyone walks, so that a farther one is a mistake of unit.
const DISTANCE_MAX: f64 = 1e4;

impl AdmissionJob {
    /// Decides on a walk to places, in the walk frame, and notes how it goes there. `None` if that has to wait for a
    /// support change: what cannot be begun late in a half-step may be at the beginning of the next one.
    pub(crate) fn decide_destination(&mut self, places: &Places, speed: Option<f64>) -> Option<Decision> {
        let in_force = self.generator.command();
        let unchanged = Decision::unchanged(in_force, self.generator.half_step().index);
        let refused = |objection, place| {
            Some(Decision { verdict: Verdict::Refused, objection: Some(objection), place, ..unchanged })
        };
        if let Some((objection, place)) = self.objection_to(places) {
            return refused(objection, place);
        }
        let asked = speed.unwrap_or(1.0);
        let limits = self.generator.walk().limits();
        let (speed_min, speed_in_range) = (limits.speed_min, asked.clamp(limits.speed_min, limits.speed_max));
        // What the walk in force violates, or a start to the nominal walk, is no reason to refuse a way.
        let in_force_or_nominal =
            if self.generator.gait_state() == GaitState::Walking { in_force } else { Command::NOMINAL };
        let in_stride = self.simulate(&in_force_or_nominal.into()).1;
        if let Some(overload) = in_stride.overload() {
            return refused(objection(&overload), None);
        }
        let mut first = None;
        // Footsteps begin with the feet as they are.
        let can_stop = self.generator.gait_state().is_stepping() && matches!(places, Places::Waypoints(_));
        let from_stand = if can_stop { Some(in_stride.and(&self.simulate_stop())) } else { None };
        let departures = std::iter::once((false, in_stride)).chain(from_stand.map(|base| (true, base)));
        for ((stops_first, base), share) in departures.flat_map(|each| SHARES.map(|share| (each, share))) {
            let (speed, share) = match places {
                Places::Waypoints(_) => (speed_in_range, share),
                Places::Footsteps(_) => ((speed_in_range * share).max(speed_min), 1.0),
            };
            let departure = Departure { share, stops_first };
            let (feasibility, arrival) = self.simulate_way(places, speed, departure);
            let violated = feasibility
                .violation
                .as_ref()
                .map(|violation| (objection(violation), self.place_of(places, feasibility.violated_in)));
            if !feasibility.is_no_worse_than(&base) {
                if self.is_late() {
                    return None;
                }
                first = first.or(violated);
                continue;
            }
            self.departure = departure;
            let range = (speed != asked).then_some(Objection {
                reason: Reason::SpeedLimit,
                active_limit: Some(ActiveLimit { joint: None, value: asked, limit: speed }),
            });
            let objection = first.map(|(objection, _)| objection).or(range);
            return Some(Decision {
                verdict: if objection.is_some() { Verdict::Limited } else { Verdict::Accepted },
                granted: Command { speed, ..in_force },
                objection,
                place: first.and_then(|(_, place)| place),
                predicted_margin: Some(feasibility.margin).filter(|margin| margin.is_finite()),
                arrival,
                walk: match places {
                    Places::Waypoints(_) => Some(self.generator.walk_to_waypoints(speed, share)),
                    Places::Footsteps(_) => None,
                },
                ..unchanged
            });
        }
        let (objection, place) = first.unwrap_or((Objection { reason: Reason::LegReach, active_limit: None }, None));
        refused(objection, place)
    }

    /// Why a destination is none, whatever the walk, and which place it is about.
    fn objection_to(&self, places: &Places) -> Option<(Objection, Option<u32>)> {
        let plain = |reason| Objection { reason, active_limit: None };
        let here = self.localization.pose;
        let check = |index: usize, x: f64, y: f64, heading: f64| {
            let distance = ((x - here.x) * (x - here.x) + (y - here.y) * (y - here.y)).sqrt();
            let objection = if !(x.is_finite() && y.is_finite() && heading.is_finite()) {
                plain(Reason::NotFinite)
            } else if distance > DISTANCE_MAX {
                let active_limit = Some(ActiveLimit { joint: None, value: distance, limit: DISTANCE_MAX });
                Objection { reason: Reason::TooFar, active_limit }
            } else {
                return None;
            };
            Some((objection, number(index)))
        };
        match places {
            Places::Waypoints(waypoints) => {
                let mut waypoints = waypoints.iter().enumerate();
                waypoints.find_map(|(index, place)| check(index, place.x, place.y, place.heading.unwrap_or(0.0)))
            }
            Places::Footsteps(footsteps) => {
                let mut each = footsteps.iter().enumerate();
                let wild = each.find_map(|(index, Footstep { sole, .. })| check(index, sole.x, sole.y, sole.heading));
                wild.or_else(|| {
                    let fault = self.generator.check_footsteps(footsteps, &self.localization.support_sole).err()?;
                    Some((of_footstep(&fault), number(fault.index)))
                })
            }
        }
    }

    /// Simulates a stop, which is made whatever it violates.
    fn simulate_stop(&mut self) -> Feasibility {
        self.trial.clone_from(&self.generator);
        self.trial.set_goal(Goal::Stand(Stance::Parallel));
        self.check.play(&mut self.trial, |trial, knots| !trial.gait_state().is_standing() && knots < KNOTS_MAX)
    }

    /// Simulates the way to places until the robot stands there. Returns how long that takes (s), if it arrives in the
    /// time that is simulated.
    fn simulate_way(&mut self, places: &Places, speed: f64, departure: Departure) -> (Feasibility, Option<f64>) {
        self.trial.clone_from(&self.generator);
        self.trial.walk_to(places, &self.localization.support_sole, speed, departure);
        let arrived = Cell::new(None);
        let goes_on = |trial: &PatternGenerator, knots: usize| {
            if trial.has_arrived() {
                arrived.set(Some(knots as f64 * KNOT));
            }
            arrived.get().is_none() && knots < KNOTS_MAX
        };
        let feasibility = self.check.play(&mut self.trial, goes_on);
        (feasibility, arrived.get())
    }

    /// The number of the footstep that is made in a half-step.
    fn place_of(&self, places: &Places, half_step: Option<u64>) -> Option<u32> {
        let Places::Footsteps(footsteps) = places else { return None };
        let walk = self.generator.walk().half_step();
        let stands = self.generator.gait_state().is_standing();
        let (mut first, support) =
            if stands { (walk.index, walk.support) } else { (walk.index + 1, walk.support.other()) };
        if footsteps.first()?.side == support {
            first += 1;
        }
        let index = usize::try_from(half_step?.saturating_sub(first)).ok()?;
        number(index.min(footsteps.len() - 1))
    }
}

/// The number of a place, counted from 1.
fn number(index: usize) -> Option<u32> {
    u32::try_from(index + 1).ok()
}

/// A footstep that cannot be made, in the words of a reply.
fn of_footstep(fault: &FootstepFault) -> Objection {
    let (reason, bound) = match fault.problem {
        FootstepProblem::SameFoot => (Reason::SameFoot, None),
        FootstepProblem::TooFar(bound) => (Reason::StepTooFar, Some(bound)),
        FootstepProblem::Crosses(bound) => (Reason::FeetCross, Some(bound)),
        FootstepProblem::Turned(bound) => (Reason::StepTurn, Some(bound)),
    };
    Objection { reason, active_limit: bound.map(|[value, limit]| ActiveLimit { joint: None, value, limit }) }
}
