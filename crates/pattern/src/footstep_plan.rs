//! The footstep plan: which half-steps come and where they put the feet.

use gait::{RangeCheck, Walk};
use interface::{Command, GaitChange, Verdict, WalkPose};
use nalgebra::{Vector2, Vector3};

use crate::course::{Course, CourseStep};
use crate::feet::Feet;
use crate::footprint::{Footprint, SolePose, rotation_about_z};
use crate::gait_state::{GaitState, Goal, Stance};
use crate::modified_half_step::ModifiedHalfStep;
use crate::pace::Pace;
use crate::pattern_model::PatternModel;
use crate::weight_shift::WeightShift;

/// The commanded walk at a knot, with its footsteps. A copy advanced knot by knot gives the footsteps that come.
#[derive(Clone, Debug)]
pub(crate) struct FootstepPlan {
    /// The commanded walk.
    pub walk: Walk,
    /// Whether the robot walks, stops, stands or starts.
    pub gait_state: GaitState,
    /// The feet of the present half-step.
    pub feet: Feet,
    /// The weight shift with which the robot starts from a stand.
    pub weight_shift: WeightShift,
    /// The command in force while the gait state is `Walking`; before a stand the walk is calmer.
    command: Command,
    /// The pace at which the walk changes over to that command.
    pace: Pace,
    /// The command with which the present half-step began.
    begun_with: Command,
    /// The walk to a destination, also once the robot is there. It says where the feet land instead of the command.
    course: Option<Course>,
    /// The speed factor to which the walk returns once the present half-step has ended, if that ends earlier or later
    /// than planned.
    speed_after: Option<f64>,
}

/// Time over which the speed changes so that a half-step ends earlier or later, at most (s).
const TIMING_RAMP: f64 = 0.06;
/// Time over which the speed returns in the half-step after it (s).
const RETURN_RAMP: f64 = 0.15;
/// Within so many knots a half-step ends, unless the robot comes to a stand or walks very slowly.
const KNOTS_FORESEEN: usize = 200;

/// What happens to the footsteps at a knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FootstepEvent {
    /// Nothing.
    None,
    /// The swing foot has landed and becomes the support foot.
    SupportChange,
    /// The first half-step after a stand begins: the support foot carries all the weight.
    LiftOff,
}

impl FootstepPlan {
    /// A walk at the very beginning of its first half-step.
    pub(crate) fn walking(model: &PatternModel, walk: Walk) -> Self {
        let lift_off = model.modified(&walk, walk.half_step().progress).swing_sole;
        let footprint = Footprint::first(walk.half_step().support);
        let command = walk.command();
        let feet = Feet { footprint, lift_off, landing: lift_off };
        let gait_state = GaitState::Walking;
        let (pace, weight_shift) = (Pace::AtOnce, model.weight_shift);
        let mut plan = Self {
            walk,
            gait_state,
            feet,
            weight_shift,
            command,
            pace,
            begun_with: command,
            course: None,
            speed_after: None,
        };
        plan.feet.landing = plan.landing(model);
        plan
    }

    /// A stand with the feet side by side, from which the walk can be started.
    pub(crate) fn standing(model: &PatternModel, walk: Walk) -> Self {
        let parallel = beside_support(model, 0.0, 0.0);
        let footprint = Footprint::first(walk.half_step().support);
        let feet = Feet { footprint, lift_off: parallel, landing: parallel };
        let gait_state = GaitState::Standing(Stance::Parallel);
        let (command, begun_with) = (walk.command(), Command::NOMINAL);
        let (pace, weight_shift) = (Pace::AtOnce, model.weight_shift);
        let mut plan =
            Self { command, walk, gait_state, feet, weight_shift, pace, begun_with, course: None, speed_after: None };
        plan.walk.force(&Command::NOMINAL);
        plan.feet.landing = plan.landing(model);
        plan
    }

    /// Lets the present half-step end after a time (s).
    pub(crate) fn end_half_step_in(&mut self, time: f64) {
        self.speed_after.get_or_insert(self.walk.speed().target());
        self.walk.end_half_step_in(time, TIMING_RAMP.min(time));
    }

    /// The speed factor of the half-steps as planned, whenever the present one ends.
    pub(crate) fn planned_speed(&self) -> f64 {
        self.speed_after.unwrap_or(self.walk.speed().target())
    }

    /// Whether the present half-step ends earlier or later than planned.
    pub(crate) fn is_timed(&self) -> bool {
        self.speed_after.is_some()
    }

