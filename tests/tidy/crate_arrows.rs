//! Crates depend on each other downward only, as a table states.
//!
//! `[dev-dependencies]` are not restricted.

use std::collections::{BTreeMap, BTreeSet};

use crate::offence::Offence;
use crate::workspace::{Package, Workspace};

/// A crate and the crates that it may depend on, from the top layer down.
///
/// `ALL` stands for every row below, `BASE` for the crates of [`BASE`].
pub type Table<'a> = &'a [(&'a str, &'a str)];

/// The lowest crates, on which nearly all others may depend.
pub const BASE: &str = "interface model signal config";

/// The allowed dependencies of this workspace. A new crate needs a row.
pub const ARROWS: Table<'_> = &[
    ("cli", "ALL"),
    ("bench", "ALL"),
    ("python", "BASE controller plant robots interchange dialogue lockstep"),
    ("web", "BASE controller plant paper robots interchange scene dialogue lockstep"),
    ("lockstep", "BASE controller plant pattern gait robots interchange"),
    ("view", "BASE operator plant record wire runtime scene dialogue"),
    ("teleop", "BASE operator wire runtime"),
    ("doctor", "BASE controller plant interchange pattern gait dynamics"),
    ("node", "BASE controller plant wire runtime record interchange gait dynamics"),
    ("operator", "BASE wire runtime dialogue"),
    ("dialogue", "BASE"),
    ("scene", "BASE plant dynamics"),
    ("paper", "BASE charts synthesis gait dynamics"),
    ("plots", "BASE charts record wire synthesis gait dynamics"),
    ("charts", "BASE"),
    ("robots", "BASE interchange synthesis gait"),
    ("interchange", "BASE plant dynamics"),
    ("synthesis", "BASE gait dynamics"),
    ("record", "BASE wire"),
    ("controller", "BASE pattern stabilizer gait dynamics"),
    ("pattern", "BASE gait dynamics"),
    ("stabilizer", "BASE dynamics"),
    ("plant", "BASE dynamics"),
    ("wire", "BASE"),
    ("gait", "BASE"),
    ("dynamics", "BASE"),
    ("runtime", ""),
    ("interface", "model signal config"),
    ("model", "signal config"),
    ("signal", ""),
    ("config", ""),
];

/// Crates that must not depend on each other, not even through a third crate.
pub const APART: &[&str] = &["controller", "plant", "wire", "runtime"];

/// Name of a crate in code: the package name without `halfstep-`.
fn crate_name(package: &str) -> &str {
    if package == "halfstep" { "cli" } else { package.strip_prefix("halfstep-").unwrap_or(package) }
}

/// Every crate of `crates/` with the workspace crates that it depends on.
pub fn arrows(workspace: &Workspace) -> BTreeMap<String, Vec<String>> {
    let on = |package: &Package| {
        let normal = package.dependencies.iter().filter(|dependency| dependency.kind.is_none());
        let ours = normal.filter(|dependency| dependency.path.is_some());
        ours.map(|dependency| crate_name(&dependency.name).to_owned()).collect()
    };
    let is_crate = |package: &&Package| {
        package
            .manifest_path
            .ancestors()
            .nth(2)
            .and_then(|folder| folder.file_name())
            .is_some_and(|name| name == "crates")
    };
    let crates = workspace.packages.iter().filter(is_crate);
    crates.map(|package| (crate_name(&package.name).to_owned(), on(package))).collect()
}

/// Dependencies that `table` does not allow, and crates without a row.
pub fn forbidden(arrows: &BTreeMap<String, Vec<String>>, table: Table<'_>) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (name, dependencies) in arrows {
        let manifest = format!("crates/{name}/Cargo.toml");
        let Some(row) = table.iter().position(|(row, _)| row == name) else {
            offences.push(Offence::new(&manifest, 1, format!("`{name}` is not in the table: give it a row")));
            continue;
        };
        let allowed = allowed(table, row);
        for on in dependencies.iter().filter(|on| !allowed.contains(on.as_str())) {
            offences.push(Offence::new(&manifest, 1, format!("`{name}` must not depend on `{on}`")));
        }
    }
    offences
}

/// Names of the crates that the crate of `row` may depend on.
fn allowed<'a>(table: Table<'a>, row: usize) -> BTreeSet<&'a str> {
    let below = || table[row + 1..].iter().map(|(name, _)| *name);
    let expanded = |name: &'a str| match name {
        "ALL" => below().collect(),
        "BASE" => BASE.split(' ').collect(),
        name => vec![name],
    };
    table[row].1.split_whitespace().flat_map(expanded).collect()
}

/// Pairs of crates of `apart` that depend on each other, directly or through other crates.
pub fn not_apart(arrows: &BTreeMap<String, Vec<String>>, apart: &[&str]) -> Vec<Offence> {
    let mut offences = Vec::new();
    for from in apart {
        let (mut seen, mut open) = (BTreeSet::new(), vec![*from]);
        while let Some(name) = open.pop() {
            for on in arrows.get(name).into_iter().flatten() {
                if seen.insert(on.as_str()) {
                    open.push(on);
                }
            }
        }
        for to in apart.iter().filter(|to| *to != from && seen.contains(*to)) {
            let what = format!("`{from}` must not see `{to}`, not even through another crate");
            offences.push(Offence::new(&format!("crates/{from}/Cargo.toml"), 1, what));
        }
    }
    offences
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    const REMEDY: &str = "Move the code to the crate that may depend on what it needs, or change the table in \
                          tests/tidy/crate_arrows.rs and say why in the commit.";

    #[test]
    fn crates_depend_on_each_other_only_as_the_table_allows() {
        assert_none(&forbidden(&arrows(&Workspace::of_repository()), ARROWS), REMEDY);
    }

    #[test]
    fn controller_plant_wire_and_runtime_never_see_each_other() {
        assert_none(&not_apart(&arrows(&Workspace::of_repository()), APART), REMEDY);
    }

    #[test]
    fn rows_lead_downward_only() {
        for (row, (name, _)) in ARROWS.iter().enumerate() {
            let below: BTreeSet<&str> = ARROWS[row + 1..].iter().map(|(name, _)| *name).collect();
            let upward: Vec<&str> = allowed(ARROWS, row).difference(&below).copied().collect();
            assert!(upward.is_empty(), "the row of `{name}` must stand above the rows of {upward:?}");
        }
    }

    fn sample(arrows: &[(&str, &[&str])]) -> BTreeMap<String, Vec<String>> {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        arrows.iter().map(|(name, on)| ((*name).to_owned(), owned(on))).collect()
    }

    #[test]
    fn an_upward_dependency_and_a_crate_without_a_row_are_found() {
        let arrows = sample(&[("dynamics", &["model", "gait"]), ("extra", &[])]);
        assert_eq!(
            forbidden(&arrows, ARROWS),
            [
                Offence::new("crates/dynamics/Cargo.toml", 1, "`dynamics` must not depend on `gait`"),
                Offence::new("crates/extra/Cargo.toml", 1, "`extra` is not in the table: give it a row"),
            ]
        );
    }

    #[test]
    fn a_crate_seen_through_another_one_is_found() {
        let arrows = sample(&[("controller", &["gait"]), ("gait", &["runtime"]), ("runtime", &[])]);
        assert_eq!(not_apart(&arrows, APART).len(), 1);
    }
}
