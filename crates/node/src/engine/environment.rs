//! The Python environment in which MuJoCo runs, created on first use.
//!
//! It lies in the user's cache folder, one for each list of packages, together with the program that runs in it. If
//! several walks start at once, a lock lets one create it while the others wait.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use super::mujoco_program;
use super::text_hash::text_hash;
use crate::tell::{is_quiet, tell};

const REQUIREMENTS: &str = include_str!("../../../../tools/mujoco_plant/requirements.txt");
/// All packages that they need, each with its version and the hashes of its files.
const LOCK: &str = include_str!("../../../../tools/mujoco_plant/requirements.lock");
/// Name of the file that exists once the environment is complete.
const READY: &str = "ready";
/// Oldest Python that the packages run on.
const PYTHON_MIN: (u32, u32) = (3, 11);
/// Installs exactly the listed files, whatever the user's settings of pip and Python say, and builds nothing.
const PIP: [&str; 11] = [
    "-I",
    "-m",
    "pip",
    "install",
    "--isolated",
    "--disable-pip-version-check",
    "--no-input",
    "--no-deps",
    "--require-hashes",
    "--only-binary=:all:",
    "-r",
];
/// How many of the last lines of a failed command's output an error shows.
const LINES_SHOWN: usize = 6;

/// Why there is no Python environment to run MuJoCo in, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct EnvironmentError(String);

/// The command that runs the MuJoCo plant. Creates its environment if necessary, with messages on stderr.
///
/// # Errors
/// As [`python`].
pub fn mujoco() -> Result<Command, EnvironmentError> {
    let mut command = python()?;
    let program = mujoco_program::write(&folder()?)
        .map_err(|(path, error)| EnvironmentError(format!("{}: {error}", path.display())))?;
    // The user's Python settings must not change the simulation.
    command.arg("-I").arg(program);
    Ok(command)
}

/// The command that runs Python in the environment, which is created if necessary.
///
/// # Errors
/// There is no suitable Python, no folder to write to, or the packages cannot be installed. The text says what to do.
pub fn python() -> Result<Command, EnvironmentError> {
    let cannot = |path: &Path, error| EnvironmentError(format!("{}: {error}", path.display()));
    let folder = folder()?;
    fs::create_dir_all(&folder).map_err(|error| cannot(&folder, error))?;
    let lock = folder.join("lock");
    let _locked = File::create(&lock).and_then(|file| file.lock().map(|()| file)).map_err(|e| cannot(&lock, e))?;

    let python = folder.join("bin/python");
    if !is_installed() {
        install(&folder, &python)?;
        let ready = folder.join(READY);
        fs::write(&ready, LOCK).map_err(|error| cannot(&ready, error))?;
    }
    Ok(Command::new(python))
}

/// Whether the environment exists. After an upgrade of the system its Python may be gone.
pub fn is_installed() -> bool {
    folder().is_ok_and(|folder| folder.join(READY).exists() && folder.join("bin/python").exists())
}

/// Folder of the environment: one for each list of packages.
fn folder() -> Result<PathBuf, EnvironmentError> {
    Ok(cache()?.join(format!("mujoco-{:016x}", text_hash(LOCK))))
}

/// Creates the environment.
fn install(folder: &Path, python: &Path) -> Result<(), EnvironmentError> {
    let system = system_python()?;
    tell(format_args!("MuJoCo's first use: making a Python environment in {}", folder.display()));
    let packages: Vec<_> = REQUIREMENTS.split_whitespace().collect();
    let bar = if is_quiet() { ProgressBar::hidden() } else { ProgressBar::new_spinner() };
    // The template is a constant and valid.
    let style = ProgressStyle::with_template("{spinner} {wide_msg} {elapsed}");
    let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.enable_steady_tick(Duration::from_millis(100));

    bar.set_message("creating the environment");
    // Those of a Python that is gone; nothing is left of an attempt that was interrupted.
    for former in ["bin", "lib"] {
        let _ = fs::remove_dir_all(folder.join(former));
    }
    let made = run(Command::new(&system).args(["-I", "-m", "venv"]).arg(folder))?;
    if !made.status.success() {
        bar.finish_and_clear();
        let said = last_lines(&made);
        return Err(EnvironmentError(format!(
            "cannot make a Python environment with `{system} -m venv`: {said}\nOn Debian it needs the package \
             python3-venv. `--plant rust` needs no Python."
        )));
    }
    let installing = format!("installing {} (about 60 MB, once)", packages.join(", "));
    // Where there is no terminal the line is all that is seen of it.
    if bar.is_hidden() {
        tell(&installing);
    }
    bar.set_message(installing);
    let lock = folder.join("requirements.lock");
    fs::write(&lock, LOCK).map_err(|error| EnvironmentError(format!("{}: {error}", lock.display())))?;
    let installed = run(Command::new(python).args(PIP).arg(&lock))?;
    bar.finish_and_clear();
    if !installed.status.success() {
        let said = last_lines(&installed);
        return Err(EnvironmentError(format!(
            "cannot install {}: {said}\nIs the Python package registry reachable? Try again with \
             `{} {} {}`, or walk with `--plant rust`.",
            packages.join(" and "),
            python.display(),
            PIP.join(" "),
            lock.display()
        )));
    }
    tell(format_args!("installed {}", packages.join(" and ")));
    Ok(())
}

/// The name of a Python that is new enough: `HALFSTEP_PYTHON`, or `python3`.
fn system_python() -> Result<String, EnvironmentError> {
    let program = std::env::var("HALFSTEP_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let (major, minor) = PYTHON_MIN;
    let wanted = format!(
        "MuJoCo needs Python {major}.{minor} or newer; set HALFSTEP_PYTHON to one, or walk with `--plant rust`"
    );
    let output = Command::new(&program).args(["-c", "import sys; print(*sys.version_info[:2])"]).output();
    let output = output.map_err(|error| EnvironmentError(format!("cannot run `{program}`: {error}. {wanted}")))?;
    let printed = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    let mut numbers = printed.split(' ').map(|number| number.parse::<u32>().unwrap_or(0));
    let version = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if version < PYTHON_MIN {
        let is = if version.0 == 0 { "no Python".to_owned() } else { format!("Python {}.{}", version.0, version.1) };
        return Err(EnvironmentError(format!("`{program}` is {is}. {wanted}")));
    }
    Ok(program)
}

fn run(command: &mut Command) -> Result<Output, EnvironmentError> {
    let program = command.get_program().to_string_lossy().into_owned();
    command.output().map_err(|error| EnvironmentError(format!("cannot run `{program}`: {error}")))
}

/// The last lines of a command's output, each on a line of its own.
fn last_lines(output: &Output) -> String {
    let said = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    let lines: Vec<_> = said.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[lines.len().saturating_sub(LINES_SHOWN)..].iter().map(|line| format!("\n  {line}")).collect()
}

/// The user's cache folder for this program.
///
/// # Errors
/// Neither HOME nor XDG_CACHE_HOME is set.
pub fn cache() -> Result<PathBuf, EnvironmentError> {
    let own = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let cache = own("XDG_CACHE_HOME").or_else(|| Some(own("HOME")?.join(".cache")));
    let no_home = "no folder for what is kept between runs: set HOME or XDG_CACHE_HOME";
    Ok(cache.ok_or_else(|| EnvironmentError(no_home.to_owned()))?.join("halfstep"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_package_is_locked_with_its_hashes() {
        for package in REQUIREMENTS.split_whitespace() {
            assert!(LOCK.contains(&format!("{package} \\\n    --hash=sha256:")), "{package} is not in the lock file");
        }
    }
}
