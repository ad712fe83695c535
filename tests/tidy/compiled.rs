//! Every Rust file is compiled: it is the root of a target or reachable from one through `mod`.

use std::collections::BTreeSet;

use crate::modules::Modules;
use crate::offence::Offence;
use crate::sources::Sources;

/// Files that cannot be reached through `mod` from any of the target roots `roots`.
pub fn left_out(sources: &Sources, roots: &[String]) -> Vec<Offence> {
    let crates: Vec<Modules> = roots.iter().map(|root| Modules::of_crate(sources, root, true)).collect();
    let compiled: BTreeSet<&str> = crates.iter().flat_map(Modules::files).collect();
    let left_out = sources.iter().filter(|(file, _)| !compiled.contains(file));
    left_out.map(|(file, _)| Offence::new(file, 1, "is never compiled")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Workspace, assert_none};

    #[test]
    fn every_rust_file_is_compiled() {
        let offences = left_out(&Sources::of_repository(), &Workspace::of_repository().roots());
        assert_none(&offences, "Name it in a `mod`, or as a target in Cargo.toml.");
    }

    #[test]
    fn a_file_without_a_mod_is_found() {
        let sources = Sources::sample(&[
            ("tests/main.rs", "mod walking;"),
            ("tests/walking/mod.rs", "mod walks_on;"),
            ("tests/walking/walks_on.rs", ""),
            ("tests/walking/forgotten.rs", ""),
        ]);
        let offences = left_out(&sources, &["tests/main.rs".to_owned()]);
        assert_eq!(offences, [Offence::new("tests/walking/forgotten.rs", 1, "is never compiled")]);
    }
}
