//! The floor that is laid out for an engine: bodies around the robot, which follow it.

use interchange::FloorPrism;
use nalgebra::Vector2;
use plant::{Ground, Plant};
use serde::Serialize;

/// Half the edge of the square that is laid out (m): feet reach far less from their middle.
const HALF_EDGE: f64 = 1.2;
/// The floor is laid out anew when the robot is further than this from its middle, along x or y (m).
const FOLLOWS_AFTER: f64 = 0.3;
/// Least edge of tiles and cells (m): smaller ones are too many.
pub(super) const EDGE_MIN: f64 = 0.05;

/// The part of the floor that an engine has.
#[derive(Clone, Debug)]
pub(super) struct LaidFloor {
    ground: Ground,
    middle: Vector2<f64>,
}

/// A body of the floor in messages to an engine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct FloorBody {
    at: [f64; 3],
    vertices: Vec<[f64; 3]>,
    friction: f64,
}

impl LaidFloor {
    /// The floor around a place; `None` for a plane, which needs no bodies.
    pub(super) fn around(ground: Ground, middle: Vector2<f64>) -> Option<Self> {
        (!ground.is_plane()).then_some(Self { ground, middle })
    }

    /// The bodies.
    pub(super) fn bodies(&self) -> Vec<FloorBody> {
        let pieces = self.ground.pieces(self.middle, HALF_EDGE);
        let body = |prism: FloorPrism| FloorBody {
            at: prism.at.into(),
            vertices: prism.vertices.into_iter().map(Into::into).collect(),
            friction: prism.friction,
        };
        pieces.iter().map(FloorPrism::of).map(body).collect()
    }

    /// Follows the robot: the new bodies, if it has left the middle of those that are there.
    pub(super) fn follow(&mut self, plant: &Plant) -> Option<Vec<FloorBody>> {
        let [right, left] = plant.truth().soles.map(|sole| sole.translation.vector.xy());
        let middle = (right + left) / 2.0;
        if (middle - self.middle).amax() <= FOLLOWS_AFTER {
            return None;
        }
        self.middle = middle;
        Some(self.bodies())
    }
}
