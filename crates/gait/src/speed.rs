//! Speed (DESIGN §4.2, eq. 4): the same half-step, played faster or slower.
//!
//! The speed factor `c` is the rate of nominal time: `τ̇ = c`. A change of `c` is a ramp in time, not in progress, and
//! while it lasts the term `ċ·q′` belongs to the accelerations.

use model::Motion;

use crate::{Ramp, RampKind, RampState};

/// A motion at nominal speed, played at speed `c` that changes at `ċ` [1/s]: `q̇ = c·q′`, `q̈ = c²·q″ + ċ·q′`.
pub fn at_speed(nominal: &Motion, speed: f64, speed_rate: f64) -> Motion {
    Motion {
        angles: nominal.angles,
        rates: nominal.rates * speed,
        accelerations: nominal.accelerations * (speed * speed) + nominal.rates * speed_rate,
    }
}

/// The speed factor now and on its way to the one in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    kind: RampKind,
    /// How long a change takes [s].
    duration: f64,
    /// The speed in force, where the change ends.
    target: f64,
    change: Option<Change>,
}

/// A change of speed that is not over yet.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Change {
    ramp: Ramp,
    /// Since it began, less than its duration [s].
    elapsed: f64,
}

impl Speed {
    /// A constant `speed`, with changes that take `duration` [s].
    pub const fn new(speed: f64, kind: RampKind, duration: f64) -> Self {
        Self { kind, duration, target: speed, change: None }
    }

    /// The speed that was asked for.
    pub fn target(&self) -> f64 {
        self.target
    }

    /// `c` now, with `ċ` [1/s] and `c̈` [1/s²].
    pub fn state(&self) -> RampState {
        match self.change {
            Some(change) => change.ramp.at(change.elapsed / self.duration).by(self.duration.recip()),
            None => RampState::at_rest(self.target),
        }
    }

    /// Heads for `target` from the speed, rate and acceleration there are. Asking again for the same changes nothing, so
    /// that a stream of equal requests does not put the end off.
    pub fn request(&mut self, target: f64) {
        if target == self.target {
            return;
        }
        let ramp = Ramp::new(self.kind, self.state().by(self.duration), target);
        self.target = target;
        self.change = (self.duration > 0.0).then_some(Change { ramp, elapsed: 0.0 });
    }

    /// As it was some time ago [s], as far as the change that is under way reaches back.
    pub fn rewound(&self, by: f64) -> Self {
        let change = self.change.map(|change| Change { elapsed: (change.elapsed - by).max(0.0), ..change });
        Self { change, ..*self }
    }

    /// Moves on by `dt` [s] and returns the nominal time that passes meanwhile, `∫c dt` [s], exactly.
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
    fn nominal_time_is_the_integral_of_the_speed() {
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
    fn a_change_of_mind_keeps_speed_and_its_derivatives() {
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
    fn it_was_what_it_was() {
        let mut speed = Speed::new(1.0, RampKind::Quintic, 0.6);
        speed.request(1.4);
        speed.advance(0.25);
        let mut later = speed;
        later.advance(0.1);
        assert!((later.rewound(0.1).state().value - speed.state().value).abs() < 1e-15);
        assert_eq!(later.rewound(1.0).state().value, 1.0);
    }

    #[test]
    fn repeating_a_request_does_not_put_its_end_off() {
        for kind in [RampKind::Linear, RampKind::Quintic] {
            let mut speed = Speed::new(1.0, kind, 0.6);
            for _ in 0..7 {
                speed.request(1.3);
                speed.advance(0.1);
            }
            assert_eq!(speed.state(), RampState::at_rest(1.3));
        }
    }

    /// The worst that requests can do is to change their mind at the worst moments: even then `c` stays positive.
    #[test]
    fn hectic_requests_never_walk_backwards() {
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
