//! Pace: a speed that is asked for is played from that very tick on, before the plan for it is made.
//!
//! The same motion, played a little faster or slower (DESIGN §4.2): by no more than the ramp of the speed has come until the
//! plan takes over, a ten-thousandth, so that balance does not notice. The plan takes its ramp from the pace, so that the change
//! of speed begins when it was asked for, however long the plan took.

use gait::Speed;

/// How long the plan may take [knots]. Then it begins its own ramp.
const KNOTS_UNTIL_PLANNED: u32 = 5;
/// Until the newest knot of a plan is played.
const KNOTS_UNTIL_PLAYED: u32 = 3;
/// How much faster or slower than planned anything is played at most.
const CHANGE_MAX: f64 = 0.01;

/// A speed on its way from what is planned to what is asked.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    speed: Speed,
    knots_left: u32,
}

impl Pace {
    /// Heads for a speed from what it is now; there is no plan for it yet.
    pub fn new(now: Speed, target: f64) -> Self {
        Self { speed: heading_for(now, target), knots_left: KNOTS_UNTIL_PLANNED }
    }

    /// The same once there is a plan.
    pub fn planned(now: Speed, target: f64) -> Self {
        Self { speed: heading_for(now, target), knots_left: KNOTS_UNTIL_PLAYED }
    }

    /// The speed of now.
    pub fn speed(&self) -> Speed {
        self.speed
    }

    /// Moves on by `dt` [s] and says how much faster than planned that is to be played.
    ///
    /// * `planned` – the speed that is planned for the middle of it
    pub fn advance(&mut self, dt: f64, planned: f64) -> f64 {
        let rate = self.speed.advance(dt) / (planned * dt);
        // In a stand, or after no time, there is no rate.
        if rate.is_finite() { rate.clamp(1.0 - CHANGE_MAX, 1.0 + CHANGE_MAX) } else { 1.0 }
    }

    /// What is left of it when a knot has passed.
    pub fn after_knot(self) -> Option<Self> {
        let knots_left = self.knots_left.checked_sub(1)?;
        Some(Self { knots_left, ..self })
    }
}

fn heading_for(mut speed: Speed, target: f64) -> Speed {
    speed.request(target);
    speed
}
