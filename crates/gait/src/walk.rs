//! The walk: the nominal half-step repeated from foot to foot, with turn, extension and speed as requested.

use std::sync::Arc;

use model::{Joint, JointVector, Mechanism, Mirror, Motion, Side};
use nalgebra::Vector3;

use crate::{
    Admission, Command, GaitParameters, HalfStep, Limits, NominalTable, Quantity, Request, Speed, StepExtension,
    TableError, Turn, at_speed,
};

/// The state of the walk. Cloning it does not copy the table, so a copy can look ahead.
#[derive(Clone, Debug)]
pub struct Walk {
    table: Arc<NominalTable>,
    mirror: Mirror,
    limits: Limits,
    half_step: HalfStep,
    turn: Turn,
    extension: StepExtension,
    speed: Speed,
}

/// How a walk begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The foot that bears in the first half-step.
    pub support: Side,
    /// In force from the first half-step on. The speed is the one walked at, without a ramp, and may be below the limits:
    /// with 0 the walk stands at its beginning until a speed is requested.
    pub command: Command,
}

/// Why a walk cannot begin.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WalkError {
    /// The table is no half-step.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The table was made for another robot.
    #[error("the nominal half-step was made for mechanism {table:016x}, but the mechanism is {mechanism:016x}")]
    OtherMechanism {
        /// Fingerprint in the table.
        table: u64,
        /// Fingerprint of the mechanism.
        mechanism: u64,
    },
    /// Right and left differ.
    #[error("the mechanism is no mirror image of itself: each joint's axis must be along or across y as its partner's")]
    NoMirror,
    /// Turning needs yaw at the hips.
    #[error(
        "joint {} ({}) turns about {:?}: it must be z, since turning is a yaw of the hips",
        joint.number(), joint.name(), axis.as_slice()
    )]
    HipYawNotVertical {
        /// The joint that should yaw.
        joint: Joint,
        /// Its axis.
        axis: Vector3<f64>,
    },
    /// Extension needs pitch at the hips.
    #[error(
        "joint {} ({}) turns about {:?}: it must be y, since step extension is a pitch of the hips",
        joint.number(), joint.name(), axis.as_slice()
    )]
    HipPitchNotLateral {
        /// The joint that should pitch.
        joint: Joint,
        /// Its axis.
        axis: Vector3<f64>,
    },
    /// Extension needs pitch at the ankles.
    #[error(
        "neither joint {} nor joint {} of the {side:?} ankle turns about y: step extension cannot keep the sole level",
        ankle[0].number(), ankle[1].number()
    )]
    NoAnklePitch {
        /// Of which leg.
        side: Side,
        /// The ankle's two joints.
        ankle: [Joint; 2],
    },
    /// The box of what is granted makes no sense.
    #[error(
        "the limits of {quantity} are {min} to {max}: they must be finite and hold the nominal walk's \
         {nominal}, and speed stays above 0"
    )]
    LimitsWithoutNominal {
        /// Of which quantity.
        quantity: Quantity,
        /// Its least value.
        min: f64,
        /// Its greatest value.
        max: f64,
        /// The nominal walk's value.
        nominal: f64,
    },
    /// The first command is outside the limits.
    #[error("the walk cannot begin with {quantity} {value}: it must be at most {max} and at least {min}")]
    StartOutsideLimits {
        /// Of which quantity.
        quantity: Quantity,
        /// The value to begin with.
        value: f64,
        /// The least possible.
        min: f64,
        /// The greatest possible.
        max: f64,
    },
}

impl Default for Start {
    /// On the right foot, with the nominal walk.
    fn default() -> Self {
        Self { support: Side::Right, command: Command::NOMINAL }
    }
}

impl Walk {
    /// Stands at the beginning of the first half-step, with everything checked that could go wrong later.
    ///
    /// # Errors
    /// See [`WalkError`].
    pub fn new(
        table: Arc<NominalTable>,
        mechanism: &Mechanism,
        parameters: &GaitParameters,
        start: Start,
    ) -> Result<Self, WalkError> {
        let mirror = Mirror::new(mechanism).ok_or(WalkError::NoMirror)?;
        table.check(&mirror)?;
        if table.mechanism != mechanism.fingerprint {
            return Err(WalkError::OtherMechanism { table: table.mechanism, mechanism: mechanism.fingerprint });
        }
        check_limits(&parameters.limits)?;
        check_start(&parameters.limits, &start.command)?;
        let mut walk = Self {
            table,
            mirror,
            limits: parameters.limits,
            half_step: HalfStep::first(start.support),
            turn: Turn::new(mechanism, parameters.ramp)?,
            extension: StepExtension::new(mechanism, parameters.ramp)?,
            speed: Speed::new(start.command.speed, parameters.ramp, parameters.speed_ramp.as_secs_f64()),
        };
        walk.turn.request(start.command.turn);
        walk.extension.request(start.command.extension);
        walk.begin_half_step();
        Ok(walk)
    }

    /// Takes what is granted of a request and says what that is and when it takes effect, see [`Self::force`].
    pub fn admit(&mut self, request: &Request) -> Admission {
        let mut admission = self.grant(request, self.command());
        admission.effect_half_step = self.force(&admission.granted);
        admission
    }

