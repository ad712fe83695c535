//! A parsed file.

use toml::Spanned;
use toml::de::DeTable;

use crate::source::{ERRORS_MAX, Source};
use crate::unknown_keys::unknown_keys;
use crate::{ConfigErrors, Table};

/// Longest configuration file (bytes): ours have a hundredth of it.
const LENGTH_MAX: usize = 1 << 20;

/// A TOML file while it is being read.
pub struct Document<'t> {
    source: Source<'t>,
    root: Spanned<DeTable<'t>>,
}

impl<'t> Document<'t> {
    /// Parses a file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// Every place where the text is no TOML, duplicate keys included; a text of more than a megabyte.
    pub fn parse(text: &'t str, file: &str) -> Result<Self, ConfigErrors> {
        let source = Source::new(text, file);
        if text.len() > LENGTH_MAX {
            let message = format!("has {} bytes; a configuration file has at most {LENGTH_MAX}", text.len());
            return Err(ConfigErrors(vec![source.error("", 0..0, None, message)]));
        }
        let (root, errors) = DeTable::parse_recoverable(text);
        if errors.is_empty() {
            return Ok(Self { source, root });
        }
        let errors = errors.iter().take(ERRORS_MAX).map(|error| {
            let message = error.message().trim().replace('\n', ", ");
            source.error("", error.span().unwrap_or(0..0), None, format!("not valid TOML: {message}"))
        });
        Err(ConfigErrors::in_order(errors.collect()))
    }

    /// The table of the file's top level.
    pub fn root(&self) -> Table<'_> {
        Table::new(&self.source, String::new(), self.root.get_ref(), 0..0)
    }

    /// Returns what was loaded, if the file holds no mistake.
    ///
    /// # Errors
    /// Everything that was noted, and every key that was never looked up.
    pub fn finish<T>(self, loaded: T) -> Result<T, ConfigErrors> {
        let unknown = unknown_keys(&self.source, self.root.get_ref());
        self.source.finish(unknown).map(|()| loaded)
    }
}
