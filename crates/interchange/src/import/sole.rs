//! The sole, told by the map or read off the collision shapes of the foot.

use model::{Side, Sole};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::import::file_errors::FileErrors;
use crate::import::toml_text::number;
use crate::import::urdf_robot::{Shape, Solid, UrdfRobot};

/// How far above the lowest point of a foot its shapes still belong to the sole (m).
const FLATNESS: f64 = 3e-3;
/// Difference of two lengths that is rounding (m).
const ROUNDING: f64 = 1e-5;

/// The sole that the shapes of a foot make, seen from the ankle; `None` where there are none that make one.
///
/// * `points` – where the foot could touch a floor, in the frame of the standing robot
/// * `ankle` – the foot's ankle, in the same frame (m)
fn of_points(side: Side, points: &[Vector3<f64>], ankle: Vector3<f64>) -> Option<Sole> {
    let lowest = points.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    let on_sole: Vec<Vector3<f64>> =
        points.iter().filter(|point| point.z <= lowest + FLATNESS).map(|point| point - ankle).collect();
    let extent = |value: fn(&Vector3<f64>) -> f64| on_sole.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
    let aside = [extent(|point| -point.y), extent(|point| point.y)];
    // The right foot's inner edge is its left one.
    let [outside, inside] = if side == Side::Right { aside } else { [aside[1], aside[0]] };
    let (behind, ahead) = (extent(|point| -point.x), extent(|point| point.x));
    let sole = Sole { behind, ahead, inside, outside, ankle_height: ankle.z - lowest };
    let is_size = |size: f64| (1e-3..=2.0).contains(&size);
    let is_sole = [behind, ahead, inside, outside].into_iter().all(is_size);
    (is_sole && (0.0..=1.0).contains(&sole.ankle_height)).then_some(sole)
}

/// The mean of two soles. What is as wide on both sides but for rounding, is so.
fn mean(right: &Sole, left: &Sole) -> Sole {
    let of = |length: fn(&Sole) -> f64| (length(right) + length(left)) / 2.0;
    let [inside, outside] = [of(|sole| sole.inside), of(|sole| sole.outside)];
    let [inside, outside] =
        if (inside - outside).abs() < ROUNDING { [(inside + outside) / 2.0; 2] } else { [inside, outside] };
    Sole {
        behind: of(|sole| sole.behind),
        ahead: of(|sole| sole.ahead),
        inside,
        outside,
        ankle_height: of(|sole| sole.ankle_height),
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
) -> Option<Sole> {
    let [right, left] = Side::BOTH.map(|side| of_points(side, &points[side.index()], ankles[side.index()]));
    let Some(sole) = right.zip(left).map(|(right, left)| mean(&right, &left)) else {
        errors.note(format!(
            "link {foot}: the foot has no boxes, cylinders or spheres as <collision> that make a sole: measure it, \
             from the point on the sole under the ankle, and write into the map\n[sole]\nbehind_m = …        # back to \
             the heel's edge\nahead_m = …         # forward to the toes' edge\nwidth_m = …         # half of it to \
             either side, or inside_m and outside_m\nankle_height_m = …  # the ankle's axes above the sole"
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
