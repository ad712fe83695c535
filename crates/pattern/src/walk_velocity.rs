//! The velocity of a walk and its gait parameters, either from the other.
//!
//! In a full step of duration `2·T/c` the middle between the feet moves by two half-steps, each along an arc. Their sum
//! is what a velocity comes to in that time. What of it lies ahead is made by two steps of equal length, what lies
//! aside by one sidestep, the turn by one deflection: both in the same half-step, or each in its own where one foot
//! leads the turn and the other one the sidestep. Where the feet land follows from the legs (`step_geometry`); the gait
//! parameters for a velocity are found from that by iteration.
//!
//! **How fast to step** is free. Short quick steps need little swing and much joint rate, long slow ones the reverse;
//! both sway. The effort `e` is the length of `(v_x/v_n, v_y/v_s, ω/ω_s)`, where `v_n` is the nominal walk's speed and
//! `v_s`, `ω_s` are sidesteps and turns of comfortable size at nominal speed. The speed factor is `c₀ + (1 − c₀)·e` up
//! to `e = 1` and `1 + k·(e − 1)` beyond, bounded by the configured range. So the nominal walk stays what it is, and
//! cadence and step length grow together, as people walk. It is continuous in the velocity.

use dynamics::arc_between;
use gait::{LegOffsets, Limits, NominalTable};
use interface::{Command, SteadyWalk, WalkPose, WalkVelocity};
use model::{Mechanism, Side};

use crate::footprint::Footprint;
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
const ROUNDS: usize = 8;

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
        let velocity = self.full_step(command).scaled(command.speed / (2.0 * self.duration));
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
        let asked = velocity.scaled(2.0 * self.duration / speed);
        let (mut step, mut aside, mut turn) = (0.5 * asked.ahead, asked.left, asked.turn);
        let mut command = Command { speed, ..Command::NOMINAL };
        for round in 0..=ROUNDS {
            let reach = self.geometry.reach(step);
            let sidestep = 2.0 * self.geometry.spread(self.sidestep(aside, turn, reach), reach);
            command = Command { turn, speed, extension: 2.0 * reach, sidestep };
            if round < ROUNDS {
                let moved = self.full_step(&command);
                step += 0.5 * (asked.ahead - moved.ahead);
                aside += asked.left - moved.left;
                turn += asked.turn - moved.turn;
            }
        }
        command
    }

    /// The sidestep that moves aside (m), where the turn alone may do so: its foot lands further out if it must.
    fn sidestep(&self, aside: f64, turn: f64, reach: f64) -> f64 {
        let lead = sign(turn);
        let out = self.geometry.further_out(&LegOffsets { turn: 0.5 * turn.abs(), reach, spread: 0.0 });
        if lead * aside < out { aside - lead * out } else { aside }
    }

    /// How far a full step moves the middle between the feet: ahead and to the left (m), and the turn (rad).
    fn full_step(&self, &Command { turn, extension, sidestep, .. }: &Command) -> WalkVelocity {
        // In support coordinates of the foot that does not lead, so that both leads are alike.
        let side = if turn != 0.0 { turn.signum() } else { sign(sidestep) };
        let reach = 0.5 * extension;
        let [turned, spread] = [0.5 * turn.abs(), 0.5 * sidestep.abs()];
        let at_once = turn * sidestep >= 0.0;
        let [leading, following] = if at_once { [spread, 0.0] } else { [0.0, spread] };
        let leading = self.geometry.landing(&LegOffsets { turn: turned, reach, spread: leading });
        let following = self.geometry.landing(&LegOffsets { turn: 0.0, reach, spread: following });

        let first = Footprint::first(Side::Right);
        let second = first.next(&leading);
        let third = second.next(&following);
        let fourth = third.next(&leading);
        let soles = [first, second, third, fourth].map(|foot| foot.pose());
        let middles = [0, 1, 2].map(|index| middle(&soles[index], &soles[index + 1]));
        let [one, other] = [arc_between(&middles[0], &middles[1]), arc_between(&middles[1], &middles[2])];
        WalkVelocity {
            ahead: one.x + other.x,
            left: side * (one.y + other.y),
            turn: side * (one.heading + other.heading),
        }
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

/// The middle between two soles.
fn middle(one: &WalkPose, other: &WalkPose) -> WalkPose {
    let mean = |one: f64, other: f64| 0.5 * (one + other);
    WalkPose { x: mean(one.x, other.x), y: mean(one.y, other.y), heading: mean(one.heading, other.heading) }
}

/// 0 for 0.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use config::Config;
    use gait::{GaitParameters, RampKind, Start, Walk};
    use proptest::prelude::*;

    use super::*;
    use crate::footstep_plan::{FootstepEvent, FootstepPlan};
    use crate::pattern_model::PatternModel;

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

    /// The oracle: the footsteps that are planned, over a full step of a steady walk.
    #[test]
    fn a_velocity_is_what_the_footsteps_of_its_command_come_to() {
        let config = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config");
        let mechanism = Mechanism::load(config.join("mechanism.toml")).unwrap();
        let table = Arc::new(NominalTable::read_csv(&config.join("nominal_half_step.csv")).unwrap());
        let map = map();
        for (ahead, left, turn) in
            [(0.9, 0.0, 0.0), (-0.3, 0.07, -0.9), (-0.13, -0.03, 1.0), (0.3, -0.2, -0.5), (0.0, 0.2, 0.0)]
        {
            let velocity = WalkVelocity { ahead, left, turn };
            let start = Start { command: map.command(&velocity, &LIMITS), ..Start::default() };
            let gait =
                GaitParameters { ramp: RampKind::Quintic, speed_ramp: Duration::from_millis(600), limits: LIMITS };
            let walk = Walk::new(Arc::clone(&table), &mechanism, &gait, start).unwrap();
            let model = PatternModel::new(&mechanism, walk.mirror(), &table);
            let mut plan = FootstepPlan::walking(&model, walk);
            let mut feet = Vec::new();
            while feet.len() < 6 {
                if plan.advance(&model) == FootstepEvent::SupportChange {
                    feet.push(plan.feet.footprint);
                }
            }
            let soles = [2, 3, 4, 5].map(|index| feet[2].sees(&feet[index]));
            let middles = [0, 1, 2].map(|index| middle(&soles[index], &soles[index + 1]));
            let arcs = [0, 1].map(|index| arc_between(&middles[index], &middles[index + 1]));
            let time = 2.0 * map.duration / start.command.speed;
            for (asked, walked) in [
                (ahead, arcs[0].x + arcs[1].x),
                (left, arcs[0].y + arcs[1].y),
                (turn, arcs[0].heading + arcs[1].heading),
            ] {
                assert!((asked * time - walked).abs() < 1e-6, "{velocity:?}: {} in {time} s", walked / time);
            }
        }
    }
}
