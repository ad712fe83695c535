//! The files of a crate do not import each other in a circle, not even through re-exports.
//!
//! A file depends on another one if it names an item that the other one defines. Declaring a module and re-exporting
//! an item do not count: `lib.rs` may list the contents of the crate.

use std::collections::{BTreeMap, BTreeSet};

use crate::modules::{Found, Modules};
use crate::offence::Offence;
use crate::paths::{body_tokens, inline_paths};
use crate::sources::Sources;

/// For each file the files that it depends on, each with the first line and path that names one of its items.
type Dependencies = BTreeMap<String, BTreeMap<String, (usize, String)>>;

/// Import circles of the crate with root file `root`, one offence per circle.
pub fn circles(sources: &Sources, root: &str) -> Vec<Offence> {
    let dependencies = dependencies(&Modules::of_crate(sources, root, false));
    let reached: BTreeMap<&str, BTreeSet<&str>> =
        dependencies.keys().map(|file| (file.as_str(), reached_from(file, &dependencies))).collect();
    let mut reported = BTreeSet::new();
    let mut offences = Vec::new();
    for file in dependencies.keys() {
        let is_mutual = |other: &&str| reached.get(other).is_some_and(|back| back.contains(file.as_str()));
        let circle: BTreeSet<&str> = reached[file.as_str()].iter().copied().filter(is_mutual).collect();
        if circle.is_empty() || !reported.insert(circle.clone()) {
            continue;
        }
        let mut what = format!("{} files import each other in a circle:", circle.len());
        let within =
            circle.iter().flat_map(|from| dependencies[*from].iter().map(move |(to, named)| (from, to, named)));
        for (from, to, (line, name)) in within.filter(|(_, to, _)| circle.contains(to.as_str())) {
            what += &format!("\n    {from}:{line}: names `{name}` of {to}");
        }
        offences.push(Offence::new(file, 1, what));
    }
    offences
}

fn dependencies(modules: &Modules) -> Dependencies {
    let mut dependencies = Dependencies::new();
    for (index, module) in modules.0.iter().enumerate() {
        let mut depends = |segments: &[String], line: usize| {
            if let Some(Found::ItemOf(there)) = modules.resolve(index, segments)
                && modules.0[there].file != module.file
            {
                let on = dependencies.entry(module.file.clone()).or_default();
                on.entry(modules.0[there].file.clone()).or_insert_with(|| (line, segments.join("::")));
            }
        };
        let body = body_tokens(&module.items);
        for import in &module.imports {
            // A mere re-export is no dependency.
            if !import.is_public || body.iter().any(|token| token.text == import.name) {
                depends(&import.path.segments, import.path.line);
            }
        }
        for path in inline_paths(&body) {
            depends(&path.segments, path.line);
        }
    }
    dependencies
}

/// Files that `file` depends on, directly or through other files.
fn reached_from<'a>(file: &str, dependencies: &'a Dependencies) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open = vec![file];
    while let Some(file) = open.pop() {
        for to in dependencies.get(file).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(to.as_str()) {
                open.push(to);
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Workspace, assert_none};

    #[test]
    fn no_files_of_a_crate_import_each_other_in_a_circle() {
        let sources = Sources::of_repository();
        let roots = Workspace::of_repository().roots();
        let offences: Vec<Offence> = roots.iter().flat_map(|root| circles(&sources, root)).collect();
        assert_none(
            &offences,
            "Move what both files need to a file below them, or what one of them needs to the other.",
        );
    }

    /// `a` uses a type of `b` through the crate's re-export; `b` calls a function of `a` within a macro call.
    const A: &str = "use crate::B; pub fn a(_: B) {}";
    const B: &str = "pub struct B; pub fn b() { println!(\"{:?}\", crate::a::a(B)); }";

    #[test]
    fn a_circle_through_a_re_export_and_a_macro_is_found() {
        let root = "mod a; mod b; pub use b::B;";
        let sources = Sources::sample(&[("src/lib.rs", root), ("src/a.rs", A), ("src/b.rs", B)]);
        let offences = circles(&sources, "src/lib.rs");
        assert_eq!(offences.len(), 1, "{offences:?}");
        assert!(offences[0].what.contains("src/a.rs:1: names `crate::B` of src/b.rs"), "{offences:?}");
        assert!(offences[0].what.contains("src/b.rs:1: names `crate::a::a` of src/a.rs"), "{offences:?}");
    }

    #[test]
    fn a_circle_between_a_module_and_its_parent_is_found() {
        let parent = "mod child; pub use child::C; pub const LENGTH: f64 = 1.0; pub fn c() -> C { C }";
        let child = "use super::LENGTH; pub struct C; impl C { pub fn length(&self) -> f64 { LENGTH } }";
        let sources = Sources::sample(&[
            ("src/lib.rs", "pub mod parent;"),
            ("src/parent/mod.rs", parent),
            ("src/parent/child.rs", child),
        ]);
        assert_eq!(circles(&sources, "src/lib.rs").len(), 1);
    }

    #[test]
    fn what_tests_import_closes_no_circle() {
        let b = "pub struct B; #[cfg(test)] mod tests { use crate::a::a; #[test] fn t() { a(super::B) } }";
        let root = "mod a; mod b; pub use b::B;";
        let sources = Sources::sample(&[("src/lib.rs", root), ("src/a.rs", A), ("src/b.rs", b)]);
        assert_eq!(circles(&sources, "src/lib.rs"), []);
    }

    #[test]
    fn a_list_of_re_exports_closes_no_circle() {
        let root = "mod a; mod b; pub use a::a; pub use b::B;";
        let sources = Sources::sample(&[("src/lib.rs", root), ("src/a.rs", A), ("src/b.rs", "pub struct B;")]);
        assert_eq!(circles(&sources, "src/lib.rs"), []);
    }
}
