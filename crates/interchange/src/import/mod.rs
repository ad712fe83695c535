//! Imports another biped with the same joints from its URDF and a map of its joints: see `docs/import.md`.
//!
//! At zero angles all link frames of a mechanism are parallel. So the URDF is put into its straight posture; from then
//! on joints are points and axes, and links are masses, in one frame. Whichever link the URDF's tree is rooted at, the
//! mechanism's is rooted at the right foot.
//!
//! ```text
//! map ──┐
//! URDF ─┴▶ link poses ─▶ topology ─▶ straight legs ─▶ symmetry ─▶ mechanism file
//! ```

mod file_errors;
mod joint_map;
mod link_poses;
mod mechanism_text;
mod straight_biped;
mod straight_legs;
mod symmetry;
mod topology;
mod urdf_text;

use config::Config;
use model::Mechanism;

pub use file_errors::{ImportError, NamedText};
pub use joint_map::JointMap;

use file_errors::FileErrors;

/// A biped imported from a URDF.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The mechanism of the biped.
    pub mechanism: Mechanism,
    /// The text of its mechanism file.
    pub text: String,
    /// Differences from the URDF, one text each, for users.
    pub changes: Vec<String>,
}

/// Imports a biped from its URDF; `map` tells which joint is which, and adds what a URDF lacks.
///
/// # Errors
/// All mistakes in the map, with their lines; else everything in the URDF that a mechanism cannot have, with link or
/// joint, value, and remedy.
pub fn import(urdf: NamedText, map: NamedText) -> Result<Imported, ImportError> {
    let robot = urdf_text::read(urdf)?;
    let map = JointMap::read(map, &robot).map_err(ImportError::new)?;

    let mut errors = FileErrors { file: urdf.file, errors: Vec::new() };
    let biped = link_poses::straight(&robot, &map, &mut errors)
        .and_then(|poses| topology::straight_biped(&robot, &map, &poses, &mut errors));
    let mut biped = errors.finish(biped)?;

    let mut errors = FileErrors { file: urdf.file, errors: Vec::new() };
    let mut changes = std::mem::take(&mut biped.changes);
    straight_legs::straighten(&mut biped, &map.idealise, &mut errors, &mut changes);
    symmetry::symmetrise(&mut biped, &map.idealise, &mut errors, &mut changes);
    biped.check_inertias(&map.idealise, &mut errors, &mut changes);
    errors.finish(Some(()))?;

    let text = mechanism_text::write(&biped, &map, urdf.file);
    let mechanism =
        Mechanism::from_toml(&text, &format!("the mechanism read from {}", urdf.file)).map_err(ImportError::new)?;
    Ok(Imported { mechanism, text, changes })
}
