//! The text of a file, and what has been noted while it is read.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

use crate::{ConfigError, ConfigErrors};

/// Most mistakes of a kind that are reported of a file.
pub(crate) const ERRORS_MAX: usize = 100;

/// The text of a file while it is being read.
pub(crate) struct Source<'t> {
    text: &'t str,
    file: String,
    /// What reading has found so far.
    pub notes: RefCell<Notes>,
}

/// What reading has found so far.
#[derive(Default)]
pub(crate) struct Notes {
    /// Wrong values.
    pub errors: Vec<ConfigError>,
    /// Required keys that are absent; kept apart because a misspelt key may turn out to be the missing one.
    pub missing: Vec<Missing>,
    /// For each visited table, by its path, the keys that were looked up in it.
    pub expected: BTreeMap<String, Vec<String>>,
}

/// A required key that is absent.
pub(crate) struct Missing {
    /// Path of the table that lacks the key; empty for the top level.
    pub table: String,
    /// Name of the absent key in its table.
    pub key: String,
    /// The error to report unless a misspelt key was meant to be this one.
    pub error: ConfigError,
}

impl<'t> Source<'t> {
    /// A source of which nothing is noted yet; `file` is its name for messages.
    pub(crate) fn new(text: &'t str, file: &str) -> Self {
        Self { text, file: file.to_string(), notes: RefCell::default() }
    }

    /// The file's name for messages.
    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// Notes a wrong value, unless there are so many that nobody would read on.
    pub(crate) fn note(&self, error: ConfigError) {
        let errors = &mut self.notes.borrow_mut().errors;
        if errors.len() < ERRORS_MAX {
            errors.push(error);
        }
    }

    /// Whether nobody would read further errors: then their places need not be searched.
    pub(crate) fn has_enough_errors(&self) -> bool {
        self.notes.borrow().errors.len() >= ERRORS_MAX
    }

    /// The error at a place in the text. `found` is the place of the value to quote.
    pub(crate) fn error(
        &self,
        path: &str,
        at: Range<usize>,
        found: Option<Range<usize>>,
        message: impl Into<String>,
    ) -> ConfigError {
        let before = &self.text[..at.start.min(self.text.len())];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        ConfigError {
            file: self.file.clone(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            path: path.to_string(),
            found: found.map(|span| quoted(&self.text[span])),
            message: message.into(),
        }
    }

    /// Ends reading, with the errors of unknown keys.
    ///
    /// # Errors
    /// These, and everything that was noted.
    pub(crate) fn finish(self, unknown: Vec<ConfigError>) -> Result<(), ConfigErrors> {
        let Notes { errors, missing, .. } = self.notes.into_inner();
        let missing = missing.into_iter().map(|missing| missing.error);
        let errors: Vec<ConfigError> = unknown.into_iter().chain(errors).chain(missing).collect();
        if errors.is_empty() { Ok(()) } else { Err(ConfigErrors::in_order(errors)) }
    }
}

/// The path of a key in the table at `table`.
pub(crate) fn path_of(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_string() } else { format!("{table}.{key}") }
}

/// A text as errors quote it: on one line, of readable length.
pub fn quoted(text: &str) -> String {
    const LENGTH_MAX: usize = 60;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() <= LENGTH_MAX {
        return line;
    }
    line.chars().take(LENGTH_MAX).chain("…".chars()).collect()
}
