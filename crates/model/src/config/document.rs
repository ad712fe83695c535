//! A parsed file, and the notes taken while it is read.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use super::unknown_keys::unknown_keys;
use super::{ConfigError, ConfigErrors, Table};

/// A TOML file while it is being read.
pub struct Document<'t> {
    text: &'t str,
    file: String,
    root: Spanned<DeTable<'t>>,
    notes: RefCell<Notes>,
}

/// What reading has found so far.
#[derive(Default)]
pub(super) struct Notes {
    /// Wrong values.
    pub errors: Vec<ConfigError>,
    /// Keys that must be there and are not; kept apart because a misspelt key may turn out to be the missing one.
    pub missing: Vec<Missing>,
    /// The keys that each table (by its path) has been asked for.
    pub asked: BTreeMap<String, Vec<String>>,
}

/// A key that must be there and is not.
pub(super) struct Missing {
    pub table: String,
    pub key: String,
    pub error: ConfigError,
}

impl<'t> Document<'t> {
    /// Parses a file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// Every place where the text is no TOML, duplicate keys included.
    pub fn parse(text: &'t str, file: &str) -> Result<Self, ConfigErrors> {
        let (root, errors) = DeTable::parse_recoverable(text);
        let document = Self { text, file: file.to_string(), root, notes: RefCell::default() };
        if errors.is_empty() {
            return Ok(document);
        }
        for error in errors {
            let message = error.message().trim().replace('\n', ", ");
            document.note(document.error("", error.span().unwrap_or(0..0), None, format!("not valid TOML: {message}")));
        }
        Err(ConfigErrors(document.notes.into_inner().sorted()))
    }

    /// The table of the file's top level.
    pub fn root(&self) -> Table<'_> {
        Table::new(self, String::new(), self.root.get_ref(), 0..0)
    }

    /// Gives what was loaded.
    ///
    /// # Errors
    /// Everything that was noted, and every key that was not asked for.
    pub fn finish<T>(self, loaded: T) -> Result<T, ConfigErrors> {
        let mut errors = unknown_keys(&self, self.root.get_ref());
        errors.append(&mut self.notes.into_inner().sorted());
        errors.sort_by_key(|error| (error.line, error.column));
        if errors.is_empty() { Ok(loaded) } else { Err(ConfigErrors(errors)) }
    }

    pub(super) fn notes(&self) -> &RefCell<Notes> {
        &self.notes
    }

    pub(super) fn note(&self, error: ConfigError) {
        self.notes.borrow_mut().errors.push(error);
    }

    /// The error at a place in the text. `found` is the place of the value to quote.
    pub(super) fn error(
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
            found: found.map(|span| quote(&self.text[span])),
            message: message.into(),
        }
    }
}

impl Notes {
    fn sorted(self) -> Vec<ConfigError> {
        let mut errors = self.errors;
        errors.extend(self.missing.into_iter().map(|missing| missing.error));
        errors.sort_by_key(|error| (error.line, error.column));
        errors
    }
}

/// A value's text on one line of readable length.
fn quote(text: &str) -> String {
    const LENGTH_MAX: usize = 60;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() <= LENGTH_MAX {
        return line;
    }
    line.chars().take(LENGTH_MAX).chain("…".chars()).collect()
}
