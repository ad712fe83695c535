//! Invariants of the source tree, each kept by a test: `cargo test -p halfstep-tidy`.
//!
//! One check per file. A check takes sources and returns offences. Its tests run it on the repository, where they list
//! every offence as `file:line: what is wrong`, and on a small bad sample, which proves that the check can fail.

pub mod compiled;
pub mod crate_arrows;
pub mod design_references;
pub mod first_line;
pub mod import_circles;
pub mod line_length;
pub mod modules;
pub mod offence;
pub mod paths;
pub mod restricted_names;
pub mod side_arms;
pub mod sources;
pub mod syntax;
pub mod system_mathematics;
pub mod test_names;
pub mod type_names;
pub mod units;
pub mod unused_dependencies;
pub mod vague_names;
pub mod workspace;

pub use offence::{Offence, assert_none};
pub use sources::Sources;
pub use workspace::Workspace;
