//! The text of a file on disk.

use std::fs::File;
use std::io::{Error, Read};
use std::path::Path;

use crate::ConfigErrors;

/// Longest text that is read (bytes); any file that a person writes for us is far shorter.
const LENGTH_MAX: u64 = 16 << 20;

/// The text of a file.
///
/// # Errors
/// When it cannot be opened, is not UTF-8, or has more than 16 MiB, with the reason and the path.
pub fn read_text(path: &Path) -> Result<String, ConfigErrors> {
    bounded_text(path).map_err(|reason| ConfigErrors::unreadable(path, &reason))
}

/// The same for files that are no TOML, whose readers have errors of their own.
///
/// # Errors
/// As for [`read_text`], as the operating system gives the reason.
pub fn bounded_text(path: &Path) -> Result<String, Error> {
    let mut text = String::new();
    File::open(path)?.take(LENGTH_MAX + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LENGTH_MAX {
        return Err(Error::other(format!("it has more than {} MiB", LENGTH_MAX >> 20)));
    }
    Ok(text)
}
