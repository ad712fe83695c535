//! The state of the centre of mass, and of the inverted pendulum that stands for it.

use nalgebra::{Vector2, Vector3};

use crate::GRAVITY;

/// Least height that counts as a pendulum's (m): a robot on the floor has no divergent component.
const HEIGHT_MIN: f64 = 0.1;

/// Position and velocity of the centre of mass, in level axes whose origin is on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComState {
    /// Position (m).
    pub position: Vector3<f64>,
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
}

impl ComState {
    /// `ω = √(g/z)` of the inverted pendulum of this height (rad/s).
    pub fn pendulum_rate(&self) -> f64 {
        (GRAVITY / self.position.z.max(HEIGHT_MIN)).sqrt()
    }

    /// The divergent component of motion `c + ċ/ω` (m): the point to step on to come to rest (Takenaka et al. 2009).
    pub fn divergent_component(&self) -> Vector2<f64> {
        self.position.xy() + self.velocity.xy() / self.pendulum_rate()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle: the linear inverted pendulum over a foot on the divergent component, integrated: it comes to rest
    /// there.
    #[test]
    fn pendulum_over_the_divergent_component_comes_to_rest_there() {
        let mut com = ComState { position: Vector3::new(0.02, 0.05, 0.9), velocity: Vector3::new(0.4, -0.2, 0.0) };
        let foot = com.divergent_component();
        let dt = 1e-5;
        for _ in 0..200_000 {
            let acceleration = (com.position.xy() - foot) * com.pendulum_rate().powi(2);
            com.velocity += Vector3::new(acceleration.x, acceleration.y, 0.0) * dt;
            com.position += com.velocity * dt;
        }
        assert!((com.position.xy() - foot).norm() < 1e-2 && com.velocity.norm() < 1e-2, "{com:?} over {foot}");
    }
}
