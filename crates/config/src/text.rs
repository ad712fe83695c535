//! The text of a file on disk.

use std::path::Path;

use crate::ConfigErrors;

/// The text of a file.
///
/// # Errors
/// When it cannot be opened or is not UTF-8, with the reason and the path.
pub fn read_text(path: &Path) -> Result<String, ConfigErrors> {
    std::fs::read_to_string(path).map_err(|reason| ConfigErrors::unreadable(path, &reason))
}
