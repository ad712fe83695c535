//! Goal: a half-step that is aimed ends with the leg offsets that it was told, begins as it would have, and the walk
//! goes on from there by its command: no joint jumps at either end.
//!
//! Method: random offsets for several half-steps in a row, then two half-steps of the command, which restore.

mod common;

use gait::LegOffsets;
use interface::Command;
use model::Side;
use proptest::prelude::*;

fn offsets() -> impl Strategy<Value = LegOffsets> {
    (-0.05..0.4, -0.3..0.3, -0.05..0.3).prop_map(|(turn, reach, spread)| LegOffsets { turn, reach, spread })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn aimed_half_steps_join_and_end_as_told(aims in prop::collection::vec(offsets(), 1..5), left: bool) {
        let support = if left { Side::Left } else { Side::Right };
        let mut walk = common::walk(&common::parameters(), support, Command { turn: 0.2, ..Command::NOMINAL });
        for aim in &aims {
            let began = walk.motion_at(0.0).angles;
            walk.aim(aim);
            prop_assert!((walk.motion_at(0.0).angles - began).max_abs() < 1e-12, "it begins as before");
            let [turn, reach, spread] =
                [walk.turn().per_hip(1.0), walk.extension().per_hip(1.0), walk.sidestep().per_hip(1.0)];
            prop_assert_eq!([turn.value, reach.value, spread.value], [aim.turn, aim.reach, aim.spread]);
            prop_assert_eq!([turn.rate, reach.rate, spread.rate], [0.0; 3]);
            let ends = walk.mirror().to_physical(walk.half_step().support, &walk.motion_at(1.0).angles);
            prop_assert!(walk.advance(common::DURATION));
            let begins = walk.mirror().to_physical(walk.half_step().support, &walk.motion_at(0.0).angles);
            prop_assert!((ends - begins).max_abs() < 1e-9, "{}", (ends - begins).max_abs());
        }
        // Whatever the last offsets, within a full step the command is walked again.
        walk.admit(&Command::NOMINAL.into());
        for _ in 0..2 {
            walk.advance(common::DURATION);
        }
        prop_assert_eq!(walk.turn().per_hip(1.0).value, 0.0);
        prop_assert_eq!(walk.sidestep().per_hip(1.0).value, 0.0);
        prop_assert!((walk.angles_at(1.0) - walk.table().angles_at(1.0)).max_abs() < 1e-12);
    }
}
