//! The walking pattern: the modified half-step as it is, or with its balance planned ahead.

use balance::Preview;
use balance::preview::Gate;
use gait::{Admission, Command, HalfStep, Request, Walk};
use model::{Mechanism, Mirror, Motion};
use nalgebra::Vector2;

/// How the modified half-step is kept in balance before any feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// Not at all: the plain sum of the modifications.
    None,
    /// The centre of mass is planned over the coming feet.
    Preview,
}

/// What is asked of the joints, tick by tick.
#[derive(Clone, Debug)]
pub enum Pattern {
    /// The plain sum of the modifications.
    Plain(Box<Walk>),
    /// The same feet, with the centre of mass planned over them.
    Preview(Box<Preview>),
}

impl Pattern {
    /// A pattern at the beginning of a walk.
    pub fn new(mechanism: &Mechanism, walk: Walk, compensation: Compensation) -> Self {
        match compensation {
            Compensation::None => Pattern::Plain(Box::new(walk)),
            Compensation::Preview => Pattern::Preview(Box::new(Preview::new(mechanism, walk))),
        }
    }

    /// See [`Walk::admit`].
    pub fn admit(&mut self, request: &Request) -> Admission {
        match self {
            Pattern::Plain(walk) => walk.admit(request),
            Pattern::Preview(preview) => preview.admit(request),
        }
    }

    /// Moves on by `dt` [s] and says whether a new half-step began.
    pub fn advance(&mut self, dt: f64) -> bool {
        match self {
            Pattern::Plain(walk) => walk.advance(dt),
            Pattern::Preview(preview) => preview.advance(dt),
        }
    }

    /// Whether the walk goes on. The plain sum of the modifications cannot stand by itself: it always goes on.
    pub fn gate(&self) -> Gate {
        match self {
            Pattern::Plain(_) => Gate::Open,
            Pattern::Preview(preview) => preview.gate(),
        }
    }

    /// Whether it can stop by itself.
    pub fn can_stand(&self) -> bool {
        matches!(self, Pattern::Preview(_))
    }

    /// Share of the weight that the bearing foot is to carry now.
    pub fn weight_on_bearing(&self) -> f64 {
        match self {
            Pattern::Plain(_) => 1.0,
            Pattern::Preview(preview) => preview.weight_on_bearing(),
        }
    }

    /// What is asked now, in support coordinates.
    pub fn motion(&self) -> Motion {
        match self {
            Pattern::Plain(walk) => walk.motion(),
            Pattern::Preview(preview) => preview.motion(),
        }
    }

    /// Where the walk is now.
    pub fn half_step(&self) -> HalfStep {
        match self {
            Pattern::Plain(walk) => walk.half_step(),
            Pattern::Preview(preview) => preview.half_step(),
        }
    }

    /// Of a nominal half-step [s].
    pub fn duration(&self) -> f64 {
        match self {
            Pattern::Plain(walk) => walk.table().duration,
            Pattern::Preview(preview) => preview.walk().table().duration,
        }
    }

    /// The speed factor of now.
    pub fn speed(&self) -> f64 {
        match self {
            Pattern::Plain(walk) => walk.speed().state().value,
            Pattern::Preview(preview) => preview.speed(),
        }
    }

    /// How the vertical leans over the floor as soles now tell, in support coordinates; the plan follows slowly, and the
    /// plain sum knows level floors only.
    pub fn vertical_now(&self) -> Vector2<f64> {
        match self {
            Pattern::Plain(_) => Vector2::zeros(),
            Pattern::Preview(preview) => preview.vertical_now(),
        }
    }

    /// Absorbs how the body is turned beyond the plan, about x and y of support coordinates [rad].
    pub fn sense_tilt(&mut self, tilt: Vector2<f64>) {
        if let Pattern::Preview(preview) = self {
            preview.sense_tilt(tilt);
        }
    }

    /// Lands the swinging foot where it catches the robot, see [`Preview::catch`].
    pub fn catch(&mut self, excess: impl Fn(f64) -> Vector2<f64>) {
        if let Pattern::Preview(preview) = self {
            preview.catch(excess);
        }
    }

    /// Absorbs how the vertical leans over the bearing sole, in support coordinates, `dt` seconds after the last time.
    pub fn sense_vertical(&mut self, lean: Vector2<f64>, dt: f64) {
        if let Pattern::Preview(preview) = self {
            preview.sense_vertical(lean, dt);
        }
    }

    /// Whether the plan went where a leg cannot reach, so that the posture before was kept.
    pub fn is_out_of_reach(&self) -> bool {
        match self {
            Pattern::Plain(_) => false,
            Pattern::Preview(preview) => preview.is_out_of_reach(),
        }
    }

    /// What is in force.
    pub fn command(&self) -> Command {
        match self {
            Pattern::Plain(walk) => walk.command(),
            Pattern::Preview(preview) => preview.command(),
        }
    }

    /// The swap of canonical and physical joints on the left foot.
    pub fn mirror(&self) -> &Mirror {
        self.walk().mirror()
    }

    fn walk(&self) -> &Walk {
        match self {
            Pattern::Plain(walk) => walk,
            Pattern::Preview(preview) => preview.walk(),
        }
    }
}
