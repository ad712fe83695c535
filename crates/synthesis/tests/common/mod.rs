//! Where the statements find their files.

use std::path::PathBuf;

use config::Config;
use model::Mechanism;

/// A file of the `config` folder.
pub(crate) fn config(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../config").join(name)
}

/// The mechanism of a file of the `config` folder.
pub(crate) fn mechanism(name: &str) -> Mechanism {
    Mechanism::load(config(name)).unwrap_or_else(|errors| panic!("{errors}"))
}