    /// The command in force, or in force once the robot walks.
    pub(crate) fn command(&self) -> Command {
        self.command
    }

    /// The pace at which the walk changes over to it.
    pub(crate) fn pace(&self) -> Pace {
        self.pace
    }

    /// Puts in force what the limits of the gait grant of a request. See [`Walk::admit`].
    ///
    /// * `pace` – at which the walk changes over to it
    pub(crate) fn admit(&mut self, request: &GaitChange, pace: Pace) -> RangeCheck {
        if (GaitChange { speed: None, ..*request }) != GaitChange::NONE {
            self.course = None;
        }
        let mut admission = self.walk.grant(request, self.command);
        if admission.verdict != Verdict::Refused {
            (self.command, self.pace) = (admission.granted, pace);
            if let Some(effect_half_step) = self.apply_command() {
                admission.effect_half_step = effect_half_step;
            }
        }
        admission
    }

    /// The walk to a destination, if there is one.
    pub(crate) fn course(&self) -> Option<&Course> {
        self.course.as_ref()
    }

    /// Walks to a destination and stands there, from the next half-step on, or from a stand with the feet side by side.
    pub(crate) fn follow(&mut self, course: Course, stops_first: bool) {
        if stops_first {
            self.set_goal(Goal::Stand(Stance::Parallel));
            self.gait_state.walk_after_stand();
        } else {
            self.set_goal(Goal::Walk);
        }
        self.course = Some(course);
        self.apply_command();
    }

    /// Corrects where the places of the destination are.
    pub(crate) fn set_course_frame(&mut self, frame: WalkPose) {
        if let Some(course) = &mut self.course {
            course.set_frame(frame);
        }
    }

    /// Commands a walk, steps in place or a stand.
    pub(crate) fn set_goal(&mut self, goal: Goal) {
        self.course = None;
        let was_in_place = matches!(self.gait_state, GaitState::InPlace { .. });
        self.gait_state.set_goal(goal, self.weight_shift);
        if let GaitState::Stopping { half_steps: half_steps @ 1, .. } = &mut self.gait_state
            && was_in_place
            && self.walk.sidestep().per_hip(1.0).value != 0.0
        {
            // The feet land apart; the next half-step brings them side by side.
            *half_steps = 2;
        }
        if matches!(self.gait_state, GaitState::Stopping { .. }) {
            let Command { speed, extension, .. } = self.walk.command();
            let (speed, extension) = (speed.min(1.0), extension.min(0.0));
            self.walk.force(&Command { turn: 0.0, speed, extension, sidestep: 0.0 });
        } else {
            self.apply_command();
        }
    }

    /// Lets the present half-step begin to change over to the command, which is in force already. Returns the
    /// half-step from which on all of it is.
    pub(crate) fn redirect(&mut self) -> u64 {
        let half_steps = self.pace.half_steps(&self.begun_with, &self.command);
        let next = self.pace.towards(&self.begun_with, &self.command);
        let before = std::mem::replace(&mut self.begun_with, next);
        let effect_half_step = self.walk.redirect(&next, &before);
        // The half-step after it goes on from there.
        self.apply_command();
        effect_half_step + half_steps.saturating_sub(1)
    }

    /// Lets the walk follow the command as far as the gait state allows: in place without extension and no faster than
    /// the nominal, not at all around a stand. Returns the half-step from which on it does, see [`Walk::force`].
    fn apply_command(&mut self) -> Option<u64> {
        match self.gait_state {
            GaitState::Walking if self.course.is_some() => {
                // The course aims each half-step.
                Some(self.walk.force(&Command { speed: self.command.speed, ..Command::NOMINAL }))
            }
            GaitState::Walking if self.pace != Pace::AtOnce => {
                let half_steps = self.pace.half_steps(&self.begun_with, &self.command);
                let next = self.pace.towards(&self.begun_with, &self.command);
                Some(self.walk.force(&next) + half_steps.saturating_sub(1))
            }
            GaitState::Walking => Some(self.walk.force(&self.command)),
            GaitState::InPlace { .. } => {
                let speed = self.command.speed.min(1.0);
                Some(self.walk.force(&Command { speed, extension: 0.0, ..self.command }))
            }
            GaitState::Stopping { .. }
            | GaitState::Settling { .. }
            | GaitState::Standing(_)
            | GaitState::Starting { .. }
            | GaitState::Returning { .. } => None,
        }
    }

