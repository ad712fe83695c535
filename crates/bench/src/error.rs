//! Why something could not be measured.

/// Why something could not be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {cause}")]
pub struct BenchError {
    /// What was attempted.
    pub what: &'static str,
    /// Why it failed.
    pub cause: String,
}

impl BenchError {
    /// An error in attempting `what`, with the text of its cause.
    pub fn new(what: &'static str, cause: impl std::fmt::Display) -> Self {
        Self { what, cause: cause.to_string() }
    }
}
