//! Goal: a half-step that is redirected goes on smoothly from where it is and ends as one that had begun with the new
//! command, if its swing foot leads there; else the next one does. The returned half-step tells which.
//!
//! Method: random commands at random instants, each against the offsets that the command asks for.

mod common;

use interface::Command;
use model::Side;
use proptest::prelude::*;

fn command() -> impl Strategy<Value = Command> {
    let angle = |max: f64| prop_oneof![Just(0.0), -max..max];
    (angle(0.5), angle(0.139), angle(0.25)).prop_map(|(turn, extension, sidestep)| Command {
        turn,
        extension,
        sidestep,
        ..Command::NOMINAL
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_redirected_half_step_is_smooth_and_in_effect_when_told(
        first in command(), second in command(), progress in 0.02..0.6, half_steps in 0..4_u32, left: bool,
    ) {
        let support = if left { Side::Left } else { Side::Right };
        let mut walk = common::walk(&common::parameters(), support, first);
        (0..half_steps).for_each(|_| _ = walk.advance(common::DURATION));
        walk.advance(progress * common::DURATION);
        let before = walk.motion();
        let effect = walk.redirect(&second, &first);
        let after = walk.motion();
        prop_assert!((before.angles - after.angles).max_abs() < 1e-12);
        prop_assert!((before.rates - after.rates).max_abs() < 1e-10);
        prop_assert!((before.accelerations - after.accelerations).max_abs() < 1e-8);

        // The extension is that of this half-step already.
        prop_assert_eq!(walk.extension().per_hip(1.0).value, 0.5 * second.extension);
        prop_assert!(effect <= walk.half_step().index + 3);
        while walk.half_step().index < effect {
            walk.advance(common::DURATION);
        }
        // From then on a turn and a sidestep that lead with this foot deflect, and others wait for theirs.
        for (deflection, angle) in [(walk.turn(), second.turn), (walk.sidestep(), second.sidestep)] {
            let ends = deflection.per_hip(1.0).value;
            prop_assert!(ends == 0.0 || ends == 0.5 * angle.abs(), "{ends} for {angle}");
        }
        // In two half-steps both feet have led.
        let mut ends = [0.0_f64; 2];
        for _ in 0..2 {
            ends[0] = ends[0].max(walk.turn().per_hip(1.0).value);
            ends[1] = ends[1].max(walk.sidestep().per_hip(1.0).value);
            walk.advance(common::DURATION);
        }
        prop_assert_eq!(ends, [0.5 * second.turn.abs(), 0.5 * second.sidestep.abs()]);
    }
}
