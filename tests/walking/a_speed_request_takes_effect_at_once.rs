//! A request for another speed changes the setpoint of its own tick, at whatever instant it comes and however long the
//! plan for it takes, and the speed's ramp begins with it.
//!
//! Method: two equal walks, one of them asked. Its plan is held back for some ticks, as another thread would.

use controller::Tick;
use gait::Speed;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters};
use interface::{GaitChange, Request, Source};

const SPEED_BEFORE: f64 = 1.0;
/// Of what is measured at the end of a ramp, and for a second after it (ticks).
const WATCHED: usize = 2200;

/// Asks, and walks on for some ticks; what was asked is settled after `held_back` of them.
fn asked(mut walking: Walking, request: GaitChange, held_back: usize, ticks: usize) -> Vec<Tick> {
    walking.driver.controller.submit(&Request { gait: request, ..Request::new(Source::Console) });
    let mut job = walking.driver.controller.take_job();
    let tick = |tick| {
        if tick == held_back
            && let Some(mut job) = job.take()
        {
            job.evaluate();
            walking.driver.controller.complete(job);
        }
        walking.tick(None)
    };
    (0..ticks).map(tick).collect()
}

fn walked_for(ticks: usize) -> Walking {
    let mut walking = Walking::begin(1);
    for _ in 0..ticks {
        walking.tick(None);
    }
    walking
}

fn speed(speed: f64) -> GaitChange {
    GaitChange { speed: Some(speed), ..GaitChange::default() }
}

#[test]
fn a_speed_request_changes_the_setpoint_of_its_own_tick_without_a_jump() {
    for begin in (2000..2010).chain((2100..2700).step_by(97)) {
        let walking = walked_for(begin);
        let unasked = walking.clone().tick(None);
        for (target, held_back) in [(1.1, 0), (0.9, 3), (1.3, 17), (0.7, 38)] {
            let [first] = asked(walking.clone(), speed(target), held_back, 1)[..] else { unreachable!("one tick") };
            let rates = first.setpoint.rates - unasked.setpoint.rates;
            assert!(rates.max_abs() > 0.0, "asked for {target} in tick {begin}, nothing changed");
            assert!(rates.max_abs() < 1e-6, "asked for {target} in tick {begin}, a jump: {rates:?}");
            assert_eq!(
                first.report.speed > unasked.report.speed,
                target > unasked.report.speed,
                "asked for {target} in tick {begin}"
            );
        }
    }
}

#[test]
fn the_speed_ramp_begins_in_the_tick_of_its_request() {
    let gait = controller_parameters().gait;
    for (target, held_back) in [(1.3, 0), (0.8, 4), (1.2, 26)] {
        let mut ramp = Speed::new(SPEED_BEFORE, gait.ramp, gait.speed_ramp.as_secs_f64());
        ramp.request(target);
        let reports = asked(walked_for(2003), speed(target), held_back, WATCHED);
        assert!(reports.iter().any(|report| report.reply.is_some()), "nobody answered");
        for (tick, report) in reports.iter().enumerate() {
            ramp.advance(PERIOD);
            let off = (report.report.speed - ramp.state().value).abs();
            assert!(off < 1e-3, "{tick} ticks after {target} was asked for the speed is off its ramp by {off}");
        }
        let jump =
            reports.windows(2).map(|pair| (pair[1].report.speed - pair[0].report.speed).abs()).fold(0.0, f64::max);
        let steepest = 1.875 * (target - SPEED_BEFORE).abs() / gait.speed_ramp.as_secs_f64() * PERIOD;
        assert!(jump < 1.01 * steepest, "the speed jumps by {jump} in a tick, its ramp by {steepest}");
    }
}

#[test]
fn requesting_the_speed_in_force_changes_nothing() {
    let walking = walked_for(2003);
    let mut unasked = walking.clone();
    for (tick, report) in asked(walking, speed(SPEED_BEFORE), 4, WATCHED).iter().enumerate() {
        assert_eq!(report.setpoint, unasked.tick(None).setpoint, "{tick} ticks later");
    }
}
