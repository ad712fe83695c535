//! The robot walks a minute without falling, whatever the sensors' noise: at nominal, with every corner of the gentle
//! box of commands held for long, with random commands from that box streamed in, and with random commands from all
//! that the committed limits grant.

use halfstep_tests::random;
use halfstep_tests::walking::{Walking, controller_parameters};
use interface::{GaitChange, Intent, Mode};
use rand::Rng;

const SECONDS: f64 = 60.0;
const SEEDS: std::ops::Range<u64> = 0..10;

/// The gentle box: c 0.95 to 1.05, α within 5°, β within 3°.
fn gentle(turn: f64, speed: f64, extension: f64) -> GaitChange {
    GaitChange {
        turn: Some((5.0 * turn).to_radians()),
        speed: Some(1.0 + 0.05 * speed),
        extension: Some((3.0 * extension).to_radians()),
        ..GaitChange::NONE
    }
}

/// Walks a minute, asking `request` whenever it has something new to ask.
fn assert_walks(seed: u64, what: &str, mut request: impl FnMut(f64) -> Option<GaitChange>) {
    let mut walking = Walking::begin(seed);
    let mut half_steps = 0;
    while walking.time() < SECONDS {
        let asked = request(walking.time());
        let report = walking.tick(asked.as_ref().map(|request| (request, Some(Intent::Walk))));
        half_steps = report.report.half_step.index;
        let truth = walking.plant.truth();
        assert!(
            !truth.has_fallen() && report.report.mode == Mode::Walking,
            "{what}, seed {seed}: fell at {:.2} s in half-step {half_steps}, {:?} with {:?}",
            walking.time(),
            report.report.mode,
            report.command,
        );
    }
    assert!(half_steps >= 50, "{what}, seed {seed}: only {half_steps} half-steps");
}

/// On both cores.
fn for_each_seed(check: impl Fn(u64) + Sync) {
    let next = std::sync::atomic::AtomicU64::new(SEEDS.start);
    let worker = || {
        loop {
            let seed = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            if seed >= SEEDS.end {
                break;
            }
            check(seed);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(worker);
        worker();
    });
}

#[test]
fn walks_a_minute_at_nominal() {
    for_each_seed(|seed| assert_walks(seed, "nominal", |_| None));
}

#[test]
fn walks_a_minute_at_every_corner_of_the_gentle_box() {
    let corners = [-1.0, 1.0];
    for_each_seed(|seed| {
        let bit = |index: u64| corners[(seed >> index & 1) as usize];
        let corner = gentle(bit(0), bit(1), bit(2));
        assert_walks(seed, "a corner", |time| (time == 1.0).then_some(corner));
    });
}

#[test]
fn walks_a_minute_with_random_gentle_commands() {
    for_each_seed(|seed| {
        let mut random = random(100 + seed);
        let mut next = 0.0;
        assert_walks(seed, "a stream", |time| {
            (time >= next).then(|| {
                next = time + random.random_range(0.3..3.0);
                let mut any = || random.random_range(-1.0..=1.0);
                gentle(any(), any(), any())
            })
        });
    });
}

#[test]
fn walks_a_minute_with_random_commands_from_all_that_is_granted() {
    let limits = controller_parameters().gait.limits;
    for_each_seed(|seed| {
        let mut random = random(200 + seed);
        let mut next = 0.0;
        assert_walks(seed, "a wild stream", |time| {
            (time >= next).then(|| {
                next = time + random.random_range(1.2..3.6);
                GaitChange {
                    turn: Some(random.random_range(-limits.turn_max..=limits.turn_max)),
                    speed: Some(random.random_range(limits.speed_min..=limits.speed_max)),
                    extension: Some(random.random_range(limits.extension_min..=limits.extension_max)),
                    sidestep: Some(random.random_range(-limits.sidestep_max..=limits.sidestep_max)),
                }
            })
        });
    });
}