    /// Advances by a knot.
    pub(crate) fn advance(&mut self, model: &PatternModel) -> FootstepEvent {
        let was_standing = self.gait_state.is_standing();
        let begins = self.gait_state.advance(&mut self.walk, self.weight_shift);
        if begins {
            if let Some(speed) = self.speed_after.take() {
                self.walk.change_speed_within(speed, RETURN_RAMP);
            }
            self.begun_with = self.walk.command();
            self.feet.lift_off = self.feet.landing.former_support();
            self.feet.footprint = self.feet.footprint.next(&self.feet.landing);
            self.feet.landing = self.begin_step_of_course(model).unwrap_or_else(|| self.landing(model));
            if self.pace != Pace::AtOnce && self.gait_state == GaitState::Walking {
                self.apply_command();
            }
            FootstepEvent::SupportChange
        } else if was_standing && !self.gait_state.is_standing() {
            if self.pace != Pace::AtOnce && self.gait_state == GaitState::Walking && self.course.is_none() {
                // From feet side by side a step of any direction is a first one.
                let in_place = Command { extension: 2.0 * model.velocity.no_step(), ..Command::NOMINAL };
                self.walk.restart(&self.pace.towards(&in_place, &self.command));
                self.begun_with = self.walk.command();
            }
            self.apply_command();
            self.feet.landing = self.begin_step_of_course(model).unwrap_or_else(|| self.landing(model));
            FootstepEvent::LiftOff
        } else {
            FootstepEvent::None
        }
    }

    /// Aims the half-step that begins if the robot walks to a destination. Returns where the swing foot lands then.
    fn begin_step_of_course(&mut self, model: &PatternModel) -> Option<SolePose> {
        let course = self.course.as_mut().filter(|_| self.gait_state == GaitState::Walking)?;
        let CourseStep { landing, stance } = course.next_step(model, &self.feet)?;
        self.walk.aim(&model.velocity.geometry().legs(&landing));
        if let Some(stance) = stance {
            self.gait_state = GaitState::Stopping { half_steps: 1, stance, goal: Goal::Stand(stance) };
        }
        Some(landing)
    }

    /// The predicted ZMP of the whole body less that of the cart-table model, in support coordinates (m); zero in a
    /// stand.
    pub(crate) fn lipm_residual(&self, model: &PatternModel) -> Vector2<f64> {
        if self.gait_state.is_standing() {
            return Vector2::zeros();
        }
        model.lipm_residual.at(self.walk.half_step().progress, self.walk.speed().state().value)
    }

    /// Where the swing foot lands next, and the support foot after it, in the frame of the support foot, not mirrored.
    /// Before a stand the support foot stays where it is.
    pub(crate) fn landings(&self, model: &PatternModel) -> [WalkPose; 2] {
        let Feet { footprint, landing, .. } = &self.feet;
        let next = footprint.next(landing);
        let mut ahead = self.clone();
        let changes = (0..KNOTS_FORESEEN).any(|_| ahead.advance(model) == FootstepEvent::SupportChange);
        let after = if changes { ahead.feet.landing } else { landing.former_support() };
        [next, next.next(&after)].map(|landed| footprint.sees(&landed))
    }

    /// Where the swing sole of the present half-step lands.
    pub(crate) fn landing(&self, model: &PatternModel) -> SolePose {
        let mut landing = self.modified(model, 1.0).swing_sole;
        landing.position.z = 0.0;
        match self.gait_state {
            GaitState::Stopping { half_steps: 1, stance: Stance::Parallel, .. } => beside_support(model, 0.0, 0.0),
            GaitState::InPlace { half_steps: 0 } => {
                beside_support(model, landing.yaw, self.walk.sidestep().per_hip(1.0).value)
            }
            _ => model.velocity.geometry().spacing().kept(&landing),
        }
    }

    /// The modified half-step at a progress.
    pub(crate) fn modified(&self, model: &PatternModel, progress: f64) -> ModifiedHalfStep {
        model.modified(&self.walk, progress)
    }
}

/// The other sole beside the support sole.
///
/// * `yaw` – by half of which both are turned apart from the heading of the hips (rad)
/// * `spread` – by which either leg swings away from the other one (rad)
fn beside_support(model: &PatternModel, yaw: f64, spread: f64) -> SolePose {
    let width = model.mechanism.foot_distance() + model.velocity.aside(spread);
    SolePose { position: rotation_about_z(yaw / 2.0) * Vector3::new(0.0, width, 0.0), yaw }
}
