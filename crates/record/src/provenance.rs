//! Where a recording comes from: how the run was started, and the files that it read.

use std::collections::BTreeMap;

/// How a run was started and which files it read: enough to repeat it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// How each process was started.
    pub metadata: Vec<Metadata>,
    /// Name and text of each file that was read: `mechanism.toml`.
    pub files: Vec<(String, String)>,
}

/// A named set of keys and values, such as how one of the processes was started.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Metadata {
    /// What the entries describe: `controller`.
    pub name: String,
    /// The keys and values.
    pub entries: BTreeMap<String, String>,
}

impl Metadata {
    /// Metadata of this name with these keys and values.
    pub fn new<'w>(name: &str, entries: impl IntoIterator<Item = (&'w str, String)>) -> Self {
        let entries = entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        Self { name: name.to_owned(), entries }
    }
}

impl Provenance {
    /// Adds a file, unless there is one with that name already.
    pub fn attach(&mut self, name: String, text: String) {
        if self.file(&name).is_none() {
            self.files.push((name, text));
        }
    }

    /// The text of the file with this name.
    pub fn file(&self, name: &str) -> Option<&str> {
        self.files.iter().find(|(file, _)| file == name).map(|(_, text)| text.as_str())
    }

    /// The value of a key in the metadata with this name.
    pub fn entry(&self, name: &str, key: &str) -> Option<&str> {
        self.metadata.iter().find(|metadata| metadata.name == name)?.entries.get(key).map(String::as_str)
    }
}
