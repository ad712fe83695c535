//! Asked to step in place the robot lifts one foot after the other and gets nowhere; asked to turn as well it turns
//! where it is; asked to walk again it walks.

use std::f64::consts::TAU;

use halfstep_tests::walking::Walking;
use interface::{GaitChange, Intent, Mode, Verdict};
use plant::Truth;

/// Asks to step in place and waits until it does.
fn in_place(walking: &mut Walking, turn: f64) -> Truth {
    let request = GaitChange { turn: Some(turn), ..GaitChange::default() };
    let report = walking.ask(request, Some(Intent::InPlace));
    assert_eq!(report.reply.expect("answered").verdict, Verdict::Accepted);
    let truth = walking.walk(4.0);
    assert_eq!(walking.tick(None).report.mode, Mode::InPlace);
    truth
}

fn heading(truth: &Truth) -> f64 {
    let ahead = truth.soles.map(|sole| sole.rotation * nalgebra::Vector3::x()).iter().sum::<nalgebra::Vector3<f64>>();
    ahead.y.atan2(ahead.x)
}

#[test]
fn steps_in_place_without_leaving_the_place() {
    for speed in [0.6, 1.0, 1.5] {
        let mut walking = Walking::begin(1);
        walking.ask(GaitChange { speed: Some(speed), ..GaitChange::default() }, None);
        walking.walk(3.0);
        let before = in_place(&mut walking, 0.0);
        let half_step = walking.tick(None).report.half_step.index;
        let mut lifted = [0.0_f64; 2];
        for _ in 0..6000 {
            walking.tick(None);
            let truth = walking.plant.truth();
            for (lifted, sole) in lifted.iter_mut().zip(truth.soles) {
                *lifted = lifted.max(sole.translation.z);
            }
        }
        let after = walking.plant.truth();
        assert!(!after.has_fallen(), "c = {speed}: fell");
        assert!(walking.tick(None).report.half_step.index >= half_step + 4, "c = {speed}: it steps");
        assert!(lifted.iter().all(|height| *height > 0.03), "c = {speed}: feet are lifted by {lifted:?} m only");
        let moved = (after.com - before.com).xy().norm();
        assert!(moved < 0.06, "c = {speed}: got {moved} m away");

        let report = walking.ask(GaitChange::default(), Some(Intent::Walk));
        assert_eq!(report.reply.expect("answered").verdict, Verdict::Accepted);
        let walked = walking.walk(6.0);
        assert!(!walked.has_fallen() && walking.tick(None).report.mode == Mode::Walking, "c = {speed}: walks on");
        assert!((walked.com - after.com).xy().norm() > 1.0, "c = {speed}: gets ahead again");
    }
}

#[test]
fn turns_while_stepping_in_place() {
    for turn in [-0.35_f64, 0.2, 0.5] {
        let mut walking = Walking::begin(2);
        walking.walk(2.0);
        in_place(&mut walking, turn);
        // From a support change after which the feet are parallel to another one.
        let at_swap = |walking: &mut Walking, index: u64| {
            while walking.tick(None).report.half_step.index < index {}
            walking.plant.truth()
        };
        let from = walking.tick(None).report.half_step.index.next_multiple_of(2);
        let before = at_swap(&mut walking, from);
        let full_steps = 4;
        let after = at_swap(&mut walking, from + 2 * full_steps);
        assert!(!after.has_fallen(), "{turn} rad: fell");
        let turned = heading(&after) - heading(&before);
        let wanted = turn * full_steps as f64;
        let off = (turned - wanted + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        assert!(off.abs() < 0.1, "{turn} rad: turned by {turned} instead of {wanted} rad");
        let moved = (after.com - before.com).xy().norm();
        assert!(moved < 0.2, "{turn} rad: got {moved} m away");
    }
}
