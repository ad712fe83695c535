//! What the examples' tests share. The examples read `config/` from the folder that they are run in.

use std::path::PathBuf;

/// The repository's root, where the examples are to be run.
pub fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}
