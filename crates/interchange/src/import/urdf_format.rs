//! Tells a URDF from other formats.

use crate::import::xml_tree::{Element, root_element};

/// Reads a URDF's root element, which has links and joints.
///
/// # Errors
/// One sentence about the file: which other format it is, or where it breaks off.
pub(super) fn robot_element(text: &str) -> Result<Element, String> {
    let root = root_element(text)?;
    let name = root.name.as_str();
    let is_xacro = |element: &Element| element.name.starts_with("xacro:");
    match name {
        "robot" => {}
        "sdf" => return Err("its root element is <sdf>: it is SDF; convert it to URDF first".to_string()),
        "mujoco" => return Err("its root element is <mujoco>: it is MJCF; convert it to URDF first".to_string()),
        _ => {
            let xacro = if is_xacro(&root) { ": expand it with xacro" } else { "" };
            return Err(format!("its root element is <{name}>, and a URDF's is <robot>{xacro}"));
        }
    }
    if let Some(macros) = root.first_that_begins("xacro:") {
        return Err(format!(
            "line {}: it has macros of xacro (<{}>): expand it first, with `xacro FILE > robot.urdf`",
            macros.line, macros.name
        ));
    }
    if root.child("link").is_none() {
        return Err("it has no links and joints within <robot>".to_string());
    }
    Ok(root)
}
