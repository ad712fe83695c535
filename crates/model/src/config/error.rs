//! What is wrong with a configuration file, all of it.

use std::fmt;
use std::path::Path;

/// One mistake in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// The file as it was named when it was opened.
    pub file: String,
    /// Line, from 1; 0 when the file could not be read at all.
    pub line: usize,
    /// Column in characters, from 1; 0 when the file could not be read at all.
    pub column: usize,
    /// Where in the file's tables: `joint.right_knee.axis`. Empty for the file as a whole.
    pub path: String,
    /// The value as it is written in the file, shortened to a line; `None` when there is none.
    pub found: Option<String>,
    /// What is wrong, or what would be right.
    pub message: String,
}

impl fmt::Display for ConfigError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.file)?;
        if self.line > 0 {
            write!(out, ":{}:{}", self.line, self.column)?;
        }
        if !self.path.is_empty() {
            write!(out, ": {}", self.path)?;
        }
        if let Some(found) = &self.found {
            write!(out, " = {found}")?;
        }
        write!(out, ": {}", self.message)
    }
}

/// Every mistake of a file, in the order of its lines. Never empty. Displays one per line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigErrors(pub Vec<ConfigError>);

impl ConfigErrors {
    /// The one error of a file that could not be opened or decoded.
    pub fn unreadable(path: &Path, reason: &std::io::Error) -> Self {
        Self(vec![ConfigError {
            file: path.display().to_string(),
            line: 0,
            column: 0,
            path: String::new(),
            found: None,
            message: format!("cannot be read: {reason}"),
        }])
    }
}

impl fmt::Display for ConfigErrors {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(out)?;
            }
            write!(out, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for ConfigErrors {}

/// The text of a file.
///
/// # Errors
/// When it cannot be opened or is not UTF-8, with the reason and the path.
pub fn read(path: &Path) -> Result<String, ConfigErrors> {
    std::fs::read_to_string(path).map_err(|reason| ConfigErrors::unreadable(path, &reason))
}
