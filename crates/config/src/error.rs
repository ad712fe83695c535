//! The mistakes of a configuration file.

use std::fmt;
use std::path::Path;

/// One mistake in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// Name of the file, as it was given when the file was opened.
    pub file: String,
    /// Line of the mistake, from 1; 0 when the file could not be read at all.
    pub line: usize,
    /// Column of the mistake in characters, from 1; 0 when the file could not be read at all.
    pub column: usize,
    /// Path of the key: `joint.right_knee.axis`. Empty for the file as a whole.
    pub path: String,
    /// The value as it is written in the file, shortened to a line; `None` when there is none.
    pub found: Option<String>,
    /// What is wrong, or what would be right, for people.
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
    /// Errors in the order of the text; there must be one at least.
    ///
    /// A key that is looked up twice is reported once.
    pub(crate) fn in_order(mut errors: Vec<ConfigError>) -> Self {
        errors.sort_by(|a, b| (a.line, a.column, &a.path, &a.message).cmp(&(b.line, b.column, &b.path, &b.message)));
        errors.dedup();
        Self(errors)
    }

    /// The single error of a file that could not be opened or is not UTF-8.
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
