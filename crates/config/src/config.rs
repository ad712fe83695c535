//! A type with a file of its own.

use std::path::Path;

use crate::{ConfigErrors, Document, Table, read_text};

/// A type that is read from a TOML file of its own, strictly.
///
/// Implementors write [`read`](Config::read); users call [`load`](Config::load) or [`from_toml`](Config::from_toml).
pub trait Config: Sized {
    /// Reads the file's top-level table. Mistakes are noted in the table; the value returned is used only if there are
    /// none.
    fn read(root: &Table) -> Self;

    /// Reads a file.
    ///
    /// # Errors
    /// When the file cannot be read, and everything of [`from_toml`](Config::from_toml).
    fn load(path: impl AsRef<Path>) -> Result<Self, ConfigErrors> {
        let path = path.as_ref();
        Self::from_toml(&read_text(path)?, &path.display().to_string())
    }

    /// Reads the text of a file; `file` is its name for messages.
    ///
    /// # Errors
    /// Every mistake of the text: no TOML, a key that is unknown, missing, of a wrong type or in a wrong unit, a value
    /// out of range.
    fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let loaded = Self::read(&document.root());
        document.finish(loaded)
    }
}
