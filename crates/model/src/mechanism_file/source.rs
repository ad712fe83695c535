//! Where an imported robot came from: `[source]`, `urdf` and `urdf_sign` of each joint, `[[held]]`.

use config::Table;
use nalgebra::{Quaternion, UnitQuaternion, Vector4};

use super::held;
use crate::{PerJoint, UrdfJoint, UrdfSource};

/// Largest coordinate of a sole in the root link's frame (m).
const SOLE_MAX: f64 = 100.0;

/// Reads the source; `None` for a robot that was not imported.
pub(super) fn read(root: &Table, tables: &PerJoint<Table>) -> Option<UrdfSource> {
    if !root.has("source") {
        return None;
    }
    let source = root.table("source");
    let file = source.text("urdf").to_string();
    let trunk_link = source.text("trunk_link").to_string();
    let turn = source.numbers::<4>("root_to_stand_wxyz");
    let turn = turn.that(|wxyz| (Vector4::from(*wxyz).norm() - 1.0).abs() < 1e-6, "must be a unit quaternion");
    let root_to_stand = UnitQuaternion::new_normalize(Quaternion::new(turn[0], turn[1], turn[2], turn[3]));
    let soles_in_root =
        ["right_sole_m", "left_sole_m"].map(|key| source.numbers(key).between(-SOLE_MAX, SOLE_MAX).into());
    let joints = PerJoint::from_fn(|joint| {
        let table = &tables[joint];
        table.has("urdf").then(|| UrdfJoint {
            name: table.text("urdf").to_string(),
            sign: table.number("urdf_sign").that(|sign| sign.abs() == 1.0, "must be 1 or -1"),
        })
    });
    let held = held::read(root, tables);
    Some(UrdfSource { file, trunk_link, root_to_stand, soles_in_root, joints, held })
}
