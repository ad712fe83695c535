//! Goal: what the robot does on its left foot is the mirror image of what it does on its right.
//!
//! Method: two walks with the same requests, one begun on the right foot, the other on the left with turns and
//! sidesteps the other way: canonical motions agree to the last bit, physical ones are each other's mirror image.

mod common;

use gait::{GaitParameters, RampKind};
use interface::{Command, GaitChange};
use model::{Mirrored, Side};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_left_walk_is_the_mirror_image_of_a_right_walk(stream in common::streams(), linear: bool) {
        let ramp = if linear { RampKind::Linear } else { RampKind::Quintic };
        let parameters = GaitParameters { ramp, ..common::parameters() };
        let mut right = common::walk(&parameters, Side::Right, Command::NOMINAL);
        let mut left = common::walk(&parameters, Side::Left, Command::NOMINAL);
        for (ticks, request) in stream {
            let to_right = right.admit(&request);
            let [turn, sidestep] = [request.turn, request.sidestep].map(|angle| angle.map(|angle| -angle));
            let to_left = left.admit(&GaitChange { turn, sidestep, ..request });
            prop_assert_eq!(to_right.verdict, to_left.verdict);
            prop_assert_eq!(to_right.effect_half_step, to_left.effect_half_step);
            for _ in 0..ticks {
                right.advance(0.002);
                left.advance(0.002);
                prop_assert_eq!(right.half_step().support, left.half_step().support.other());
                prop_assert_eq!(right.motion(), left.motion());
                prop_assert_eq!(right.physical_motion().mirrored(right.mirror()), left.physical_motion());
            }
        }
    }
}
