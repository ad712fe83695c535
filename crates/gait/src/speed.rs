//! Speed (DESIGN §4.2, eq. 4): the same half-step, played faster or slower.
//!
//! The speed factor `c` is the rate of nominal time: `τ̇ = c`. A change of `c` is a ramp in time, not in progress, and
//! while it lasts the term `ċ·q′` belongs to the accelerations.

use model::Motion;

use crate::{Ramp, RampKind, RampState};

/// A motion at nominal speed, played at the speed factor `c` that changes at `ċ` (1/s): `q̇ = c·q′`,
/// `q̈ = c²·q″ + ċ·q′`.
pub fn at_speed(nominal: &Motion, speed: f64, speed_rate: f64) -> Motion {
    Motion {
        angles: nominal.angles,
        rates: nominal.rates * speed,
        accelerations: nominal.accelerations * (speed * speed) + nominal.rates * speed_rate,
    }
}

/// The speed factor, on its ramp to the commanded one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Shape of the ramps.
    kind: RampKind,
    /// Duration of a change (s).
    duration: f64,
    /// The commanded speed factor, at which the change ends.
    target: f64,
    /// The change in progress.
    change: Option<SpeedChange>,
}

/// A change of speed in progress.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SpeedChange {
    ramp: Ramp,
    /// How long the change takes (s).
    duration: f64,
    /// Time since the change began, less than its duration (s).
    elapsed: f64,
}

impl Speed {
    /// A constant `speed`, whose changes take `duration` (s).
    pub const fn new(speed: f64, kind: RampKind, duration: f64) -> Self {
        Self { kind, duration, target: speed, change: None }
    }

    /// The commanded speed factor.
    pub fn target(&self) -> f64 {
        self.target
    }

    /// The present speed factor `c`, with `ċ` (1/s) and `c̈` (1/s²).
    pub fn state(&self) -> RampState {
        match self.change {
            Some(change) => change.ramp.at(change.elapsed / change.duration).by(change.duration.recip()),
            None => RampState::at_rest(self.target),
        }
    }

    /// Begins a change to `target` from the present speed, rate and acceleration. Commanding the same again changes
    /// nothing, so that a stream of equal commands does not postpone the end.
    pub fn request(&mut self, target: f64) {
        if target != self.target {
            self.request_within(target, self.duration);
        }
    }

    /// Begins a change to `target` that takes another time than usual (s).
    pub fn request_within(&mut self, target: f64, duration: f64) {
        let ramp = Ramp::new(self.kind, self.state().by(duration), target);
        self.target = target;
        self.change = (duration > 0.0).then_some(SpeedChange { ramp, duration, elapsed: 0.0 });
    }

    /// Changes the speed so that a nominal time passes within another one, from the present speed on. It changes over
    /// `ramp` (s) and stays.
    ///
    /// * `nominal` – nominal time that is to pass (s)
    /// * `within` – how long that is to take, more than half of `ramp` (s)
    pub fn cover(&mut self, nominal: f64, within: f64, ramp: f64) {
        let RampState { value, rate, acceleration } = self.state().by(ramp);
        // The integral of a ramp from this state to rest at c is (value + c)/2 + rate/10 + acceleration/120.
        let on_the_way = match self.kind {
            RampKind::Linear => value / 2.0,
            RampKind::Quintic => value / 2.0 + rate / 10.0 + acceleration / 120.0,
        };
        self.request_within((nominal - ramp * on_the_way) / (within - ramp / 2.0), ramp);
    }

    /// The speed as it was some time ago (s), back to the beginning of the change in progress.
    pub fn rewound(&self, by: f64) -> Self {
        let change = self.change.map(|change| SpeedChange { elapsed: (change.elapsed - by).max(0.0), ..change });
        Self { change, ..*self }
    }

