//! The floor under the robot.

use std::fmt;

use nalgebra::Vector2;

type Height = Box<dyn Fn(Vector2<f64>) -> f64 + Send + Sync>;

/// Heights of the floor over the plane in which the world's x and y axes lie.
#[derive(Default)]
pub struct FloorHeights(Option<Height>);

impl FloorHeights {
    /// A plane.
    pub const PLANE: FloorHeights = FloorHeights(None);

    /// A floor with a height (m) at each place in the world (m).
    pub fn new(height: impl Fn(Vector2<f64>) -> f64 + Send + Sync + 'static) -> Self {
        Self(Some(Box::new(height)))
    }

    /// The height at a place in the world (m).
    pub fn at(&self, place: Vector2<f64>) -> f64 {
        self.0.as_ref().map_or(0.0, |height| height(place))
    }
}

impl fmt::Debug for FloorHeights {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str(if self.0.is_some() { "FloorHeights(shaped)" } else { "FloorHeights(plane)" })
    }
}
