//! Writes fields that are more than a number as columns of a CSV file; for serde's `serialize_with`.

use interface::{AddedAngles, DestinationProgress, WalkPose};
use model::{ComState, JointVector};
use nalgebra::{Isometry3, Vector2, Vector3};
use serde::{Serialize, Serializer};

/// A pose as x, y, z (m) and a unit quaternion w, x, y, z.
pub(super) fn pose<S: Serializer>(pose: &Isometry3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    let (p, q) = (pose.translation, pose.rotation);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k].serialize(serializer)
}

/// Values of the joints, one column each.
pub(super) fn joints<S: Serializer>(values: &JointVector, serializer: S) -> Result<S::Ok, S::Error> {
    values.0.serialize(serializer)
}

/// Values of the joints, one column each, empty where there is none.
pub(super) fn known_joints<S: Serializer>(values: &JointVector, serializer: S) -> Result<S::Ok, S::Error> {
    values.0.map(|value| Some(value).filter(|value| value.is_finite())).serialize(serializer)
}

/// A vector as x, y, z.
pub(super) fn vector<S: Serializer>(vector: &Vector3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    <[f64; 3]>::from(*vector).serialize(serializer)
}

/// A point as x and y, both empty for `None`.
pub(super) fn maybe_point<S: Serializer>(point: &Option<Vector2<f64>>, serializer: S) -> Result<S::Ok, S::Error> {
    [point.map(|p| p.x), point.map(|p| p.y)].serialize(serializer)
}

/// Position and velocity, x, y and z each, all empty when there is no such point.
pub(super) fn centre_of_mass<S: Serializer>(com: &Option<ComState>, serializer: S) -> Result<S::Ok, S::Error> {
    let numbers = com.map(|ComState { position: p, velocity: v }| [p.x, p.y, p.z, v.x, v.y, v.z]);
    numbers.map_or([None; 6], |numbers| numbers.map(Some)).serialize(serializer)
}

/// Added angles in degrees: ankle about x and y, waist about x and y; all empty for `None`.
pub(super) fn added_angles<S: Serializer>(added: &Option<AddedAngles>, serializer: S) -> Result<S::Ok, S::Error> {
    let angles = added.map(|AddedAngles { ankle, waist }| [ankle.x, ankle.y, waist.x, waist.y]);
    angles.map_or([None; 4], |angles| angles.map(|angle| Some(angle.to_degrees()))).serialize(serializer)
}

/// An angle (rad) in degrees.
pub(super) fn degrees<S: Serializer>(angle: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    angle.to_degrees().serialize(serializer)
}

/// A pose on the floor as x, y (m) and heading (rad).
pub(super) fn walk_pose<S: Serializer>(pose: &WalkPose, serializer: S) -> Result<S::Ok, S::Error> {
    [pose.x, pose.y, pose.heading].serialize(serializer)
}

/// Places left, distance (m) and turn in degrees, all empty without a destination.
pub(super) fn destination<S: Serializer>(
    progress: &Option<DestinationProgress>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let left = progress.map(|progress| progress.places_left);
    let numbers = progress.map(|progress| (progress.distance, progress.turn.to_degrees()));
    (left, numbers.map(|(distance, _)| distance), numbers.map(|(_, turn)| turn)).serialize(serializer)
}

/// A flag as 0 or 1, which a spreadsheet can plot.
pub(super) fn flag<S: Serializer>(flag: &bool, serializer: S) -> Result<S::Ok, S::Error> {
    u8::from(*flag).serialize(serializer)
}
