//! Asked to stop or hold at any moment of a walk by any command that is granted, the robot makes one calm half-step
//! more, stands still on both feet, and walks on when asked to: side by side after a stop, in stride after a hold.

use halfstep_tests::random;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters};
use interface::{Fault, GaitChange, Intent, Mode, Verdict};
use rand::Rng;

#[test]
fn stop_and_hold_lead_to_a_stand_from_any_moment_of_the_walk() {
    for seed in 0..12 {
        let mut random = random(seed);
        let limits = controller_parameters().gait.limits;
        let request = GaitChange {
            turn: Some(random.random_range(-limits.turn_max..=limits.turn_max)),
            speed: Some(random.random_range(limits.speed_min..=limits.speed_max)),
            extension: Some(random.random_range(limits.extension_min..=limits.extension_max)),
            sidestep: Some(random.random_range(-limits.sidestep_max..=limits.sidestep_max)),
        };
        let intent = if seed % 2 == 0 { Intent::Stop } else { Intent::Hold };
        let mut walking = Walking::begin(seed);
        walking.tick(Some((&request, None)));
        walking.walk(4.0 + random.random_range(0.0..1.2));

        let report = walking.ask(GaitChange::default(), Some(intent));
        let answer = report.reply.expect("a request is answered");
        assert_eq!((answer.verdict, answer.intent), (Verdict::Accepted, Some(intent)));
        let stands_at = answer.effect_half_step;
        let half_steps = stands_at - report.report.half_step.index;
        assert!(half_steps == 2, "seed {seed}: stands only after {half_steps} half-steps");

        let mode = if intent == Intent::Stop { Mode::Standing } else { Mode::Holding };
        let braked = walking.walk(7.0);
        let still = walking.walk(5.0);
        let report = walking.tick(None);
        assert_eq!((report.report.mode, report.report.half_step.index), (mode, stands_at), "seed {seed}");
        assert!(!still.has_fallen(), "seed {seed}: fell");
        let moved = (still.com - braked.com).norm();
        assert!(moved < 2e-3, "seed {seed}: moved by {moved} m while standing");
        let heights = still.soles.map(|sole| sole.translation.z.abs());
        assert!(heights.iter().all(|height| *height < 2e-3), "seed {seed}: soles are {heights:?} m off the ground");
        let apart = (still.soles[1].translation.vector - still.soles[0].translation.vector).norm();
        let side_by_side = (apart - 0.19).abs() < 0.01;
        assert_eq!(side_by_side, intent == Intent::Stop, "seed {seed}: the feet are {apart} m apart");

        // And it walks on.
        let report = walking.tick(Some((&GaitChange::default(), Some(Intent::Walk))));
        // A start by an extreme command is limited where the walk by it was not: what is granted keeps the ZMP inside.
        let answer = report.reply.expect("answered");
        assert_ne!(answer.verdict, Verdict::Refused, "seed {seed}");
        let predicted = answer.predicted_margin.expect("half-steps are predicted");
        assert!(predicted >= controller_parameters().feasibility.margin_min, "seed {seed}: {predicted}");
        assert_eq!(answer.verdict == Verdict::Limited, answer.active_limit.is_some(), "seed {seed}: {answer:?}");
        let half_steps = report.report.half_step.index;
        let walked = walking.walk(8.0);
        let report = walking.tick(None);
        assert!(!walked.has_fallen() && report.report.mode == Mode::Walking, "seed {seed}: fell after the start");
        assert!(
            report.report.half_step.index >= half_steps + 5,
            "seed {seed}: only at {}",
            report.report.half_step.index
        );
    }
}

/// The step from a stand in stride to a parallel one is begun and taken back, at many moments: no joint is asked for a
/// rate that it cannot have, and no motor for more than a fraction of its torque in between two ticks.
#[test]
fn a_start_that_is_taken_back_moves_nothing_suddenly() {
    for after in [0.05, 0.2, 0.4, 0.6, 0.75] {
        let mut walking = Walking::begin(4);
        walking.walk(2.0);
        walking.ask(GaitChange::default(), Some(Intent::Hold));
        walking.walk(4.0);
        walking.ask(GaitChange::default(), Some(Intent::Stop));
        walking.walk(after);
        let mut last = walking.ask(GaitChange::default(), Some(Intent::Hold)).setpoint;
        for _ in 0..2000 {
            let tick = walking.tick(None);
            assert!(!tick.report.faults.contains(Fault::RateLimited), "after {after} s");
            let rate = (tick.setpoint.angles - last.angles).max_abs() / PERIOD;
            assert!(rate < 1.5, "after {after} s a joint moves at {rate} rad/s");
            last = tick.setpoint;
        }
        walking.walk(2.0);
        let tick = walking.tick(None);
        assert_eq!(tick.report.mode, Mode::Holding, "after {after} s");
        assert!(!walking.plant.truth().has_fallen());
    }
}
