//! The pattern that the controller plays: a gait with its balance planned ahead, or without.

use gait::Walk;
use model::Mechanism;
use pattern::{Gait, Goal, PatternGenerator, Stance, UncompensatedGait};

/// How the modified half-step is kept in balance before any feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// Not at all: the plain sum of the modifications.
    None,
    /// The centre of mass is planned over the coming footsteps.
    Preview,
}

/// The gait that the controller plays.
#[derive(Clone, Debug)]
pub(crate) enum Pattern {
    /// The plain sum of the modifications.
    Uncompensated(Box<UncompensatedGait>),
    /// The same footsteps, with the centre of mass planned over them.
    Planned(Box<PatternGenerator>),
}

impl Pattern {
    /// A pattern at the beginning of a walk in stride.
    pub(crate) fn new(mechanism: &Mechanism, walk: Walk, compensation: Compensation) -> Self {
        match compensation {
            Compensation::None => Pattern::Uncompensated(Box::new(UncompensatedGait::new(mechanism, walk))),
            Compensation::Preview => Pattern::Planned(Box::new(PatternGenerator::walking(mechanism, walk))),
        }
    }

    /// The gait, whichever it is.
    pub(crate) fn gait(&self) -> &dyn Gait {
        match self {
            Pattern::Uncompensated(gait) => gait.as_ref(),
            Pattern::Planned(generator) => generator.as_ref(),
        }
    }

    /// The gait, whichever it is, to be moved on.
    pub(crate) fn gait_mut(&mut self) -> &mut dyn Gait {
        match self {
            Pattern::Uncompensated(gait) => gait.as_mut(),
            Pattern::Planned(generator) => generator.as_mut(),
        }
    }
}

/// The goal of an intent; `None` if it is not about walking.
pub(crate) fn goal_of(intent: interface::Intent) -> Option<Goal> {
    use interface::Intent;
    match intent {
        Intent::Walk => Some(Goal::Walk),
        Intent::InPlace => Some(Goal::InPlace),
        Intent::Stop => Some(Goal::Stand(Stance::Parallel)),
        Intent::Hold => Some(Goal::Stand(Stance::Stride)),
        Intent::Reset => None,
    }
}