    /// Advances by `dt` (s) and returns the nominal time that passes, `∫c dt` (s), exactly.
    pub fn advance(&mut self, dt: f64) -> f64 {
        let Some(change) = &mut self.change else {
            return self.target * dt;
        };
        let duration = change.duration;
        let in_ramp = dt.min(duration - change.elapsed);
        let before = change.ramp.integral(change.elapsed / duration);
        change.elapsed += in_ramp;
        let after = change.ramp.integral(change.elapsed / duration);
        if change.elapsed >= duration {
            self.change = None;
        }
        duration * (after - before) + self.target * (dt - in_ramp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nominal_time_is_the_integral_of_the_speed_factor() {
        for kind in [RampKind::Linear, RampKind::Quintic] {
            let mut speed = Speed::new(1.0, kind, 0.6);
            speed.request(1.4);
            let passed: f64 = (0..1000).map(|_| speed.advance(0.001)).sum();
            // Both ramps are symmetric about their middle: 0.6 s at 1.2 on average, then 0.4 s at 1.4.
            assert!((passed - (0.6 * 1.2 + 0.4 * 1.4)).abs() < 1e-12, "{kind:?}: {passed}");
            assert_eq!(speed.state(), RampState::at_rest(1.4));
        }
    }

    #[test]
    fn a_new_target_during_a_change_of_speed_keeps_speed_and_its_derivatives() {
        let mut speed = Speed::new(1.0, RampKind::Quintic, 0.6);
        speed.request(1.4);
        speed.advance(0.25);
        let before = speed.state();
        speed.request(0.7);
        let after = speed.state();
        assert!((after.value - before.value).abs() < 1e-15);
        assert!((after.rate - before.rate).abs() < 1e-14);
        assert!((after.acceleration - before.acceleration).abs() < 1e-13);
    }

    #[test]
    fn a_nominal_time_is_covered_within_the_time_asked_for() {
        for kind in [RampKind::Linear, RampKind::Quintic] {
            for (nominal, within) in [(0.4, 0.25), (0.4, 0.4), (0.2, 0.3), (0.1, 0.06)] {
                let mut speed = Speed::new(1.0, kind, 0.6);
                // From the middle of another change.
                speed.request(1.4);
                speed.advance(0.2);
                speed.cover(nominal, within, 0.06);
                let passed: f64 = (0..1000).map(|_| speed.advance(within / 1000.0)).sum();
                assert!((passed - nominal).abs() < 1e-12, "{kind:?}: {passed} instead of {nominal} in {within} s");
            }
        }
    }

    #[test]
    fn a_rewound_speed_is_the_earlier_speed() {
        let mut speed = Speed::new(1.0, RampKind::Quintic, 0.6);
        speed.request(1.4);
        speed.advance(0.25);
        let mut later = speed;
        later.advance(0.1);
        assert!((later.rewound(0.1).state().value - speed.state().value).abs() < 1e-15);
        assert_eq!(later.rewound(1.0).state().value, 1.0);
    }

    #[test]
    fn repeating_a_commanded_speed_does_not_postpone_the_end_of_its_ramp() {
        for kind in [RampKind::Linear, RampKind::Quintic] {
            let mut speed = Speed::new(1.0, kind, 0.6);
            for _ in 0..7 {
                speed.request(1.3);
                speed.advance(0.1);
            }
            assert_eq!(speed.state(), RampState::at_rest(1.3));
        }
    }

    /// Even if commands alternate between the limits at the worst moments, `c` stays positive.
    #[test]
    fn alternating_commands_of_speed_never_reverse_the_walk() {
        let mut least = f64::INFINITY;
        for period in 10..80 {
            let mut speed = Speed::new(1.0, RampKind::Quintic, 0.6);
            for tick in 0..4000 {
                speed.request(if tick / period % 2 == 0 { 1.4 } else { 0.6 });
                speed.advance(0.01);
                least = least.min(speed.state().value);
            }
        }
        assert!(least > 0.5, "{least}");
    }
}
