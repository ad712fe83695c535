//! The pace at which a walk changes over to other gait parameters.

use interface::Command;

/// How much of a change each half-step makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// All of it, as soon as each parameter can change: what gait parameters ask for.
    AtOnce,
    /// As [`Quick`](Self::Quick), beginning with the present half-step, unless it is too late for that.
    InStep,
    /// Most of it: two or three half-steps from one end of the range to the other.
    Quick,
    /// Little: the body lags behind least, and more can be granted.
    Gradual,
}

/// The largest change in a half-step: turn, extension, sidestep (rad), and speed (-), which takes a ramp for each.
const QUICK: [f64; 4] = [0.6, 0.35, 0.3, 2.0];
const GRADUAL: [f64; 4] = [0.35, 0.12, 0.18, 0.1];

impl Pace {
    fn change_max(self) -> [f64; 4] {
        match self {
            Pace::AtOnce => [f64::INFINITY; 4],
            Pace::InStep | Pace::Quick => QUICK,
            Pace::Gradual => GRADUAL,
        }
    }

    /// The command on the way from one to another that the next half-step makes.
    pub(crate) fn towards(self, from: &Command, to: &Command) -> Command {
        let [turn, extension, sidestep, speed] = self.change_max();
        let step =
            |from: f64, to: f64, max: f64| if (to - from).abs() <= max { to } else { from + max.copysign(to - from) };
        Command {
            turn: step(from.turn, to.turn, turn),
            speed: step(from.speed, to.speed, speed),
            extension: step(from.extension, to.extension, extension),
            sidestep: step(from.sidestep, to.sidestep, sidestep),
        }
    }

    /// The number of half-steps in which a walk changes over from one command to another.
    pub(crate) fn half_steps(self, from: &Command, to: &Command) -> u64 {
        let changes =
            [to.turn - from.turn, to.extension - from.extension, to.sidestep - from.sidestep, to.speed - from.speed];
        let needed = changes.iter().zip(self.change_max()).map(|(change, max)| (change.abs() / max).ceil());
        needed.fold(0.0, f64::max) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_arrives_after_as_many_half_steps_as_told() {
        let from = Command { turn: -0.5, speed: 0.8, extension: -0.6, sidestep: 0.0 };
        let to = Command { turn: 0.3, speed: 1.5, extension: 0.2, sidestep: -0.25 };
        for pace in [Pace::AtOnce, Pace::InStep, Pace::Quick, Pace::Gradual] {
            let (mut now, told) = (from, pace.half_steps(&from, &to).max(1));
            for half_step in 1..=told {
                now = pace.towards(&now, &to);
                assert_eq!(now == to, half_step == told, "{pace:?} after {half_step} of {told}");
            }
        }
        assert_eq!(Pace::Gradual.half_steps(&to, &to), 0);
    }
}
