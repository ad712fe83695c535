//! The report says at every tick whether the robot can still be kept from falling: by its ankles, by steps, or not.
//! `survey capturability` counts how often it is right about pushes around the limit.

use halfstep_tests::pushing::{Direction, PUSH_DURATION, stand, walk_to};
use halfstep_tests::walking::{PERIOD, Walking};
use interface::{Capturability, GaitChange};

/// What was reported after a push.
struct Judged {
    /// Each judgement in its order, without repetitions.
    sequence: Vec<Capturability>,
    has_fallen: bool,
    /// For how long it has been reported as lost, at the end (s).
    lost_for: f64,
}

/// A robot that falls over is on its way down for about as long: what is told then is no foresight (s).
const ON_ITS_WAY_DOWN: f64 = 0.2;

fn pushed(mut walking: Walking, direction: Direction, impulse: f64) -> Judged {
    let support = walking.tick(None).report.half_step.support;
    walking.plant.push(direction.in_world(&walking, support) * impulse, PUSH_DURATION);
    let (mut sequence, mut lost_for) = (Vec::new(), 0.0);
    for _ in 0..5000 {
        let tick = walking.tick(None);
        let is_lost = tick.report.capturability == Some(Capturability::Lost);
        lost_for = if is_lost { lost_for + PERIOD } else { 0.0 };
        sequence.extend(tick.report.capturability);
        sequence.dedup();
        if walking.has_fallen(&tick) {
            return Judged { sequence, has_fallen: true, lost_for };
        }
    }
    Judged { sequence, has_fallen: false, lost_for }
}

fn walking() -> Walking {
    walk_to(0, GaitChange::NONE, 8, 0.3).expect("the nominal walks")
}

#[test]
fn an_undisturbed_walk_is_always_balanced() {
    let judged = pushed(walking(), Direction::Forward, 0.0);
    assert_eq!(judged.sequence, [Capturability::ByAnkles]);
}

#[test]
fn a_push_that_is_survived_is_caught_by_steps_and_forgotten() {
    for (direction, impulse) in [(Direction::Forward, 25.0), (Direction::Back, 22.0), (Direction::ToSwing, 12.0)] {
        let Judged { sequence, has_fallen, .. } = pushed(walking(), direction, impulse);
        assert!(!has_fallen && sequence.contains(&Capturability::BySteps), "{direction:?}: {sequence:?}");
        assert_eq!(sequence.last(), Some(&Capturability::ByAnkles), "{direction:?}: {sequence:?}");
        assert!(!sequence.contains(&Capturability::Lost), "{direction:?}: {sequence:?}");
    }
}

#[test]
fn a_fall_is_foreseen() {
    for direction in Direction::ALL {
        let Judged { sequence, has_fallen, lost_for } = pushed(walking(), direction, 90.0);
        assert!(has_fallen && lost_for > ON_ITS_WAY_DOWN, "{direction:?}: {lost_for} s, {sequence:?}");
        assert!(sequence.contains(&Capturability::BySteps), "it was not lost from the beginning: {sequence:?}");
    }
}

#[test]
fn a_stand_is_lost_once_it_leaves_its_feet() {
    for direction in Direction::ALL {
        let judged = pushed(stand(0), direction, 6.0);
        assert!(!judged.has_fallen && judged.sequence == [Capturability::ByAnkles], "{:?}", judged.sequence);
        let judged = pushed(stand(0), direction, 60.0);
        assert!(judged.has_fallen && judged.lost_for > ON_ITS_WAY_DOWN, "{direction:?}: {} s", judged.lost_for);
        assert_eq!(judged.sequence, [Capturability::ByAnkles, Capturability::Lost], "{direction:?}");
    }
}
