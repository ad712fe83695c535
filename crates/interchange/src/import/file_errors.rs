//! Errors in the files of an imported biped.

/// A file's text with its name.
#[derive(Clone, Copy, Debug)]
pub struct NamedText<'t> {
    /// The file's text.
    pub text: &'t str,
    /// The file's name for messages.
    pub file: &'t str,
}

/// Why a URDF or its map cannot be read as a biped: every mistake, one per line; never empty.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ImportError(pub String);

impl ImportError {
    pub(super) fn new(mistakes: impl std::fmt::Display) -> Self {
        Self(mistakes.to_string())
    }
}

/// Most errors that are told of one file: nobody reads more.
const ERRORS_MAX: usize = 100;

/// The errors of one file, with their lines.
pub(super) struct FileErrors<'f> {
    file: &'f str,
    errors: Vec<(usize, String)>,
}

impl<'f> FileErrors<'f> {
    /// No errors yet; `file` is the file's name for messages.
    pub(super) fn new(file: &'f str) -> Self {
        Self { file, errors: Vec::new() }
    }

    /// Notes an error of the file as a whole.
    pub(super) fn note(&mut self, error: impl std::fmt::Display) {
        self.errors.push((0, format!("{}: {error}", self.file)));
    }

    /// Notes an error at a line.
    pub(super) fn note_at(&mut self, line: usize, error: impl std::fmt::Display) {
        self.errors.push((line, format!("{}:{line}: {error}", self.file)));
    }

    /// Whether nothing has been noted.
    pub(super) fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// Returns what was loaded.
    ///
    /// # Errors
    /// Everything noted, in the order of the lines.
    pub(super) fn finish<T>(mut self, loaded: Option<T>) -> Result<T, ImportError> {
        match loaded {
            Some(loaded) if self.errors.is_empty() => Ok(loaded),
            _ if self.errors.is_empty() => Err(ImportError::new(format!("{}: cannot be read as a biped", self.file))),
            _ => {
                self.errors.sort_by_key(|(line, _)| *line);
                self.errors.dedup();
                let more = self.errors.len().saturating_sub(ERRORS_MAX);
                let texts = self.errors.into_iter().take(ERRORS_MAX).map(|(_, text)| text);
                let more = (more > 0).then(|| format!("{}: and {more} errors more", self.file));
                Err(ImportError(texts.chain(more).collect::<Vec<_>>().join("\n")))
            }
        }
    }
}