    /// What would be granted of a request if `in_force` were.
    pub fn grant(&self, request: &Request, in_force: Command) -> Admission {
        let (verdict, reasons, granted) = request.grant(&self.limits, in_force);
        Admission { verdict, reasons, granted, effect_half_step: self.half_step.index }
    }

    /// Walks by `command` from now on and says from which half-step on all of it is in effect: speed at once, turn at the
    /// next deflecting half-step, extension at the next half-step. What is in force already changes nothing.
    pub fn force(&mut self, command: &Command) -> u64 {
        let (now, in_force) = (self.half_step, self.command());
        let mut effect_half_step = now.index;
        if command.turn != in_force.turn {
            effect_half_step = effect_half_step.max(now.index + self.turn.delay(command.turn, now.support));
        }
        if command.extension != in_force.extension {
            effect_half_step = effect_half_step.max(now.index + 1);
        }
        self.turn.request(command.turn);
        self.extension.request(command.extension);
        self.speed.request(command.speed);
        effect_half_step
    }

    /// Takes a speed that has been changing elsewhere as the one of now.
    pub fn take_over_speed(&mut self, speed: Speed) {
        self.speed = speed;
    }

    /// Moves on by `dt` [s] and says whether a new half-step began. Progress beyond the end is carried over the swap.
    ///
    /// A `dt` that is negative or NaN counts as none, one beyond a nominal half-step as a nominal half-step.
    pub fn advance(&mut self, dt: f64) -> bool {
        let dt = if dt > 0.0 { dt.min(self.table.duration) } else { 0.0 };
        // Ramps of the speed may swing past a limit near zero, but the walk does not go back to the other foot.
        self.half_step.progress = (self.half_step.progress + self.speed.advance(dt) / self.table.duration).max(0.0);
        let swaps = self.half_step.is_over();
        while self.half_step.is_over() {
            self.half_step.swap();
            self.begin_half_step();
        }
        swaps
    }

    /// What the walk asks now, in canonical coordinates: as if the robot stood on its right foot.
    pub fn motion(&self) -> Motion {
        self.motion_at(self.half_step.progress)
    }

    /// The same at another `progress` of this half-step, at the speed and its rate of now.
    pub fn motion_at(&self, progress: f64) -> Motion {
        let duration = self.table.duration;
        let at_nominal_speed =
            self.table.at(progress) + self.turn.at(progress, duration) + self.extension.at(progress, duration);
        let speed = self.speed.state();
        at_speed(&at_nominal_speed, speed.value, speed.rate)
    }

    /// The angles of [`motion_at`](Self::motion_at).
    pub fn angles_at(&self, progress: f64) -> JointVector {
        self.table.angles_at(progress) + self.offsets_at(progress)
    }

    /// What turn and extension add to the nominal angles at a progress.
    pub fn offsets_at(&self, progress: f64) -> JointVector {
        let duration = self.table.duration;
        self.turn.at(progress, duration).angles + self.extension.at(progress, duration).angles
    }

    /// What the walk asks now, in physical joints: 3 to 8 are the right leg's whichever foot bears.
    pub fn physical_motion(&self) -> Motion {
        match self.half_step.support {
            Side::Right => self.motion(),
            Side::Left => self.motion().mirrored(&self.mirror),
        }
    }

    /// Where the walk is.
    pub fn half_step(&self) -> HalfStep {
        self.half_step
    }

    /// What is in force. Turn and extension take effect at half-steps, speed over a ramp.
    pub fn command(&self) -> Command {
        Command { turn: self.turn.angle(), speed: self.speed.target(), extension: self.extension.angle() }
    }

    /// The speed factor of now.
    pub fn speed(&self) -> &Speed {
        &self.speed
    }

    /// What this half-step does about the turn.
    pub fn turn(&self) -> &Turn {
        &self.turn
    }

    /// What this half-step does about the step length.
    pub fn extension(&self) -> &StepExtension {
        &self.extension
    }

    /// The nominal half-step.
    pub fn table(&self) -> &Arc<NominalTable> {
        &self.table
    }

    /// The swap of canonical and physical joints on the left foot.
    pub fn mirror(&self) -> &Mirror {
        &self.mirror
    }

    fn begin_half_step(&mut self) {
        self.turn.begin_half_step(self.half_step.support);
        self.extension.begin_half_step();
    }
}

fn check_limits(limits: &Limits) -> Result<(), WalkError> {
    for (quantity, nominal) in quantities(&Command::NOMINAL) {
        let (min, max) = limits.bounds(quantity);
        let positive = quantity != Quantity::Speed || min > 0.0;
        if !(min.is_finite() && max.is_finite() && min <= nominal && nominal <= max && positive) {
            return Err(WalkError::LimitsWithoutNominal { quantity, min, max, nominal });
        }
    }
    Ok(())
}

fn check_start(limits: &Limits, command: &Command) -> Result<(), WalkError> {
    for (quantity, value) in quantities(command) {
        let (least, max) = limits.bounds(quantity);
        let min = if quantity == Quantity::Speed { 0.0 } else { least };
        if !(min <= value && value <= max) {
            return Err(WalkError::StartOutsideLimits { quantity, value, min, max });
        }
    }
    Ok(())
}

fn quantities(command: &Command) -> [(Quantity, f64); 3] {
    [(Quantity::Turn, command.turn), (Quantity::Speed, command.speed), (Quantity::Extension, command.extension)]
}
