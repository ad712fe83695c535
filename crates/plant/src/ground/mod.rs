//! The ground: height, normal and friction at every place, made of the parts in `config/plant.toml`.
//!
//! The x and y axes of the world lie in the plane z = 0, which `[slope]` tilts against the vertical. On it lie tiles,
//! steps, ramps and a field of heights; their heights add up. Between edges the ground is plane: other engines get it
//! as convex pieces ([`Ground::pieces`]) that agree with it everywhere.

mod cut;
mod floor_extent;
mod floor_ramp;
mod floor_shape;
mod floor_step;
mod friction_patch;
mod friction_tiles;
mod height_field;
mod piece;
mod surface;
mod tile_share;
mod unevenness;

use nalgebra::{Vector2, Vector3};

pub use floor_ramp::FloorRamp;
pub use floor_shape::FloorShape;
pub use floor_step::FloorStep;
pub use friction_patch::FrictionPatch;
pub use friction_tiles::FrictionTiles;
pub use height_field::HeightField;
pub use piece::GroundPiece;
pub use surface::{Surface, Touch};
pub use unevenness::Unevenness;

use crate::robot_sized::EVEN_HALF_EDGE;

/// The ground of a run.
#[derive(Clone, Debug)]
pub struct Ground {
    unevenness: Unevenness,
    shape: FloorShape,
    /// Friction coefficient where nothing else is set (-).
    friction: f64,
    /// Seed of the tiles.
    seed: u64,
    has_relief: bool,
}

impl Ground {
    /// A ground of tiles and other shape.
    ///
    /// * `friction` – friction coefficient where nothing else is set (-)
    /// * `seed` – seed of the tiles
    pub fn new(unevenness: Unevenness, shape: FloorShape, friction: f64, seed: u64) -> Self {
        let has_relief = !shape.is_flat();
        Self { unevenness, shape, friction, seed, has_relief }
    }

    /// A plane with one friction coefficient (-).
    pub fn plane(friction: f64) -> Self {
        Self::new(Unevenness::default(), FloorShape::default(), friction, 0)
    }

    /// Whether it is a plane of one friction coefficient.
    pub fn is_plane(&self) -> bool {
        self.unevenness.height == 0.0 && self.shape == FloorShape::default()
    }

    /// Whether it has more shape than level tiles: a sole then touches it between its corners, too.
    pub(crate) fn has_relief(&self) -> bool {
        self.has_relief
    }

    /// Height at a place in the world (m).
    pub fn height(&self, place: Vector2<f64>) -> f64 {
        let height = self.unevenness.at(place, self.seed);
        if self.has_relief { height + self.shape.height(place) } else { height }
    }

    /// Unit normal at a place in the world, upward (-).
    pub fn normal(&self, place: Vector2<f64>) -> Vector3<f64> {
        if !self.has_relief {
            return Vector3::z();
        }
        let slope = self.shape.slope(place);
        if slope == Vector2::zeros() { Vector3::z() } else { Vector3::new(-slope.x, -slope.y, 1.0).normalize() }
    }

    /// Friction coefficient at a place in the world (-).
    pub fn friction(&self, place: Vector2<f64>) -> f64 {
        let patch = self.shape.friction_patches.iter().rfind(|patch| patch.covers(place));
        let tile = || self.shape.friction_tiles.and_then(|tiles| tiles.at(place, self.seed));
        patch.map(|patch| patch.friction).or_else(tile).unwrap_or(self.friction)
    }

    /// Where a point of the world touches the ground: the floor under or over it, and the side of a step if it has gone
    /// into one.
    pub fn touch(&self, point: &Vector3<f64>) -> Touch {
        let place = point.xy();
        let (height, friction) = (self.height(place), self.friction(place));
        let over = |height: f64| height - point.z;
        if !self.has_relief {
            return Touch { floor: Surface { depth: over(height), normal: Vector3::z(), friction }, wall: None };
        }
        let normal = self.normal(place);
        let entered = self.shape.steps.iter().filter_map(|step| step.entered(place, over(height)));
        let wall = entered.min_by(|a, b| a.depth.total_cmp(&b.depth));
        // What has gone into a step from the side is still over the lower floor before it.
        let height = height - wall.map_or(0.0, |wall| wall.height);
        Touch {
            floor: Surface { depth: over(height) * normal.z, normal, friction },
            wall: wall.map(|wall| Surface { depth: wall.depth, normal: wall.normal, friction }),
        }
    }

    /// The ground in a square as convex pieces, each plane, of one friction coefficient and without overlap.
    ///
    /// * `centre` – of the square, in the world (m)
    /// * `half_edge` – half the length of its edges (m)
    pub fn pieces(&self, centre: Vector2<f64>, half_edge: f64) -> Vec<GroundPiece> {
        let mut cuts = self.unevenness.cuts(centre, half_edge);
        cuts.extend(self.shape.cuts(centre, half_edge));
        if self.unevenness.height > 0.0 || self.shape.friction_tiles.is_some() {
            // First, since tiles begin outside.
            cuts.splice(0..0, cut::Cut::around([Vector2::zeros(); 2], EVEN_HALF_EDGE));
        }
        let piece = |outline: &Vec<Vector2<f64>>| {
            // In the middle: at the edges another piece may begin.
            let middle = cut::centroid(outline);
            let friction = self.friction(middle);
            GroundPiece::over(outline, middle.push(self.height(middle)), self.normal(middle), friction)
        };
        cut::cut_square(centre, half_edge, &cuts).iter().map(piece).collect()
    }

    /// Least edge of the parts that repeat: tiles and the cells of a height field (m); `None` without any.
    pub fn finest_edge(&self) -> Option<f64> {
        let tiles = (self.unevenness.height > 0.0).then_some(self.unevenness.tile);
        let friction = self.shape.friction_tiles.map(|tiles| tiles.tile);
        let field = self.shape.height_field.as_ref().map(HeightField::spacing);
        [tiles, friction, field].into_iter().flatten().min_by(f64::total_cmp)
    }
}
