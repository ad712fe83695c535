//! Tests of plans that change while they are played.

use std::time::Duration;

use config::Config;
use gait::{GaitParameters, Limits, NominalTable, RampKind, Start};

use super::*;

fn walking() -> PatternGenerator {
    let config = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config");
    let mechanism = Mechanism::load(config.join("mechanism.toml")).unwrap();
    let table = NominalTable::read_csv(&config.join("nominal_half_step.csv")).unwrap();
    let limits = Limits {
        turn_max: 0.5,
        speed_min: 0.6,
        speed_max: 1.4,
        extension_min: -0.14,
        extension_max: 0.14,
        sidestep_max: 0.2,
    };
    let gait = GaitParameters { ramp: RampKind::Quintic, speed_ramp: Duration::from_millis(600), limits };
    let walk = Walk::new(Arc::new(table), &mechanism, &gait, Start::default()).unwrap();
    PatternGenerator::walking(&mechanism, walk)
}

fn advance(generator: &mut PatternGenerator, ticks: u32) {
    (0..ticks).for_each(|_| _ = generator.advance(1e-3));
}

#[test]
fn adopted_plan_leaves_the_present_motion_unchanged_and_is_played_from_then_on() {
    let mut generator = walking();
    advance(&mut generator, 1234);
    let mut other = generator.clone();
    other.admit(&GaitChange { turn: Some(0.2), speed: Some(1.2), ..GaitChange::NONE });
    let before = generator.physical_motion();
    assert_ne!(generator.revision(), other.revision());
    generator.adopt(&other);
    assert_eq!(generator.physical_motion(), before);
    assert_eq!(generator.revision(), other.revision());
    for _ in 0..1500 {
        advance(&mut generator, 1);
        advance(&mut other, 1);
        assert_eq!(generator.physical_motion(), other.physical_motion());
    }
    assert_eq!(generator.command().turn, 0.2);
}

#[test]
fn incremental_replan_takes_over_within_two_knots() {
    let stand = Goal::Stand(Stance::Parallel);
    for ticks in [700, 703, 708] {
        let mut generator = walking();
        advance(&mut generator, ticks);
        generator.set_goal_soon(stand);
        advance(&mut generator, 20);
        assert!(matches!(generator.gait_state(), GaitState::Stopping { .. }), "after {ticks} ticks");
    }
}

/// What is planned ahead must be what is made, whatever is requested when: else the body is planned over other feet
/// than it stands on.
#[test]
fn what_is_planned_ahead_stands_on_the_footsteps_that_are_made() {
    let mut generator = walking();
    let velocities = [(0.5, 0.0, 0.0), (0.1, 0.1, -0.5), (-0.2, 0.0, 0.6), (0.3, -0.1, 0.0), (0.0, 0.0, 0.8)];
    let paces = [Pace::InStep, Pace::Quick, Pace::Gradual, Pace::InStep];
    for request in 0..60 {
        advance(&mut generator, 137 + 61 * (request % 11));
        let (ahead, left, turn) = velocities[request as usize % velocities.len()];
        let command = generator.command_at(&WalkVelocity { ahead, left, turn });
        generator.admit_at(paces[request as usize % paces.len()], &command.into());
        generator.set_goal(Goal::Walk);
        for _ in 0..40 {
            let is_foreseen = generator.plan.foresees_its_footsteps(&generator.model);
            assert!(is_foreseen, "request {request}, {:?}", generator.half_step());
            advance(&mut generator, 41);
            if generator.half_step().progress > 0.5 {
                break;
            }
        }
    }
}
