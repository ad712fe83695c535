//! Errors in the files of an imported biped.

/// A file's text with its name.
#[derive(Clone, Copy, Debug)]
pub struct NamedText<'t> {
    /// The file's text.
    pub text: &'t str,
    /// The file's name for messages.
    pub file: &'t str,
}

/// Why a URDF or its map cannot be read as a biped: every mistake, one per line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ImportError(pub String);

impl ImportError {
    pub(super) fn new(mistakes: impl std::fmt::Display) -> Self {
        Self(mistakes.to_string())
    }
}

/// The errors of one file.
pub(super) struct FileErrors<'f> {
    pub file: &'f str,
    pub errors: Vec<String>,
}

impl FileErrors<'_> {
    pub(super) fn note(&mut self, error: impl std::fmt::Display) {
        self.errors.push(format!("{}: {error}", self.file));
    }

    pub(super) fn finish<T>(self, loaded: Option<T>) -> Result<T, ImportError> {
        match loaded {
            Some(loaded) if self.errors.is_empty() => Ok(loaded),
            _ => Err(ImportError(self.errors.join("\n"))),
        }
    }
}
