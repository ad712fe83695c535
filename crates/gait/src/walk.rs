//! The walk: the nominal half-step repeated from foot to foot, with turn, extension, sidestep and speed as commanded.

use std::sync::Arc;

use model::{JointVector, Mechanism, Mirror, Motion, Side};

use crate::{
    Deflection, GaitParameters, Limits, NominalTable, Quantity, RangeCheck, Speed, StepExtension, WalkError, at_speed,
    sidestep, turn,
};
use interface::{Command, GaitChange, HalfStep};

/// The state of the walk. Cloning it does not copy the table, so a copy can look ahead.
#[derive(Clone, Debug)]
pub struct Walk {
    table: Arc<NominalTable>,
    mirror: Mirror,
    limits: Limits,
    half_step: HalfStep,
    turn: Deflection,
    extension: StepExtension,
    sidestep: Deflection,
    speed: Speed,
}

/// How a walk begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The support foot of the first half-step.
    pub support: Side,
    /// The command from the first half-step on. The walk begins at its speed, without a ramp; it may be below the
    /// limits: with 0 the walk stands at its beginning until a speed is commanded.
    pub command: Command,
}

/// Offsets of either leg at the end of a half-step (rad): they say where the swing foot lands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LegOffsets {
    /// Rotation of either leg about itself, which turns the feet apart.
    pub turn: f64,
    /// Swing of either leg ahead.
    pub reach: f64,
    /// Swing of either leg away from the other one.
    pub spread: f64,
}

impl Default for Start {
    /// The nominal walk, beginning on the right foot.
    fn default() -> Self {
        Self { support: Side::Right, command: Command::NOMINAL }
    }
}

