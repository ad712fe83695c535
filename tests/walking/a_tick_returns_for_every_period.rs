//! A tick returns a finite setpoint for every length of a period, and none leaves the controller in a state that it
//! cannot leave again.

use halfstep_tests::walking::Walking;
use interface::Mode;

#[test]
fn no_period_panics_or_spoils_the_walk() {
    for dt in [0.0, -0.0, -1e-3, -1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e-300, 1e-9, 0.1, 3.0, 1e300] {
        let mut walking = Walking::begin(11);
        walking.walk(2.0);
        // Thrice, also across a support change.
        for at in [1000, 1130, 1290] {
            let measurement = walking.measurement;
            let tick = walking.driver.controller.tick(dt, Some(&measurement));
            assert!(tick.setpoint.angles.is_finite() && tick.setpoint.rates.is_finite(), "{dt} at {at}");
            assert!(tick.setpoint.feed_forward.is_finite(), "{dt} at {at}");
            walking.walk(0.13);
        }
        let is_short = dt.is_nan() || dt <= 1e-3;
        if is_short {
            walking.walk(5.0);
            assert_eq!(walking.controller().mode(), Mode::Walking, "{dt}: a period of no length changes nothing");
        }
    }
}
