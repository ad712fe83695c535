//! What is granted in a stand is what would be granted as the walk begins: gait parameters are not stored unchecked,
//! and a start is not excused by what was stored.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{GaitChange, Intent, Mode, Reply, Verdict};

const EXTREME: GaitChange = GaitChange { turn: Some(0.52), speed: Some(1.5), extension: Some(0.2), ..GaitChange::NONE };

/// A robot whose margin must be so large that not everything in the configured range is granted.
fn standing(margin_min: f64) -> Walking {
    let mut parameters = controller_parameters();
    parameters.feasibility.margin_min = margin_min;
    let mut walking = Walking::begin_with(&mechanism(), &parameters, &plant_parameters(), 5);
    walking.walk(1.0);
    walking.ask(GaitChange::NONE, Some(Intent::Stop));
    walking.walk(4.0);
    assert_eq!(walking.controller().mode(), Mode::Standing);
    walking
}

fn reply(walking: &mut Walking, change: GaitChange, intent: Option<Intent>) -> Reply {
    walking.ask(change, intent).reply.expect("a reply within a half-step")
}

#[test]
fn gait_parameters_are_limited_in_a_stand_as_by_a_start() {
    let margin_min = 0.034;
    let at_once = reply(&mut standing(margin_min), EXTREME, Some(Intent::Walk));
    assert_eq!(at_once.verdict, Verdict::Limited, "{at_once:?}");

    let mut walking = standing(margin_min);
    let stored = reply(&mut walking, EXTREME, None);
    assert_eq!((stored.verdict, stored.granted), (Verdict::Limited, at_once.granted));
    let started = reply(&mut walking, GaitChange::NONE, Some(Intent::Walk));
    assert_eq!(started.verdict, Verdict::Accepted);
    let predicted = started.predicted_margin.expect("half-steps are predicted");
    assert!(predicted > margin_min - 1e-3, "{predicted}");
}

#[test]
fn what_is_granted_at_half_speed_is_seen_in_effect() {
    let slow = GaitChange { speed: Some(0.5), ..GaitChange::NONE };
    let mut walking = Walking::begin(9);
    walking.walk(1.0);
    reply(&mut walking, slow, None);
    walking.walk(5.0);
    // The turn begins up to 3.6 s later, at 1.2 s for a half-step.
    let turning = reply(&mut walking, GaitChange { turn: Some(0.5), ..GaitChange::NONE }, None);
    let predicted = turning.predicted_margin.expect("half-steps are predicted");
    let mut least = f64::INFINITY;
    for _ in 0..12_000 {
        let tick = walking.tick(None);
        let progress = tick.report.half_step.progress;
        if (0.1..0.9).contains(&progress) {
            least = tick.report.margin.map_or(least, |margin| least.min(margin));
        }
    }
    assert!(least > predicted - 0.012, "predicted {predicted}, measured {least}");
}
