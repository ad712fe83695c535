//! Where an imported robot came from: `[source]`, `urdf` and `urdf_sign` of each joint, `[[held]]`.

use config::Table;

use crate::{HeldJoint, PerJoint, UrdfJoint, UrdfSource};

/// Reads the source; `None` for a robot that was not imported.
pub(super) fn read(root: &Table, tables: &PerJoint<Table>) -> Option<UrdfSource> {
    if !root.has("source") {
        return None;
    }
    let file = root.table("source").text("urdf").to_string();
    let joints = PerJoint::from_fn(|joint| {
        let table = &tables[joint];
        table.has("urdf").then(|| UrdfJoint {
            name: table.text("urdf").to_string(),
            sign: table.number("urdf_sign").that(|sign| sign.abs() == 1.0, "must be 1 or -1"),
        })
    });
    let held = root.tables("held");
    let held = held
        .iter()
        .map(|table| HeldJoint {
            name: table.text("urdf").to_string(),
            angle: table.angle("at_deg").between(-720.0, 720.0),
        })
        .collect();
    Some(UrdfSource { file, joints, held })
}
