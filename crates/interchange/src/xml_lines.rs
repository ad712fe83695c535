//! XML text, written line by line.

use std::fmt::{Display, Write};

/// XML text, written line by line.
#[derive(Default)]
pub(crate) struct XmlLines {
    /// What has been written.
    pub(crate) text: String,
    depth: usize,
}

impl XmlLines {
    /// Writes a line, indented as deep as it is.
    pub(crate) fn line(&mut self, line: impl Display) {
        // A String takes everything.
        let _ = writeln!(self.text, "{:indent$}{line}", "", indent = 2 * self.depth);
    }

    /// Opens an element, given by name and attributes without brackets.
    pub(crate) fn open(&mut self, element: impl Display) {
        self.line(format_args!("<{element}>"));
        self.depth += 1;
    }

    /// Closes the element of this name, the last one opened.
    pub(crate) fn close(&mut self, name: &str) {
        self.depth -= 1;
        self.line(format_args!("</{name}>"));
    }
}

/// Numbers in full precision, separated by spaces.
pub(crate) fn numbers(values: &[f64]) -> String {
    // Adding zero turns -0 into 0.
    values.iter().map(|value| (value + 0.0).to_string()).collect::<Vec<_>>().join(" ")
}
