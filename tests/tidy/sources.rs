//! The Rust files of the repository or of a sample, by path.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Texts of Rust files by their path relative to the repository root, separated by `/`.
#[derive(Clone, Debug, Default)]
pub struct Sources(pub BTreeMap<String, String>);

impl Sources {
    /// All `.rs` files of the repository.
    ///
    /// # Panics
    /// If a file cannot be read.
    pub fn of_repository() -> Self {
        let mut sources = Self::default();
        sources.collect(&crate::workspace::repository(), "");
        assert!(sources.0.len() > 100, "only {} files found", sources.0.len());
        sources
    }

    /// A sample of `(path, text)` pairs.
    pub fn sample(files: &[(&str, &str)]) -> Self {
        Self(files.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect())
    }

    /// Path and text of all files.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }

    /// Path and text of the product's files: `crates/*/src`.
    pub fn of_crates(&self) -> impl Iterator<Item = (&str, &str)> {
        self.iter().filter(|(path, _)| {
            let mut parts = path.split('/');
            parts.next() == Some("crates") && parts.nth(1) == Some("src")
        })
    }

    fn collect(&mut self, root: &Path, folder: &str) {
        for entry in fs::read_dir(root.join(folder)).unwrap_or_else(|error| panic!("{folder}: {error}")) {
            let entry = entry.unwrap_or_else(|error| panic!("{folder}: {error}"));
            let name = entry.file_name().into_string().expect("file names are UTF-8");
            let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                if !name.starts_with('.') && path != "target" {
                    self.collect(root, &path);
                }
            } else if name.ends_with(".rs") {
                let text = fs::read_to_string(root.join(&path)).unwrap_or_else(|error| panic!("{path}: {error}"));
                self.0.insert(path, text);
            }
        }
    }
}
