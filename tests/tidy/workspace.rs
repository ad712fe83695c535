//! The packages of the workspace with their targets and dependencies, from `cargo metadata`.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

/// The packages of the workspace.
#[derive(Clone, Debug, Deserialize)]
pub struct Workspace {
    /// All packages of the workspace.
    pub packages: Vec<Package>,
}

/// A package of the workspace.
#[derive(Clone, Debug, Deserialize)]
pub struct Package {
    /// Name of the package.
    pub name: String,
    /// Absolute path of its Cargo.toml.
    pub manifest_path: PathBuf,
    /// Direct dependencies, within the workspace or not.
    pub dependencies: Vec<Dependency>,
    /// Libraries, binaries, tests, benches and examples of the package.
    pub targets: Vec<Target>,
}

/// A dependency of a package.
#[derive(Clone, Debug, Deserialize)]
pub struct Dependency {
    /// Name of the package depended on.
    pub name: String,
    /// Name in code, if it is another one than that of the package.
    pub rename: Option<String>,
    /// `None` for a normal dependency, else `dev` or `build`.
    pub kind: Option<String>,
    /// Folder of the package, if it is in the workspace.
    pub path: Option<PathBuf>,
}

/// A compilation target of a package.
#[derive(Clone, Debug, Deserialize)]
pub struct Target {
    /// Absolute path of the root file.
    pub src_path: PathBuf,
}

/// The repository root.
pub fn repository() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).expect("tests/tidy lies in the repository").to_path_buf()
}

impl Workspace {
    /// Reads the workspace of this repository.
    ///
    /// # Panics
    /// If `cargo metadata` fails.
    pub fn of_repository() -> Self {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]).current_dir(repository());
        let output = cargo.output().expect("Cargo runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).expect("`cargo metadata` prints JSON")
    }

    /// Root files of all targets, relative to the repository root.
    pub fn roots(&self) -> Vec<String> {
        let repository = repository();
        let targets = self.packages.iter().flat_map(|package| &package.targets);
        targets.map(|target| relative(&target.src_path, &repository)).collect()
    }
}

/// `path` relative to `root`, separated by `/`.
///
/// # Panics
/// If it lies outside.
pub fn relative(path: &Path, root: &Path) -> String {
    let inside = path.strip_prefix(root).unwrap_or_else(|_| panic!("{} lies outside the repository", path.display()));
    inside.to_str().expect("file names are UTF-8").replace('\\', "/")
}
