//! The configuration folder of a robot in the box, in the user's cache.

use std::fs;
use std::path::{Path, PathBuf};

use robots::BuiltInRobot;

use crate::error::CliError;

/// The configuration folder of a robot; written if it is not there as it should be.
///
/// # Errors
/// The cache cannot be written, or neither HOME nor XDG_CACHE_HOME is set.
pub(crate) fn folder_of(robot: &BuiltInRobot) -> Result<PathBuf, CliError> {
    let cache = node::engine::cache().map_err(CliError::new)?;
    let folder = cache.join(format!("robots-{}", env!("CARGO_PKG_VERSION"))).join(robot.name);
    for (name, text) in robot.files {
        let file = folder.join(name);
        if fs::read(&file).is_ok_and(|written| written == text.as_bytes()) {
            continue;
        }
        write_at_once(&file, text).map_err(CliError::file(&file))?;
    }
    Ok(folder)
}

/// Writes a file that another process may be reading: it sees the former text or all of the new one.
fn write_at_once(file: &Path, text: &str) -> std::io::Result<()> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let unfinished = file.with_extension(format!("{}.unfinished", std::process::id()));
    fs::write(&unfinished, text)?;
    fs::rename(&unfinished, file)
}
