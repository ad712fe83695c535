//! What the floor is beyond a plane with level tiles; table `[floor]` of `config/plant.toml`, all of which may be left
//! out.

use config::Table;
use nalgebra::Vector2;

use super::cut::Cut;
use super::{FloorRamp, FloorStep, FrictionPatch, FrictionTiles, HeightField};

/// Steps, ramps, field of heights and friction of the floor. Heights add up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloorShape {
    /// Steps, in any order.
    pub steps: Vec<FloorStep>,
    /// Ramps, in any order.
    pub ramps: Vec<FloorRamp>,
    /// Heights from a file.
    pub height_field: Option<HeightField>,
    /// Tiles of random friction.
    pub friction_tiles: Option<FrictionTiles>,
    /// Places of another friction, in the order of the file.
    pub friction_patches: Vec<FrictionPatch>,
}

impl FloorShape {
    /// Reads the table `[floor]`, if there is one.
    pub(crate) fn read(root: &Table) -> Self {
        if !root.has("floor") {
            return Self::default();
        }
        let floor = root.table("floor");
        Self {
            steps: floor.tables("step").iter().map(FloorStep::read).collect(),
            ramps: floor.tables("ramp").iter().map(FloorRamp::read).collect(),
            height_field: floor.has("height_field").then(|| HeightField::read(&floor.table("height_field"))).flatten(),
            friction_tiles: floor.has("friction_tiles").then(|| FrictionTiles::read(&floor.table("friction_tiles"))),
            friction_patches: floor.tables("friction_patch").iter().map(FrictionPatch::read).collect(),
        }
    }

    /// Whether it adds no height anywhere.
    pub(super) fn is_flat(&self) -> bool {
        self.steps.is_empty() && self.ramps.is_empty() && self.height_field.is_none()
    }

    /// What it adds to the height of the floor at a place (m).
    pub(super) fn height(&self, place: Vector2<f64>) -> f64 {
        let steps: f64 = self.steps.iter().map(|step| step.height(place)).sum();
        let ramps: f64 = self.ramps.iter().map(|ramp| ramp.height(place)).sum();
        steps + ramps + self.height_field.as_ref().map_or(0.0, |field| field.height(place))
    }

    /// Height per distance along x and y at a place (-).
    pub(super) fn slope(&self, place: Vector2<f64>) -> Vector2<f64> {
        let ramps: Vector2<f64> = self.ramps.iter().map(|ramp| ramp.slope(place)).sum();
        self.height_field.as_ref().map_or(ramps, |field| ramps + field.slope(place))
    }

    /// The edges in a square.
    pub(super) fn cuts(&self, centre: Vector2<f64>, half_edge: f64) -> Vec<Cut> {
        let mut cuts: Vec<Cut> = self.steps.iter().flat_map(FloorStep::cuts).collect();
        cuts.extend(self.ramps.iter().flat_map(FloorRamp::cuts));
        cuts.extend(self.friction_patches.iter().flat_map(FrictionPatch::cuts));
        cuts.extend(self.friction_tiles.iter().flat_map(|tiles| tiles.cuts(centre, half_edge)));
        cuts.extend(self.height_field.iter().flat_map(|field| field.cuts(centre, half_edge)));
        cuts
    }
}
