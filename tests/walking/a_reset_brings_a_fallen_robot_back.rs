//! Put on its feet after a fall, a robot is reset, stands and walks; put down in another posture, it is told why not.

use std::f64::consts::TAU;

use halfstep_tests::fall_trial::{AfterReset, FallTrial};
use interface::Reason;
use model::Joint::{self, *};

/// A fall to one of eight sides at one of eight phases of a stride; the reset comes after 0.3 to 1 s.
fn trial(index: u32) -> FallTrial {
    FallTrial {
        seed: u64::from(index),
        pushed_at: 2.4 + 0.15 * f64::from(index),
        towards: TAU * f64::from(3 * index) / 8.0,
        lies_for: 0.5,
        held_for: 0.3 + 0.1 * f64::from(index),
        bent: &[],
        is_other: false,
    }
}

#[test]
fn a_reset_after_a_fall_to_any_side_leads_back_to_the_walk() {
    for index in 0..8 {
        let trial = FallTrial { is_other: index % 2 == 1, ..trial(index) };
        assert_eq!(trial.run(), AfterReset::Walks, "{trial:?}");
    }
}

#[test]
fn a_robot_put_down_almost_in_a_stand_is_brought_to_it() {
    let bent: [&[(Joint, f64)]; 4] = [
        &[(RightKnee, -0.03), (LeftShoulder, 1.0)],
        &[(LeftHipPitch, -0.03), (WaistPitch, 0.1)],
        &[(RightAnklePitch, 0.11), (LeftAnklePitch, -0.11)],
        &[(RightAnklePitch, -0.05), (LeftAnklePitch, 0.05)],
    ];
    for (index, bent) in bent.into_iter().enumerate() {
        let trial = FallTrial { bent, ..trial(index as u32) };
        assert_eq!(trial.run(), AfterReset::Walks, "{trial:?}");
    }
}

#[test]
fn a_robot_put_down_in_another_posture_is_told_what_is_wrong_with_it() {
    let bent: [(&[(Joint, f64)], Reason); 4] = [
        (&[(RightKnee, -0.1)], Reason::NotInStand),
        (&[(LeftHipRoll, 0.3)], Reason::NotInStand),
        (&[(RightAnklePitch, -0.1), (LeftAnklePitch, 0.1)], Reason::Margin),
        (&[(RightAnklePitch, 0.5), (LeftAnklePitch, -0.5)], Reason::FaultPersists),
    ];
    for (index, (bent, reason)) in bent.into_iter().enumerate() {
        for is_other in [false, true] {
            let trial = FallTrial { bent, is_other, ..trial(index as u32) };
            assert_eq!(trial.run(), AfterReset::Refused(reason), "{trial:?}");
        }
    }
}
