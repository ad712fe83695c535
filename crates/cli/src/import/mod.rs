//! Another biped of the same build, from its URDF and a map of its joints: see `docs/import.md`.
//!
//! At zero angles all link frames of a mechanism are parallel. So the URDF is put into its straight posture, and from
//! there on joints are points and axes, and bodies are masses, in one frame: whichever link the URDF's tree is rooted
//! at, ours stands on the right foot.
//!
//! ```text
//! map ──┐
//! URDF ─┴▶ posture ─▶ topology ─▶ straight legs ─▶ symmetry ─▶ mechanism file
//! ```

mod joint_map;
mod mechanism_text;
mod posture;
mod stance;
mod straight_legs;
mod symmetry;
mod topology;

use model::Mechanism;

pub use joint_map::JointMap;

use crate::configuration::Errors;
use crate::failure::Failure;

/// A biped that was read from a URDF.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The biped.
    pub mechanism: Mechanism,
    /// The text of its mechanism file.
    pub text: String,
    /// What is other than in the URDF, for people.
    pub changes: Vec<String>,
}

/// A file's text, and its name for messages.
#[derive(Clone, Copy, Debug)]
pub struct NamedText<'t> {
    /// The text.
    pub text: &'t str,
    /// The name.
    pub file: &'t str,
}

/// Reads a biped from its URDF; `map` says which joint is which, and what a URDF cannot say.
///
/// # Errors
/// Everything wrong with the map, with its lines; else everything about the URDF that keeps its robot from being our
/// biped, with link or joint, value, and what would be right.
pub fn import(urdf: NamedText, map: NamedText) -> Result<Imported, Failure> {
    let robot = urdf_rs::read_from_string(urdf.text)
        .map_err(|error| Failure::bad_input(format!("{}: no URDF: {error}", urdf.file)))?;
    let map = JointMap::read(map, &robot).map_err(Failure::bad_input)?;

    let mut errors = FileErrors { file: urdf.file, errors: Errors::default() };
    let stance = posture::straight(&robot, &map, &mut errors)
        .and_then(|posture| topology::stance(&robot, &map, &posture, &mut errors));
    let mut stance = errors.finish(stance)?;

    let mut errors = FileErrors { file: urdf.file, errors: Errors::default() };
    let mut changes = std::mem::take(&mut stance.changes);
    straight_legs::straighten(&mut stance, &map.idealise, &mut errors, &mut changes);
    symmetry::symmetrise(&mut stance, &map.idealise, &mut errors, &mut changes);
    stance.check_inertias(&map.idealise, &mut errors, &mut changes);
    errors.finish(Some(()))?;

    let text = mechanism_text::write(&stance, &map, urdf.file);
    let mechanism =
        Mechanism::from_toml(&text, &format!("the mechanism read from {}", urdf.file)).map_err(Failure::bad_input)?;
    Ok(Imported { mechanism, text, changes })
}

/// What is wrong with one file.
struct FileErrors<'f> {
    file: &'f str,
    errors: Errors,
}

impl FileErrors<'_> {
    fn note(&mut self, error: impl std::fmt::Display) {
        self.errors.0.push(format!("{}: {error}", self.file));
    }

    fn finish<T>(self, loaded: Option<T>) -> Result<T, Failure> {
        self.errors.finish(loaded)
    }
}
