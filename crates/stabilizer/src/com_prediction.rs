//! Prediction of the centre of mass over ticks without a good measurement.

use model::ComState;
use nalgebra::Vector3;

/// Longest time without a good measurement that is bridged (s).
const BRIDGED_MAX: f64 = 0.02;
/// Least age of the estimate that a prediction begins from (s). A fault is noticed a few samples late, and the samples
/// before that were already wrong.
const TRUSTED_AGE: f64 = 0.005;

/// Predicts the centre of mass from the deviation that it had from the plan: over milliseconds the robot moves on as
/// planned, and keeps what it is off by.
#[derive(Clone, Copy, Debug, Default)]
pub struct ComPrediction {
    /// At least [`TRUSTED_AGE`] older than the last estimate, once there is such a one.
    trusted: Option<Deviation>,
    /// Becomes the trusted one when it is old enough.
    candidate: Option<Deviation>,
    /// Time since the last estimate (s).
    unmeasured_for: f64,
}

/// The deviation of the centre of mass from the plan.
#[derive(Clone, Copy, Debug)]
struct Deviation {
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    /// Time since it was estimated (s).
    age: f64,
}

impl ComPrediction {
    /// Absorbs an estimate.
    ///
    /// * `planned` – the centre of mass at the same time, as planned
    /// * `dt` – time since the last call (s)
    pub fn absorb(&mut self, estimated: &ComState, planned: &ComState, dt: f64) {
        self.age(dt);
        self.unmeasured_for = 0.0;
        if self.candidate.is_none_or(|candidate| candidate.age >= TRUSTED_AGE) {
            let deviation = Deviation {
                position: estimated.position - planned.position,
                velocity: estimated.velocity - planned.velocity,
                age: 0.0,
            };
            self.trusted = self.candidate.or(Some(deviation));
            self.candidate = Some(deviation);
        }
    }

    /// The centre of mass now; `None` when the last estimate is too old, or there is none.
    ///
    /// * `planned` – the centre of mass now, as planned
    /// * `dt` – time since the last call (s)
    pub fn predict(&mut self, planned: &ComState, dt: f64) -> Option<ComState> {
        self.age(dt);
        let Deviation { position, velocity, age } = self.trusted?;
        (self.unmeasured_for < BRIDGED_MAX).then(|| ComState {
            position: planned.position + position + velocity * age,
            velocity: planned.velocity + velocity,
        })
    }

    fn age(&mut self, dt: f64) {
        self.unmeasured_for += dt;
        for deviation in [&mut self.trusted, &mut self.candidate].into_iter().flatten() {
            deviation.age += dt;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(x: f64, velocity: f64) -> ComState {
        ComState { position: Vector3::new(x, 0.0, 0.9), velocity: Vector3::new(velocity, 0.0, 0.0) }
    }

    /// A plan that accelerates, and a robot 20 mm ahead of it that drifts by 0.1 m/s.
    fn plan_and_robot(time: f64) -> (ComState, ComState) {
        let planned = state(time * time, 2.0 * time);
        (planned, state(planned.position.x + 0.02 + 0.1 * time, planned.velocity.x + 0.1))
    }

    #[test]
    fn a_prediction_follows_an_accelerated_plan_with_the_deviation_that_was_there_for_20_ms() {
        let mut prediction = ComPrediction::default();
        for tick in 0..100 {
            let (planned, robot) = plan_and_robot(f64::from(tick) * 1e-3);
            prediction.absorb(&robot, &planned, 1e-3);
        }
        for tick in 100..119 {
            let (planned, robot) = plan_and_robot(f64::from(tick) * 1e-3);
            let predicted = prediction.predict(&planned, 1e-3).unwrap();
            assert!((predicted.position - robot.position).norm() < 1e-12, "tick {tick}");
            assert!((predicted.velocity - robot.velocity).norm() < 1e-12, "tick {tick}");
        }
        let (planned, _) = plan_and_robot(0.119);
        assert!(prediction.predict(&planned, 1e-3).is_none());
    }

    #[test]
    fn samples_that_were_wrong_before_the_fault_was_noticed_are_not_predicted_from() {
        for good in 20..40 {
            let mut prediction = ComPrediction::default();
            for _ in 0..good {
                prediction.absorb(&state(0.02, 0.0), &state(0.0, 0.0), 1e-3);
            }
            for _ in 0..4 {
                prediction.absorb(&state(0.02, 2.0), &state(0.0, 0.0), 1e-3);
            }
            let predicted = prediction.predict(&state(0.0, 0.0), 1e-3).unwrap();
            assert_eq!(predicted.velocity.x, 0.0, "after {good} good samples");
        }
    }

    #[test]
    fn without_any_estimate_there_is_no_prediction() {
        assert!(ComPrediction::default().predict(&state(0.0, 0.0), 1e-3).is_none());
    }
}
