//! The floor where it is no plane: the pieces that a page draws, and where the walk frame lies in it.

use nalgebra::{Isometry3, Vector2, Vector3};
use plant::Ground;
use serde::Serialize;

use crate::rounded::rounded;

/// Length of a cell's edge (m).
const CELL: f64 = 1.0;
/// How many cells to each side of the robot's are shown.
const REACH: i32 = 3;

/// A plane piece of the floor, convex.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorPiece {
    /// Its corners in the world, counter-clockwise seen from above (m).
    pub corners: Vec<[f64; 3]>,
    /// Friction coefficient (-).
    pub friction: f64,
}

/// A square of the floor, by its place in the world in lengths of its edge.
pub type FloorCell = [i32; 2];

/// A floor that is cut into cells, so that what is near a robot can be shown.
#[derive(Clone, Debug)]
pub struct FloorCells(Ground);

impl FloorCells {
    /// The cells of a ground; `None` of a plane, which a page draws by itself.
    pub fn new(ground: Ground) -> Option<Self> {
        (!ground.is_plane()).then_some(Self(ground))
    }

    /// The cell in which a place of the world lies (m).
    pub fn cell(place: Vector2<f64>) -> FloorCell {
        (place / CELL).map(|at| at.floor() as i32).into()
    }

    /// The cells within some metres of one.
    pub fn near([x, y]: FloorCell) -> impl Iterator<Item = FloorCell> {
        (-REACH..=REACH).flat_map(move |dx| (-REACH..=REACH).map(move |dy| [x + dx, y + dy]))
    }

    /// The pieces of some cells.
    pub fn pieces(&self, cells: impl IntoIterator<Item = FloorCell>) -> Vec<FloorPiece> {
        let of_cell = |cell: FloorCell| {
            let middle = Vector2::from(cell).map(|at| (f64::from(at) + 0.5) * CELL);
            self.0.pieces(middle, CELL / 2.0)
        };
        let shown = |corners: &Vec<Vector3<f64>>| corners.iter().map(|corner| rounded((*corner).into())).collect();
        let pieces = cells.into_iter().flat_map(of_cell);
        pieces.map(|piece| FloorPiece { corners: shown(&piece.corners), friction: piece.friction }).collect()
    }
}

/// The world's origin in the walk frame: x, y (m), heading (rad) and height (m). The walk frame is level like the
/// world; odometry drifts, and on a page the lowest point of the robot has the height 0.
///
/// * `drawn` – the right sole in the walk frame
/// * `truly` – the right sole in the world
pub(crate) fn world_in_walk(drawn: &Isometry3<f64>, truly: &Isometry3<f64>) -> [f64; 4] {
    let ahead = (drawn.rotation * truly.rotation.inverse()) * Vector3::x();
    let heading = ahead.y.atan2(ahead.x);
    let turned = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), heading) * truly.translation.vector;
    let origin = drawn.translation.vector - turned;
    [origin.x, origin.y, heading, origin.z]
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};
    use plant::{FloorShape, FloorStep, Unevenness};

    use super::*;

    fn stepped() -> Ground {
        let step = FloorStep { direction: Vector2::x(), from: 2.25, height: 0.03, length: f64::INFINITY };
        let shape = FloorShape { steps: vec![step], ..FloorShape::default() };
        Ground::new(Unevenness::default(), shape, 0.7, 1)
    }

    #[test]
    fn a_plane_needs_no_pieces_and_other_ground_is_covered_by_them() {
        assert!(FloorCells::new(Ground::plane(0.7)).is_none());
        let cells = FloorCells::new(stepped()).expect("a step");
        let here = FloorCells::cell(Vector2::new(2.7, -0.2));
        assert_eq!(here, [2, -1]);
        assert_eq!(FloorCells::near(here).count(), 49);
        let pieces = cells.pieces([here]);
        let area = |piece: &FloorPiece| -> f64 {
            let corners = &piece.corners;
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum()
        };
        assert!((pieces.iter().map(area).sum::<f64>() - 1.0).abs() < 1e-3, "{pieces:?}");
        let of_height =
            |height: f64| pieces.iter().filter(|piece| piece.corners[0][2] == height).map(area).sum::<f64>();
        assert!((of_height(0.0) - 0.25).abs() < 1e-3 && (of_height(0.03) - 0.75).abs() < 1e-3, "{pieces:?}");
    }

    #[test]
    fn the_floor_is_where_the_sole_truly_stands_on_it() {
        let tilt = UnitQuaternion::from_euler_angles(0.1, -0.05, 0.0);
        let turned = |heading: f64| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading) * tilt;
        let drawn = Isometry3::from_parts(Translation3::new(3.0, 1.0, 0.002), turned(0.4));
        let truly = Isometry3::from_parts(Translation3::new(2.8, 1.3, 0.032), turned(-0.2));
        let [x, y, heading, z] = world_in_walk(&drawn, &truly);
        let world = Isometry3::from_parts(
            Translation3::new(x, y, z),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading),
        );
        let back = world * truly;
        assert!((back.translation.vector - drawn.translation.vector).norm() < 1e-12);
        assert!(back.rotation.angle_to(&drawn.rotation) < 1e-9);
    }
}
