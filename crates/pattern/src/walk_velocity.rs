//! The velocity of a walk and its gait parameters, either from the other.
//!
//! A full step of duration `2·T/c` moves the middle between the feet by `d = v·2·T/c`. What of `d` lies ahead is made
//! by two steps of equal length, what lies aside by one sidestep, the turn by one deflection. In the frame between the
//! headings before and after, with steps `s`, sidestep `a` and turn `α` at a distance `w` of the feet,
//!
//! ```text
//! ahead = s·(1 + cos α/2)        aside = a ± w·(1 − cos α/2)
//! ```
//!
//! since turning out moves the middle a little towards the foot that leads. A steady velocity on an arc is a chord of
//! length `v·2·T/c · sin(α/2)/(α/2)`.
//!
//! **How fast to step** is free. Short quick steps need little swing and much joint rate, long slow ones the reverse;
//! both sway. The effort `e` is the length of `(v_x/v_n, v_y/v_s, ω/ω_s)`, where `v_n` is the nominal walk's speed and
//! `v_s`, `ω_s` are sidesteps and turns of comfortable size at nominal speed. The speed factor is `c₀ + (1 − c₀)·e` up
//! to `e = 1` and `1 + k·(e − 1)` beyond, bounded by the configured range. So the nominal walk stays what it is, and
//! cadence and step length grow together, as people walk. It is continuous in the velocity.

use dynamics::sin_cos;
use gait::{Limits, NominalTable};
use interface::{Command, SteadyWalk, WalkVelocity};
use model::Mechanism;

use crate::step_geometry::StepGeometry;

/// The relation of velocity and gait parameters for a robot and its nominal half-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityMap {
    geometry: StepGeometry,
    /// Duration of the nominal half-step (s).
    duration: f64,
}

/// `c₀`: speed factor of the slowest walk.
const SPEED_AT_REST: f64 = 0.8;
/// `k`: growth of the speed factor with the effort.
const SPEED_GROWTH: f64 = 0.3;
/// Sidestep of comfortable size, in legs' heights (-): 10° at the hips of the paper's robot.
const SIDESTEP: f64 = 0.17;
/// Turn of comfortable size (rad per full step).
const TURN: f64 = 0.42;
/// Rounds of the inversion: each leaves a tenth of the error or less.
const ROUNDS: usize = 6;

impl VelocityMap {
    /// For a robot with its nominal half-step.
    pub fn new(mechanism: &Mechanism, table: &NominalTable) -> Self {
        Self { geometry: StepGeometry::new(mechanism, table), duration: table.duration }
    }

    /// What gait parameters come to once the walk is steady.
    pub fn steady_walk(&self, command: &Command) -> SteadyWalk {
        let reach = 0.5 * command.extension;
        let step_ahead = self.geometry.step(reach);
        let step_aside = self.geometry.aside(0.5 * command.sidestep, reach);
        let [ahead, left] = self.moved(step_ahead, step_aside, command.turn);
        let per_time = command.speed / (2.0 * self.duration);
        // From the chord to the arc.
        let arc = per_time / sine_ratio(0.5 * command.turn);
        let velocity = WalkVelocity { ahead: ahead * arc, left: left * arc, turn: command.turn * per_time };
        SteadyWalk { step_ahead, step_aside, velocity }
    }

    /// Step lengths of the robot.
    pub(crate) fn geometry(&self) -> &StepGeometry {
        &self.geometry
    }

    /// The swing ahead of either leg (rad) that leaves the feet side by side.
    pub(crate) fn no_step(&self) -> f64 {
        self.geometry.reach(0.0)
    }

    /// How much further apart upright legs put the soles that swing away from each other by `spread` each (rad) (m).
    pub(crate) fn aside(&self, spread: f64) -> f64 {
        self.geometry.aside(spread, 0.0)
    }

    /// The gait parameters of a steady walk at a velocity. They may be outside every range.
    pub fn command(&self, velocity: &WalkVelocity, limits: &Limits) -> Command {
        let speed = self.speed(velocity).clamp(limits.speed_min, limits.speed_max);
        let time = 2.0 * self.duration / speed;
        let turn = velocity.turn * time;
        let chord = time * sine_ratio(0.5 * turn);
        let (ahead, left) = (velocity.ahead * chord, velocity.left * chord);
        let (mut step, mut aside) = (0.5 * ahead, left);
        for _ in 0..ROUNDS {
            let [moved_ahead, moved_left] = self.moved(step, aside, turn);
            step += 0.5 * (ahead - moved_ahead);
            aside += left - moved_left;
        }
        let reach = self.geometry.reach(step);
        Command { turn, speed, extension: 2.0 * reach, sidestep: 2.0 * self.geometry.spread(aside, reach) }
    }

