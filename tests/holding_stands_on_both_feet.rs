//! Asked to stop or hold at any moment of a gentle walk, the robot finishes the half-step and stands still on both feet.

use controller::{Intent, Mode, Refusal};
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
        assert_eq!(answer.admission.effect_half_step, report.half_step.index + 1);

        let braked = walking.walk(4.0);
        let still = walking.walk(6.0);
        assert!(!still.has_fallen(), "seed {seed}: fell");
        let moved = (still.com - braked.com).norm();
        assert!(moved < 2e-3, "seed {seed}: moved by {moved} m while standing");
        let heights = still.soles.map(|sole| sole.translation.z.abs());
        assert!(heights.iter().all(|height| *height < 2e-3), "seed {seed}: soles are {heights:?} m off the ground");

        // There is no walk to change any more, and none begins from a stand.
        let report = walking.tick(Some((&request, Some(Intent::Walk))));
        assert_eq!(report.mode, Mode::Holding);
        assert_eq!(report.answer.expect("answered").refusal, Some(Refusal::Standing));
    }
}
