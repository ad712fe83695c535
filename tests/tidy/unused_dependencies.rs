//! Every dependency in a Cargo.toml is named in the code of that package.

use std::collections::BTreeSet;

use quote::ToTokens;

use crate::offence::Offence;
use crate::sources::Sources;
use crate::syntax::{parse, tokens};
use crate::workspace::{Package, Workspace, relative, repository};

/// Dependencies that no file of their package names.
pub fn unused(sources: &Sources, workspace: &Workspace) -> Vec<Offence> {
    let root = repository();
    let folder =
        |package: &Package| package.manifest_path.parent().map_or_else(String::new, |path| relative(path, &root));
    let folders: Vec<String> = workspace.packages.iter().map(|package| format!("{}/", folder(package))).collect();
    let mut offences = Vec::new();
    for (package, here) in workspace.packages.iter().zip(&folders) {
        // A package within another one's folder is compiled for itself.
        let is_inner = |file: &str| {
            folders.iter().any(|other| other.len() > here.len() && other.starts_with(here) && file.starts_with(other))
        };
        let files = sources.iter().filter(|(file, _)| file.starts_with(here) && !is_inner(file));
        let named: BTreeSet<String> = files.flat_map(|(file, text)| names(file, text)).collect();
        for dependency in &package.dependencies {
            let name = dependency.rename.as_ref().unwrap_or(&dependency.name).replace('-', "_");
            if !named.contains(&name) {
                let manifest = format!("{here}Cargo.toml");
                offences.push(Offence::new(&manifest, 1, format!("`{name}` is never used")));
            }
        }
    }
    offences
}

fn names(file: &str, text: &str) -> Vec<String> {
    tokens(parse(file, text).to_token_stream()).into_iter().map(|token| token.text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;
    use crate::workspace::Dependency;

    #[test]
    fn every_dependency_is_used() {
        let offences = unused(&Sources::of_repository(), &Workspace::of_repository());
        assert_none(&offences, "Remove it from this Cargo.toml.");
    }

    #[test]
    fn an_unused_dependency_is_found() {
        let dependency = |name: &str, rename: Option<&str>| Dependency {
            name: name.to_owned(),
            rename: rename.map(str::to_owned),
            kind: None,
            path: None,
        };
        let package = Package {
            name: "halfstep-gait".to_owned(),
            manifest_path: repository().join("crates/gait/Cargo.toml"),
            dependencies: vec![dependency("halfstep-model", Some("model")), dependency("csv", None)],
            targets: Vec::new(),
        };
        let sources = Sources::sample(&[("crates/gait/src/lib.rs", "//! Without csv.\nuse model::Joint;")]);
        let found = unused(&sources, &Workspace { packages: vec![package] });
        assert_eq!(found, [Offence::new("crates/gait/Cargo.toml", 1, "`csv` is never used")]);
    }
}
