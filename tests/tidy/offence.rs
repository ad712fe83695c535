//! Violations of an invariant, and assertions that list all of them.

use std::fmt::{Display, Formatter, Result};

/// A violation of an invariant at some place in the sources.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Offence {
    /// Path of the file relative to the repository root.
    pub file: String,
    /// Line number, from 1.
    pub line: usize,
    /// Description of the violation.
    pub what: String,
}

impl Offence {
    /// An offence at `file:line`.
    pub fn new(file: &str, line: usize, what: impl Into<String>) -> Self {
        Self { file: file.to_owned(), line, what: what.into() }
    }
}

impl Display for Offence {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        write!(formatter, "{}:{}: {}", self.file, self.line, self.what)
    }
}

/// Fails if there are offences, with a list of all of them and `remedy`: what to do about them.
#[track_caller]
pub fn assert_none(offences: &[Offence], remedy: &str) {
    assert!(offences.is_empty(), "{}\n{remedy}", list(offences));
}

fn list(offences: &[Offence]) -> String {
    let mut lines: Vec<String> = offences.iter().map(Offence::to_string).collect();
    lines.sort();
    lines.join("\n")
}
