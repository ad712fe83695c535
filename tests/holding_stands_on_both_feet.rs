//! Asked to stop or hold at any moment of a gentle walk, the robot finishes the half-step, stands still on both feet, and
//! walks on when asked to.

use controller::{Intent, Mode};
use gait::{Request, Verdict};
use halfstep_tests::random;
use halfstep_tests::walking::Walking;
use rand::Rng;

#[test]
fn from_any_moment_of_the_walk() {
    for seed in 0..12 {
        let mut random = random(seed);
        let mut any = |size: f64| random.random_range(-size..size);
        let request = Request {
            turn: Some(any(5.0).to_radians()),
            speed: Some(1.0 + any(0.05)),
            extension: Some(any(3.0).to_radians()),
        };
        let mut walking = Walking::begin(seed);
        walking.tick(Some((&request, None)));
        walking.walk(4.0 + random.random_range(0.0..1.2));

        let report = walking.tick(Some((&Request::default(), Some(Intent::Stop))));
        let answer = report.answer.expect("a request is answered");
        assert_eq!((answer.admission.verdict, answer.intent), (Verdict::Accepted, Intent::Stop));
        let stands_at = answer.admission.effect_half_step;
        let half_steps = stands_at - report.half_step.index;
        assert!((1..=2).contains(&half_steps), "seed {seed}: stands only after {half_steps} half-steps");

        let braked = walking.walk(7.0);
        let still = walking.walk(5.0);
        let report = walking.tick(None);
        assert_eq!((report.mode, report.half_step.index), (Mode::Holding, stands_at), "seed {seed}");
        assert!(!still.has_fallen(), "seed {seed}: fell");
        let moved = (still.com - braked.com).norm();
        assert!(moved < 2e-3, "seed {seed}: moved by {moved} m while standing");
        let heights = still.soles.map(|sole| sole.translation.z.abs());
        assert!(heights.iter().all(|height| *height < 2e-3), "seed {seed}: soles are {heights:?} m off the ground");

        // And it walks on.
        let report = walking.tick(Some((&Request::default(), Some(Intent::Walk))));
        assert_eq!(report.answer.expect("answered").admission.verdict, Verdict::Accepted);
        let half_steps = report.half_step.index;
        let walked = walking.walk(8.0);
        let report = walking.tick(None);
        assert!(!walked.has_fallen() && report.mode == Mode::Walking, "seed {seed}: fell after the start");
        assert!(report.half_step.index >= half_steps + 9, "seed {seed}: only at {}", report.half_step.index);
    }
}
