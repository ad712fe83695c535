//! The sole, told by the map or read off the collision shapes of the foot.

use config::Table;
use nalgebra::{Isometry3, Point3, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::toml_text::number;
use crate::import::urdf_robot::{Shape, Solid, UrdfRobot};

/// How far above the lowest point of a foot its shapes still belong to the sole (m).
const FLATNESS: f64 = 3e-3;

/// A rectangular sole, seen from the point on it under the ankle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SoleSize {
    /// Distance back to the heel's edge (m).
    pub behind: f64,
    /// Distance forward to the toes' edge (m).
    pub ahead: f64,
    /// Width, half of it to either side (m).
    pub width: f64,
    /// Height of the ankle above the sole (m).
    pub ankle_height: f64,
}

impl SoleSize {
    /// Reads a table `[sole]`, noting what is wrong.
    pub(super) fn read(table: &Table) -> Self {
        Self {
            behind: table.number("behind_m").between(1e-3, 2.0),
            ahead: table.number("ahead_m").between(1e-3, 2.0),
            width: table.number("width_m").between(1e-3, 2.0),
            ankle_height: table.number("ankle_height_m").between(0.0, 1.0),
        }
    }

    /// Keys and values of the table `[sole]`.
    pub(super) fn keys(&self) -> [(&'static str, f64); 4] {
        [
            ("behind_m", self.behind),
            ("ahead_m", self.ahead),
            ("width_m", self.width),
            ("ankle_height_m", self.ankle_height),
        ]
    }

    /// The sole that the shapes of a foot make, seen from the ankle; `None` where there are none that make one.
    ///
    /// `points` are where the foot could touch a floor, in the frame of the standing robot. The rectangle is as wide as
    /// fits on both sides of the ankle.
    pub(super) fn of_points(points: &[Vector3<f64>], ankle: Vector3<f64>) -> Option<Self> {
        let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
        let on_sole: Vec<Vector3<f64>> =
            points.iter().filter(|point| point.z <= lowest + FLATNESS).map(|point| point - ankle).collect();
        let extent = |value: fn(&Vector3<f64>) -> f64| on_sole.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let sole = Self {
            behind: extent(|point| -point.x),
            ahead: extent(|point| point.x),
            width: 2.0 * extent(|point| point.y).min(extent(|point| -point.y)),
            ankle_height: ankle.z - lowest,
        };
        let sizes = [sole.behind, sole.ahead, sole.width];
        (sizes.iter().all(|size| (1e-3..=2.0).contains(size)) && (0.0..=1.0).contains(&sole.ankle_height))
            .then_some(sole)
    }

    /// The mean of two soles.
    pub(super) fn mean(&self, other: &Self) -> Self {
        Self {
            behind: (self.behind + other.behind) / 2.0,
            ahead: (self.ahead + other.ahead) / 2.0,
            width: (self.width + other.width) / 2.0,
            ankle_height: (self.ankle_height + other.ankle_height) / 2.0,
        }
    }
}

/// The sole that the collision shapes of both feet make; notes where they make none.
///
/// `points` are those at which each foot could touch a floor, `ankles` the feet's ankles, in the frame of the standing
/// robot; `foot` names the right foot's link.
pub(super) fn read_off(
    points: &[Vec<Vector3<f64>>; 2],
    ankles: [Vector3<f64>; 2],
    foot: &str,
    errors: &mut FileErrors,
    lines: &mut Vec<String>,
) -> Option<SoleSize> {
    let [right, left] = [0, 1].map(|side| SoleSize::of_points(&points[side], ankles[side]));
    let Some(sole) = right.zip(left).map(|(right, left)| right.mean(&left)) else {
        errors.note(format!(
            "link {foot}: the foot has no boxes, cylinders or spheres as <collision> that make a sole: measure it, \
             from the point on the sole under the ankle, and write into the map\n[sole]\nbehind_m = …        # back to \
             the heel's edge\nahead_m = …         # forward to the toes' edge\nwidth_m = …         # half of it to \
             either side\nankle_height_m = …  # the ankle's axes above the sole"
        ));
        return None;
    };
    let words: Vec<String> =
        sole.keys().iter().map(|(key, value)| format!("{key} = {}", number(*value, 1e6))).collect();
    lines.push(format!("sole read off the feet's collision shapes: {}", words.join(", ")));
    Some(sole)
}

/// The points at which the shapes of a body could touch a floor below it, z up; `links` maps link coordinates to those
/// of the points.
pub(super) fn contact_points(
    robot: &UrdfRobot,
    body_of: &[usize],
    body: usize,
    links: &[Isometry3<f64>],
) -> Vec<Vector3<f64>> {
    let own = robot.links.iter().zip(links).zip(body_of).filter(|(_, other)| **other == body);
    own.flat_map(|((link, pose), _)| link.shapes.iter().flat_map(move |shape| lowest_points(shape, pose))).collect()
}

/// Corners of a box, the lowest point of a sphere, and the lowest points of a cylinder's two ends.
fn lowest_points(shape: &Shape, link: &Isometry3<f64>) -> Vec<Vector3<f64>> {
    let pose = link * shape.pose;
    let place = |x: f64, y: f64, z: f64| (pose * Point3::new(x, y, z)).coords;
    match shape.solid {
        Solid::Box(size) => {
            let half = size / 2.0;
            let signs = (0..8).map(|corner| [1, 2, 4].map(|bit| if corner & bit == 0 { 1.0 } else { -1.0 }));
            signs.map(|[x, y, z]| place(x * half.x, y * half.y, z * half.z)).collect()
        }
        Solid::Sphere { radius } => vec![place(0.0, 0.0, 0.0) - Vector3::z() * radius],
        Solid::Cylinder { radius, length } => {
            let axis = pose.rotation * Vector3::z();
            let down = axis * axis.z - Vector3::z();
            let ends = [place(0.0, 0.0, length / 2.0), place(0.0, 0.0, -length / 2.0)];
            if down.norm() > 1e-2 {
                return ends.into_iter().map(|end| end + down.normalize() * radius).collect();
            }
            let rims = [(radius, 0.0), (-radius, 0.0), (0.0, radius), (0.0, -radius)];
            ends.into_iter().flat_map(|end| rims.map(|(x, y)| end + pose.rotation * Vector3::new(x, y, 0.0))).collect()
        }
    }
}
