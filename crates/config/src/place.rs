//! Where a key stands in a file, so that its value can be refused there.

use std::ops::Range;

use crate::source::Source;

/// A key of a file, and where its value stands.
pub(crate) struct Place<'d> {
    /// The file's text, which takes the notes.
    pub source: &'d Source<'d>,
    /// Path of the key: `joint.right_knee.axis`.
    pub path: String,
    /// Bytes of the value; `None` when the key is absent.
    pub value: Option<Range<usize>>,
    /// Bytes of the table that holds the key: where the absence of the key is reported.
    pub table: Range<usize>,
}

impl Place<'_> {
    /// Notes that the value is wrong; `must` states what would be right.
    pub(crate) fn refuse(&self, must: &str) {
        if self.source.has_enough_errors() {
            return;
        }
        let at = self.value.clone().unwrap_or(self.table.clone());
        self.source.note(self.source.error(&self.path, at, self.value.clone(), must));
    }
}
