//! What a run began with.

use std::collections::BTreeMap;

/// What a run began with: enough to begin it again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// How it was started.
    pub notes: Vec<Note>,
    /// Files that were read, by the name they are found under again: `mechanism.toml`.
    pub files: Vec<(String, String)>,
}

/// Words under a name, such as how one of the processes was started; MCAP calls it metadata.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Note {
    /// Of what.
    pub name: String,
    /// Keys and values.
    pub words: BTreeMap<String, String>,
}

impl Note {
    /// Of keys and values.
    pub fn new<'w>(name: &str, words: impl IntoIterator<Item = (&'w str, String)>) -> Self {
        let words = words.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        Self { name: name.to_owned(), words }
    }
}

impl Origin {
    /// Adds a file, unless there is one with that name.
    pub fn attach(&mut self, name: String, text: String) {
        if self.file(&name).is_none() {
            self.files.push((name, text));
        }
    }

    /// The text of a file.
    pub fn file(&self, name: &str) -> Option<&str> {
        self.files.iter().find(|(file, _)| file == name).map(|(_, text)| text.as_str())
    }

    /// What a note says under a key.
    pub fn word(&self, note: &str, key: &str) -> Option<&str> {
        self.notes.iter().find(|there| there.name == note)?.words.get(key).map(String::as_str)
    }
}
