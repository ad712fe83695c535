//! Speed override: a commanded speed takes effect from the very next tick, before it is planned.
//!
//! The planned motion is played a little faster or slower. Until the new plan takes over, the ramp of the speed has
//! come only a ten-thousandth of the way, so that balance does not notice. The new plan starts its ramp from the
//! override: the change of speed begins when it is commanded, however long planning takes.

use gait::Speed;

/// How long a plan may take (knots). If it takes longer, it begins its own ramp.
const KNOTS_UNTIL_PLANNED: u32 = 5;
/// Until the newest knot of a plan is played (knots).
const KNOTS_UNTIL_PLAYED: u32 = 3;
/// Largest deviation from the planned rate of playback (-).
const RATE_DEVIATION_MAX: f64 = 0.01;

/// A speed on its way from the planned one to the commanded one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpeedOverride {
    speed: Speed,
    knots_left: u32,
}

impl SpeedOverride {
    /// Begins an override that is not planned yet.
    ///
    /// * `now` – the present speed
    /// * `target` – the commanded speed factor
    pub(crate) fn begin(now: Speed, target: f64) -> Self {
        Self { speed: towards(now, target), knots_left: KNOTS_UNTIL_PLANNED }
    }

    /// The same override once it is planned: it ends when the first knot of that plan is played.
    pub(crate) fn planned(self, target: f64) -> Self {
        Self { speed: towards(self.speed, target), knots_left: KNOTS_UNTIL_PLAYED }
    }

    /// The present speed.
    pub(crate) fn speed(&self) -> Speed {
        self.speed
    }

    /// Advances by `dt` (s). Returns the rate of playback: 1 is as planned.
    ///
    /// * `planned` – planned speed factor in the middle of `dt`
    pub(crate) fn advance(&mut self, dt: f64, planned: f64) -> f64 {
        let rate = self.speed.advance(dt) / (planned * dt);
        // In a stand, or after no time, there is no rate.
        let bounded = rate.clamp(1.0 - RATE_DEVIATION_MAX, 1.0 + RATE_DEVIATION_MAX);
        if rate.is_finite() { bounded } else { 1.0 }
    }

    /// The rest of the override after a knot has passed, if any.
    pub(crate) fn after_knot(self) -> Option<Self> {
        let knots_left = self.knots_left.checked_sub(1)?;
        Some(Self { knots_left, ..self })
    }
}

fn towards(mut speed: Speed, target: f64) -> Speed {
    speed.request(target);
    speed
}

#[cfg(test)]
mod tests {
    use gait::RampKind;

    use super::*;

    #[test]
    fn speed_override_plays_at_the_ratio_of_ramp_and_plan() {
        let mut speed = Speed::new(1.0, RampKind::Quintic, 0.6);
        let mut over = SpeedOverride::begin(speed, 1.4);
        speed.request(1.4);
        for _ in 0..20 {
            let rate = over.advance(1e-3, 1.0);
            assert!((rate - speed.advance(1e-3) / 1e-3).abs() < 1e-12 && rate < 1.0 + RATE_DEVIATION_MAX);
        }
        assert_eq!(over.advance(1e-3, 0.0), 1.0, "in a stand");
    }

    #[test]
    fn speed_override_ends_when_no_plan_comes() {
        let mut over = Some(SpeedOverride::begin(Speed::new(1.0, RampKind::Quintic, 0.6), 1.4));
        for _ in 0..=KNOTS_UNTIL_PLANNED {
            assert!(over.is_some());
            over = over.and_then(SpeedOverride::after_knot);
        }
        assert!(over.is_none());
    }
}
