//! What the coming knots want of the ZMP: the course played ahead of itself.

use nalgebra::Vector2;

use crate::preview::biped::KNOTS_AHEAD;
use crate::preview::{Biped, CartTable, Course};

/// Where the pendulum's ZMP is wanted in the coming knots: under the foot that will bear, less what the pendulum leaves out.
/// Played anew when a request changes what is to come; else one knot is added as one is used.
#[derive(Clone, Debug)]
pub struct Outlook {
    /// In the walk frame [m]; the oldest at `next`.
    wanted: [Vector2<f64>; KNOTS_AHEAD],
    next: usize,
    /// The course at the last of them.
    scout: Course,
}

impl Outlook {
    /// Looks ahead of a course.
    pub fn new(biped: &Biped, course: &Course) -> Self {
        let mut outlook = Self { wanted: [Vector2::zeros(); KNOTS_AHEAD], next: 0, scout: course.clone() };
        outlook.begin(biped, course);
        outlook
    }

    /// Looks ahead anew from where the walk is.
    pub fn begin(&mut self, biped: &Biped, course: &Course) {
        self.scout.clone_from(course);
        for _ in 0..self.wanted.len() {
            self.advance(biped);
        }
    }

    /// One knot is past: one more comes into sight.
    pub fn advance(&mut self, biped: &Biped) {
        self.scout.advance(biped);
        let Course { gate, feet, .. } = &self.scout;
        let foot = feet.standing.position.xy() * (1.0 - gate.weight_on_bearing());
        self.wanted[self.next] = feet.footprint.point_to_walk(foot - self.scout.beyond_pendulum(biped));
        self.next = (self.next + 1) % self.wanted.len();
    }

    /// The sum of what is wanted, each knot times its gain, along both axes of the walk frame.
    pub fn weighed(&self, cart: &CartTable) -> Vector2<f64> {
        cart.weigh(&self.wanted, self.next)
    }
}