    /// How far a full step moves the middle between the feet (m), ahead and to the left, in the frame between the
    /// headings before and after.
    ///
    /// * `step` – length of either step (m)
    /// * `aside` – the sidestep (m), positive to the left
    /// * `turn` – the change of heading (rad)
    fn moved(&self, step: f64, aside: f64, turn: f64) -> [f64; 2] {
        let (_, cosine) = sin_cos(0.5 * turn);
        let towards_lead = self.geometry.width * (1.0 - cosine) * sign(turn);
        // Where one foot leads the turn and the other one the sidestep, they are seen at an angle.
        let seen = if turn * aside < 0.0 { aside * cosine } else { aside };
        [step * (1.0 + cosine), seen + towards_lead]
    }

    /// The speed factor for a velocity.
    fn speed(&self, velocity: &WalkVelocity) -> f64 {
        let time = 2.0 * self.duration;
        let nominal = 2.0 * self.geometry.step(0.0) / time;
        let sidestep = SIDESTEP * self.geometry.aside(std::f64::consts::FRAC_PI_2, 0.0) / 2.0 / time;
        let effort = [velocity.ahead / nominal, velocity.left / sidestep, velocity.turn * time / TURN];
        let effort = effort.into_iter().map(|part| part * part).sum::<f64>().sqrt();
        let growth = if effort < 1.0 { 1.0 - SPEED_AT_REST } else { SPEED_GROWTH };
        1.0 + growth * (effort - 1.0)
    }
}

/// `sin(x)/x`.
fn sine_ratio(x: f64) -> f64 {
    if x.abs() < 1e-6 { 1.0 } else { sin_cos(x).0 / x }
}

/// 0 for 0.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use proptest::prelude::*;

    use super::*;

    const LIMITS: Limits = Limits {
        turn_max: 0.9,
        speed_min: 0.5,
        speed_max: 1.7,
        extension_min: -0.7,
        extension_max: 0.4,
        sidestep_max: 0.5,
    };

    fn map() -> VelocityMap {
        let config = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config");
        let mechanism = Mechanism::load(config.join("mechanism.toml")).unwrap();
        VelocityMap::new(&mechanism, &NominalTable::read_csv(&config.join("nominal_half_step.csv")).unwrap())
    }

    fn any_velocity() -> impl Strategy<Value = WalkVelocity> {
        (-0.6..1.2, -0.3..0.3, -1.0..1.0).prop_map(|(ahead, left, turn)| WalkVelocity { ahead, left, turn })
    }

    fn values(command: &Command) -> [f64; 4] {
        [command.turn, command.speed, command.extension, command.sidestep]
    }

    proptest! {
        #[test]
        fn the_command_for_a_velocity_walks_at_it(velocity in any_velocity()) {
            let map = map();
            let back = map.steady_walk(&map.command(&velocity, &LIMITS)).velocity;
            for (asked, got) in [
                (velocity.ahead, back.ahead),
                (velocity.left, back.left),
                (velocity.turn, back.turn),
            ] {
                prop_assert!((asked - got).abs() < 1e-6, "{velocity:?}: {back:?}");
            }
        }

        #[test]
        fn commands_are_continuous_in_the_velocity(velocity in any_velocity(), direction in any_velocity()) {
            let map = map();
            let step = direction.scaled(1e-5);
            let next = WalkVelocity {
                ahead: velocity.ahead + step.ahead,
                left: velocity.left + step.left,
                turn: velocity.turn + step.turn,
            };
            let [here, there] = [&velocity, &next].map(|velocity| values(&map.command(velocity, &LIMITS)));
            for (one, other) in here.iter().zip(there) {
                prop_assert!((one - other).abs() < 1e-3, "{here:?} {there:?}");
            }
        }
    }

    #[test]
    fn the_nominal_walk_is_the_command_for_its_own_velocity() {
        let map = map();
        let velocity = map.steady_walk(&Command::NOMINAL).velocity;
        for (nominal, found) in values(&Command::NOMINAL).iter().zip(values(&map.command(&velocity, &LIMITS))) {
            assert!((nominal - found).abs() < 1e-9, "{found}");
        }
    }

    #[test]
    fn opposite_sides_are_mirror_images() {
        let map = map();
        let to_the =
            |side: f64| map.command(&WalkVelocity { ahead: 0.3, left: side * 0.1, turn: side * -0.4 }, &LIMITS);
        let (left, right) = (to_the(1.0), to_the(-1.0));
        assert_eq!((left.turn, left.sidestep), (-right.turn, -right.sidestep));
        assert_eq!((left.speed, left.extension), (right.speed, right.extension));
    }
}