impl Walk {
    /// A walk at the beginning of its first half-step. Everything that could go wrong later is checked here.
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
        if table.mechanism != mechanism.body_fingerprint {
            return Err(WalkError::OtherMechanism { table: table.mechanism, mechanism: mechanism.body_fingerprint });
        }
        check_limits(&parameters.limits)?;
        check_start(&parameters.limits, &start.command)?;
        let mut walk = Self {
            table,
            mirror,
            limits: parameters.limits,
            half_step: HalfStep::first(start.support),
            turn: Deflection::turn(mechanism, parameters.ramp),
            extension: StepExtension::new(mechanism, parameters.ramp),
            sidestep: Deflection::sidestep(mechanism, parameters.ramp),
            speed: Speed::new(start.command.speed, parameters.ramp, parameters.speed_ramp.as_secs_f64()),
        };
        walk.turn.request(start.command.turn);
        walk.extension.request(start.command.extension);
        walk.sidestep.request(start.command.sidestep);
        walk.begin_half_step();
        Ok(walk)
    }

    /// Checks that the motion of the joints, [`motion`](Self::motion), is that of a modified walk: turn,
    /// extension and sidestep are offsets of single joints only where these have the paper's axes.
    ///
    /// # Errors
    /// [`WalkError::HipYawNotVertical`], [`WalkError::HipPitchNotLateral`], [`WalkError::NoAnklePitch`],
    /// [`WalkError::HipRollNotForward`], [`WalkError::NoAnkleRoll`].
    pub fn check_joints(mechanism: &Mechanism) -> Result<(), WalkError> {
        turn::check_joints(mechanism)?;
        StepExtension::check_joints(mechanism)?;
        sidestep::check_joints(mechanism)
    }

    /// Takes what is granted of a request and says what that is and when it takes effect, see [`Self::force`].
    pub fn admit(&mut self, change: &GaitChange) -> RangeCheck {
        let mut admission = self.grant(change, self.command());
        admission.effect_half_step = self.force(&admission.granted);
        admission
    }

    /// What would be granted of a request if `in_force` were.
    pub fn grant(&self, change: &GaitChange, in_force: Command) -> RangeCheck {
        let (verdict, objection, granted) = self.limits.admit(change, in_force);
        RangeCheck { verdict, objection, granted, effect_half_step: self.half_step.index }
    }

    /// Puts `command` into force, and returns the half-step from which on all of it is in effect: speed at once, turn
    /// and sidestep at the next deflecting half-step, extension at the next half-step. What is in force
    /// already changes nothing.
    pub fn force(&mut self, command: &Command) -> u64 {
        let (now, in_force) = (self.half_step, self.command());
        let mut effect_half_step = now.index;
        if command.turn != in_force.turn {
            effect_half_step = effect_half_step.max(now.index + self.turn.delay(command.turn, now.support));
        }
        if command.sidestep != in_force.sidestep {
            let delay = self.sidestep.delay(command.sidestep, now.support);
            effect_half_step = effect_half_step.max(now.index + delay);
        }
        if command.extension != in_force.extension {
            effect_half_step = effect_half_step.max(now.index + 1);
        }
        self.turn.request(command.turn);
        self.extension.request(command.extension);
        self.sidestep.request(command.sidestep);
        self.speed.request(command.speed);
        effect_half_step
    }

    /// Puts `command` into force as [`force`](Self::force) does, and lets the present half-step end by it already as
    /// far as its swing foot can lead. Returns the half-step from which on all of it is in effect.
    ///
    /// * `before` – the command by which the half-step has begun
    pub fn redirect(&mut self, command: &Command, before: &Command) -> u64 {
        let HalfStep { index, support, progress } = self.half_step;
        let mut effect_half_step = index;
        for (deflection, angle, before) in
            [(&mut self.turn, command.turn, before.turn), (&mut self.sidestep, command.sidestep, before.sidestep)]
        {
            let delay = deflection.delay(angle, support);
            deflection.request(angle);
            if !deflection.redirect(support, progress) && angle != before {
                effect_half_step = effect_half_step.max(index + delay);
            }
        }
        self.extension.request(command.extension);
        self.extension.redirect(progress);
        self.speed.request(command.speed);
        effect_half_step
    }

    /// Replaces the present speed by one that has been changing elsewhere.
    pub fn take_over_speed(&mut self, speed: Speed) {
        self.speed = speed;
    }

    /// Lets the present half-step end after a time (s), by a speed to which it changes over `ramp` (s).
    pub fn end_half_step_in(&mut self, time: f64, ramp: f64) {
        let left = (1.0 - self.half_step.progress) * self.table.duration;
        self.speed.cover(left, time, ramp);
    }

    /// Changes to another speed within a time (s).
    pub fn change_speed_within(&mut self, speed: f64, time: f64) {
        self.speed.request_within(speed, time);
    }

    /// Advances by `dt` (s) and returns whether a new half-step began. Progress beyond the end is carried over to it.
    ///
    /// A `dt` that is negative or NaN counts as 0, one longer than a nominal half-step as a nominal half-step.
    pub fn advance(&mut self, dt: f64) -> bool {
        let dt = if dt > 0.0 { dt.min(self.table.duration) } else { 0.0 };
        // A ramp of the speed may overshoot a limit near zero, but the walk does not return to the other foot.
        self.half_step.progress = (self.half_step.progress + self.speed.advance(dt) / self.table.duration).max(0.0);
        let swaps = self.half_step.is_over();
        while self.half_step.is_over() {
            self.half_step.begin_next();
            self.begin_half_step();
        }
        swaps
    }

    /// The present motion, canonical: as if the robot stood on its right foot.
    pub fn motion(&self) -> Motion {
        self.motion_at(self.half_step.progress)
    }

    /// The motion at another `progress` of this half-step, with the present speed and its rate.
    pub fn motion_at(&self, progress: f64) -> Motion {
        let duration = self.table.duration;
        let at_nominal_speed = self.table.at(progress)
            + self.turn.at(progress, duration)
            + self.extension.at(progress, duration)
            + self.sidestep.at(progress, duration);
        let speed = self.speed.state();
        at_speed(&at_nominal_speed, speed.value, speed.rate)
    }

    /// The joint angles of [`motion_at`](Self::motion_at) (rad).
    pub fn angles_at(&self, progress: f64) -> JointVector {
        self.table.angles_at(progress) + self.offsets_at(progress)
    }

    /// The offsets of turn, extension and sidestep to the nominal angles at a progress (rad).
    pub fn offsets_at(&self, progress: f64) -> JointVector {
        let duration = self.table.duration;
        self.turn.at(progress, duration).angles
            + self.extension.at(progress, duration).angles
            + self.sidestep.at(progress, duration).angles
    }

    /// The present motion of the physical joints: 3 to 8 are the right leg's, whichever foot supports the robot.
    pub fn physical_motion(&self) -> Motion {
        self.mirror.to_support(self.half_step.support, &self.motion())
    }

    /// The present half-step and the progress through it.
    pub fn half_step(&self) -> HalfStep {
        self.half_step
    }

    /// The command in force. Turn, extension and sidestep take effect at half-steps, speed over a ramp.
    pub fn command(&self) -> Command {
        Command {
            turn: self.turn.angle(),
            speed: self.speed.target(),
            extension: self.extension.angle(),
            sidestep: self.sidestep.angle(),
        }
    }

    /// Range of the commands that are granted.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The present speed.
    pub fn speed(&self) -> &Speed {
        &self.speed
    }

    /// The turn in this half-step.
    pub fn turn(&self) -> &Deflection {
        &self.turn
    }

    /// The step extension in this half-step.
    pub fn extension(&self) -> &StepExtension {
        &self.extension
    }

    /// The sidestep in this half-step.
    pub fn sidestep(&self) -> &Deflection {
        &self.sidestep
    }

    /// The nominal half-step.
    pub fn table(&self) -> &Arc<NominalTable> {
        &self.table
    }

    /// The mirror between canonical and physical joints on the left foot.
    pub fn mirror(&self) -> &Mirror {
        &self.mirror
    }

    /// Begins the present half-step anew with `command`, from feet side by side: before it has begun to progress.
    pub fn restart(&mut self, command: &Command) {
        self.force(command);
        self.begin_half_step();
    }

    /// Lets the present half-step end with given offsets instead of the command's, from where it began. The next
    /// half-step follows the command again, unless it is aimed, too.
    pub fn aim(&mut self, at: &LegOffsets) {
        self.turn.aim(at.turn);
        self.extension.aim(at.reach);
        self.sidestep.aim(at.spread);
    }

    fn begin_half_step(&mut self) {
        self.turn.begin_half_step(self.half_step.support);
        self.extension.begin_half_step();
        self.sidestep.begin_half_step(self.half_step.support);
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

fn quantities(command: &Command) -> [(Quantity, f64); 4] {
    [
        (Quantity::Turn, command.turn),
        (Quantity::Speed, command.speed),
        (Quantity::Extension, command.extension),
        (Quantity::Sidestep, command.sidestep),
    ]
}
