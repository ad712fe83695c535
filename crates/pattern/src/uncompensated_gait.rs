//! The uncompensated gait: the plain sum of the modifications, whose balance nobody plans (the paper's own starting point).
//!
//! It walks until it is told to stop, stops in stride at the next support change, and cannot start again from there.

use dynamics::{Kinematics, Tree};
use gait::{Admission, Walk};
use interface::GaitChange;
use model::{ComState, Mechanism, Motion};
use nalgebra::Vector3;

use crate::stop_in_stride::StopInStride;
use crate::{GaitPhase, Goal, Stance};

/// A walk without a plan for the centre of mass.
#[derive(Clone, Debug)]
pub struct UncompensatedGait {
    tree: Tree,
    walk: Walk,
    goal: Goal,
    /// The stop, once it has begun.
    stop: Option<StopInStride>,
}

impl UncompensatedGait {
    /// A walk in stride, at the beginning of a half-step.
    pub fn new(mechanism: &Mechanism, walk: Walk) -> Self {
        Self { tree: Tree::new(mechanism), walk, goal: Goal::Walk, stop: None }
    }

    /// Changes the gait parameters. See [`Walk::admit`].
    pub fn admit(&mut self, change: &GaitChange) -> Admission {
        self.walk.admit(change)
    }

    /// Walks on, or stops at the next support change. It cannot step in place: it walks instead.
    pub fn set_goal(&mut self, goal: Goal) {
        self.goal = goal;
    }

    /// Moves on by `dt` (s) and returns whether a new half-step began.
    pub fn advance(&mut self, dt: f64) -> bool {
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

    /// The commanded motion, in support coordinates.
    pub fn motion(&self) -> Motion {
        self.stop.as_ref().map_or_else(|| self.walk.motion(), StopInStride::motion)
    }

    /// Whether it has stopped, for good.
    pub fn has_stopped(&self) -> bool {
        self.stop.is_some()
    }

    /// Walking, stopping or standing in stride.
    pub fn phase(&self) -> GaitPhase {
        match (&self.stop, self.goal) {
            (Some(_), _) => GaitPhase::Standing(Stance::Stride),
            (None, Goal::Stand(_)) => GaitPhase::Stopping,
            (None, Goal::Walk | Goal::InPlace) => GaitPhase::Walking,
        }
    }

    /// The modified half-step.
    pub fn walk(&self) -> &Walk {
        &self.walk
    }
}
