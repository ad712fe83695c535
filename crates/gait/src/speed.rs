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
            Some(change) => change.ramp.at(change.elapsed / self.duration).by(self.duration.recip()),
            None => RampState::at_rest(self.target),
        }
    }

    /// Begins a change to `target` from the present speed, rate and acceleration. Commanding the same again changes
    /// nothing, so that a stream of equal commands does not postpone the end.
    pub fn request(&mut self, target: f64) {
        if target == self.target {
            return;
        }
        let ramp = Ramp::new(self.kind, self.state().by(self.duration), target);
        self.target = target;
        self.change = (self.duration > 0.0).then_some(SpeedChange { ramp, elapsed: 0.0 });
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
        let in_ramp = dt.min(self.duration - change.elapsed);
        let before = change.ramp.integral(change.elapsed / self.duration);
        change.elapsed += in_ramp;
        let after = change.ramp.integral(change.elapsed / self.duration);
        if change.elapsed >= self.duration {
            self.change = None;
        }
        self.duration * (after - before) + self.target * (dt - in_ramp)
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
