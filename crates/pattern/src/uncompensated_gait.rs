//! The uncompensated gait: the plain sum of the modifications, whose balance nobody plans (the paper's own starting
//! point).
//!
//! It walks until it is told to stop, stops in stride at the next support change, and cannot start again from there.

use dynamics::{Kinematics, Tree};
use gait::{RangeCheck, Walk};
use interface::{Command, GaitChange, HalfStep, WalkPose};
use model::{ComState, Mechanism, Motion, Side};
use nalgebra::{Vector2, Vector3};

use crate::footprint::{Footprint, SolePose};
use crate::gait::Gait;
use crate::stop_in_stride::StopInStride;
use crate::{BodyTilt, GaitPhase, Goal, MeasuredBalance, Stance, StepChoice};

/// A walk without a plan for the centre of mass.
#[derive(Clone, Debug)]
pub struct UncompensatedGait {
    mechanism: Mechanism,
    tree: Tree,
    walk: Walk,
    goal: Goal,
    /// The stop, once it has begun.
    stop: Option<StopInStride>,
}

impl UncompensatedGait {
    /// A walk in stride, at the beginning of a half-step.
    pub fn new(mechanism: &Mechanism, walk: Walk) -> Self {
        Self { mechanism: mechanism.clone(), tree: Tree::new(mechanism), walk, goal: Goal::Walk, stop: None }
    }

    /// Walks on, or stops at the next support change. It cannot step in place: it walks instead.
    pub fn set_goal(&mut self, goal: Goal) {
        self.goal = goal;
    }

    /// Whether it has stopped, for good.
    pub fn has_stopped(&self) -> bool {
        self.stop.is_some()
    }
}

/// It knows level floors only, and adjusts no step.
impl Gait for UncompensatedGait {
    fn admit(&mut self, change: &GaitChange) -> RangeCheck {
        self.walk.admit(change)
    }

    fn advance(&mut self, dt: f64) -> bool {
        if let Some(stop) = &mut self.stop {
            stop.advance(&self.tree, dt);
            return false;
        }
        let before = self.walk.motion();
        let changes_support = self.walk.advance(dt);
        if changes_support && matches!(self.goal, Goal::Stand(_)) {
            let position = Kinematics::fixed_base(&self.tree, &before.angles).com(&self.tree);
            let pendulum_rate = ComState { position, velocity: Vector3::zeros() }.pendulum_rate();
            self.stop = Some(StopInStride::begin(&self.tree, &self.walk.motion(), pendulum_rate));
        }
        changes_support
    }

    fn motion(&self) -> Motion {
        self.stop.as_ref().map_or_else(|| self.walk.motion(), StopInStride::motion)
    }

    fn half_step(&self) -> HalfStep {
        self.walk().half_step()
    }

    fn speed(&self) -> f64 {
        self.walk().speed().state().value
    }

    fn command(&self) -> Command {
        self.walk().command()
    }

    fn phase(&self) -> GaitPhase {
        match (&self.stop, self.goal) {
            (Some(_), _) => GaitPhase::Standing(Stance::Stride),
            (None, Goal::Stand(_)) => GaitPhase::Stopping,
            (None, Goal::Walk | Goal::InPlace) => GaitPhase::Walking,
        }
    }

    fn landings(&self) -> [WalkPose; 2] {
        let kinematics = Kinematics::fixed_base_up_to_left_foot(&self.tree, &self.walk.motion_at(1.0).angles);
        let sole = kinematics.sole_to_world(&self.mechanism, Side::Left);
        let landing = SolePose::new(sole.translation.vector, &(sole.rotation * Vector3::x()));
        let present = Footprint::first(self.walk.half_step().support);
        let next = present.next(&landing);
        // The support foot steps as far as the other one, and is parallel to it again.
        let back = SolePose { yaw: -landing.yaw, ..landing };
        [next, next.next(&back)].map(|footprint| present.sees(&footprint))
    }

    fn walk(&self) -> &Walk {
        &self.walk
    }

    fn stop(&mut self, stance: Stance) -> u64 {
        self.set_goal(Goal::Stand(stance));
        u64::from(!self.has_stopped())
    }

    fn can_restart(&self) -> bool {
        !self.has_stopped()
    }

    fn follows_walk(&self) -> bool {
        !self.has_stopped()
    }

    fn in_double_support(&self) -> bool {
        false
    }

    fn is_leg_out_of_reach(&self) -> bool {
        false
    }

    fn sensed_vertical(&self) -> Vector2<f64> {
        Vector2::zeros()
    }

    fn update_ground_slope(&mut self, _: Vector2<f64>, _: f64) {}

    fn set_tilt(&mut self, _: BodyTilt) {}

    fn choose_step(&self, _: &MeasuredBalance) -> Option<StepChoice> {
        None
    }

    fn shortfall(&self, _: &MeasuredBalance) -> Option<Vector2<f64>> {
        None
    }

    fn adjust_step(&mut self, _: StepChoice) {}
}
