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

/// The oracle: the centre of mass of a steady walk of any kind, as it is played.
#[test]
fn the_divergent_component_wanted_at_touchdown_is_that_of_the_steady_walk() {
    for (ahead, left, turn) in [(0.4, 0.0, 0.0), (0.2, 0.08, 0.0), (-0.2, 0.0, 0.0), (0.3, 0.0, 0.5), (0.0, 0.0, 0.0)] {
        let mut generator = walking();
        let command = generator.command_at(&WalkVelocity { ahead, left, turn });
        generator.admit(&command.into());
        advance(&mut generator, 6000);
        while generator.half_step().progress < 0.7 {
            advance(&mut generator, 1);
        }
        let wanted = generator.plan.dcm_at_touchdown(&generator.model);
        let index = generator.half_step().index;
        let mut last = Vector2::zeros();
        while generator.half_step().index == index {
            let motion = generator.motion();
            let kinematics = dynamics::Kinematics::fixed_base(generator.tree(), &motion.angles);
            last = kinematics.com_state(generator.tree(), &motion.rates).divergent_component();
            advance(&mut generator, 1);
        }
        assert!((last - wanted).amax() < 0.02, "{ahead} {left} {turn}: {wanted} instead of {last}");
    }
}

/// The plan takes the choice over within two knots, and it is played two knots later.
#[test]
fn a_chosen_step_lands_where_and_when_it_was_chosen_and_the_next_one_as_planned() {
    let mut generator = walking();
    advance(&mut generator, 2650);
    let before = generator.half_step();
    assert!((0.3..0.5).contains(&before.progress));
    let planned = generator.landings()[0];
    let offset = Vector2::new(-0.06, 0.04);
    generator.adjust_step(StepChoice { offset, knots: Some(15) });
    let mut ticks = 0;
    while generator.half_step().index == before.index {
        advance(&mut generator, 1);
        ticks += 1;
        if generator.half_step().index == before.index && ticks > 40 {
            let landing = generator.landings()[0];
            let lateral = before.support.lateral_sign();
            assert!((landing.x - planned.x - offset.x).abs() < 1e-9, "{landing:?}");
            assert!((landing.y - planned.y - lateral * offset.y).abs() < 1e-9, "{landing:?}");
        }
    }
    assert!((170..200).contains(&ticks), "touchdown after {ticks} ms");
    advance(&mut generator, 2000);
    assert_eq!(generator.speed(), 1.0, "the speed returns");
}

#[test]
fn a_stop_that_is_pushed_still_ends_with_the_feet_side_by_side() {
    let mut generator = walking();
    advance(&mut generator, 2400);
    generator.set_goal(Goal::Stand(Stance::Parallel));
    while !matches!(generator.gait_state(), GaitState::Stopping { half_steps: 1, .. }) {
        advance(&mut generator, 1);
    }
    advance(&mut generator, 200);
    generator.adjust_step(StepChoice { offset: Vector2::new(0.08, 0.03), knots: None });
    advance(&mut generator, 4000);
    assert_eq!(generator.gait_state(), GaitState::Standing(Stance::Parallel));
    let kinematics = dynamics::Kinematics::fixed_base(generator.tree(), &generator.motion().angles);
    let other = kinematics.sole_to_world(&generator.model.mechanism, model::Side::Left).translation.vector;
    assert!(other.x.abs() < 1e-3, "{other}");
}

/// At speed 0 a half-step never ends: the choice must end all the same.
#[test]
fn a_step_is_chosen_in_a_walk_that_is_held_at_its_beginning() {
    let mut generator = walking();
    generator.plan.hold_speed();
    advance(&mut generator, 500);
    let measured = MeasuredBalance {
        dcm: Vector2::new(0.3, 0.1),
        zmp_bounds: [Vector2::new(-0.065, -0.035), Vector2::new(0.205, 0.035)],
    };
    let choice = generator.plan.choose_step(&generator.model, &measured, 0.0).expect("it is pushed hard");
    assert!(choice.knots.is_some_and(|knots| knots < 300), "{choice:?}");
}
