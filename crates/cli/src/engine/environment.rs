//! The Python environment in which MuJoCo runs, made on first use.
//!
//! It lies in the user's cache folder, one per version of what is installed in it, together with the script that runs
//! there. Several walks may start at once: a lock lets one make it, the others wait.

use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

use indicatif::ProgressBar;

use crate::failure::Failure;

const REQUIREMENTS: &str = include_str!("../../../../tools/mujoco_plant/requirements.txt");
const PLANT: &str = include_str!("../../../../tools/mujoco_plant/plant.py");
/// The file that says that the environment is complete.
const READY: &str = "ready";
/// Oldest Python that the packages run on.
const PYTHON_MIN: (u32, u32) = (3, 11);
/// How much of what a failed command says is told.
const LINES_TOLD: usize = 6;

/// The command that runs the MuJoCo plant. Makes its environment if it is not there, and says so on stderr.
///
/// # Errors
/// As [`python`].
pub fn mujoco() -> Result<Command, Failure> {
    let mut command = python()?;
    // Named by its content: a walk with another version of it may be running.
    let script = folder()?.join(format!("plant-{:016x}.py", fingerprint(PLANT)));
    if fs::read_to_string(&script).ok().as_deref() != Some(PLANT) {
        let unfinished = script.with_extension(std::process::id().to_string());
        fs::write(&unfinished, PLANT)
            .and_then(|()| fs::rename(&unfinished, &script))
            .map_err(|error| Failure::new(format!("{}: {error}", script.display())))?;
    }
    // Nothing of the person's own Python settings shall change what is simulated.
    command.arg("-I").arg(script);
    Ok(command)
}

/// Python in the environment, which is made if it is not there.
///
/// # Errors
/// No suitable Python, no folder to write to, or the packages cannot be installed; each says what to do.
pub fn python() -> Result<Command, Failure> {
    let cannot = |path: &Path, error| Failure::new(format!("{}: {error}", path.display()));
    let folder = folder()?;
    fs::create_dir_all(&folder).map_err(|error| cannot(&folder, error))?;
    let lock = folder.join("lock");
    let _locked = File::create(&lock).and_then(|file| file.lock().map(|()| file)).map_err(|e| cannot(&lock, e))?;

    let python = folder.join("bin/python");
    if !is_installed() {
        install(&folder, &python)?;
        let ready = folder.join(READY);
        fs::write(&ready, REQUIREMENTS).map_err(|error| cannot(&ready, error))?;
    }
    Ok(Command::new(python))
}

/// Whether the environment is there.
pub fn is_installed() -> bool {
    folder().is_ok_and(|folder| folder.join(READY).exists())
}

/// Where the environment lies: one folder per list of packages.
fn folder() -> Result<PathBuf, Failure> {
    Ok(cache()?.join(format!("mujoco-{:016x}", fingerprint(REQUIREMENTS))))
}

/// Makes the environment.
fn install(folder: &Path, python: &Path) -> Result<(), Failure> {
    let system = system_python()?;
    eprintln!("MuJoCo's first use: making a Python environment in {}", folder.display());
    let packages: Vec<_> = REQUIREMENTS.split_whitespace().collect();
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(100));

    bar.set_message("creating the environment");
    let made = run(Command::new(&system).args(["-m", "venv"]).arg(folder))?;
    if !made.status.success() {
        bar.finish_and_clear();
        let said = last_lines(&made);
        return Err(Failure::new(format!(
            "cannot make a Python environment with `{system} -m venv`: {said}\nOn Debian it needs the package \
             python3-venv. `--plant rust` needs no Python."
        )));
    }
    bar.set_message(format!("installing {} (about 60 MB, once)", packages.join(", ")));
    let pip = ["-m", "pip", "install", "--disable-pip-version-check", "--no-input"];
    let installed = run(Command::new(python).args(pip).args(&packages))?;
    bar.finish_and_clear();
    if !installed.status.success() {
        let said = last_lines(&installed);
        return Err(Failure::new(format!(
            "cannot install {}: {said}\nIs the Python package registry reachable? Try again with \
             `{} -m pip install {}`, or walk with `--plant rust`.",
            packages.join(" and "),
            python.display(),
            packages.join(" ")
        )));
    }
    eprintln!("installed {}", packages.join(" and "));
    Ok(())
}

/// A Python that is new enough: `HALFSTEP_PYTHON`, or `python3`.
fn system_python() -> Result<String, Failure> {
    let program = std::env::var("HALFSTEP_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let (major, minor) = PYTHON_MIN;
    let wanted = format!(
        "MuJoCo needs Python {major}.{minor} or newer; set HALFSTEP_PYTHON to one, or walk with `--plant rust`"
    );
    let asked = Command::new(&program).args(["-c", "import sys; print(*sys.version_info[:2])"]).output();
    let told = asked.map_err(|error| Failure::new(format!("cannot run `{program}`: {error}. {wanted}")))?;
    let told = String::from_utf8_lossy(&told.stdout).trim().to_owned();
    let mut numbers = told.split(' ').map(|number| number.parse::<u32>().unwrap_or(0));
    let version = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if version < PYTHON_MIN {
        let is = if version.0 == 0 { "no Python".to_owned() } else { format!("Python {}.{}", version.0, version.1) };
        return Err(Failure::new(format!("`{program}` is {is}. {wanted}")));
    }
    Ok(program)
}

fn run(command: &mut Command) -> Result<Output, Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    command.output().map_err(|error| Failure::new(format!("cannot run `{program}`: {error}")))
}

/// The end of what a command said, on lines of its own.
fn last_lines(output: &Output) -> String {
    let said = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    let lines: Vec<_> = said.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[lines.len().saturating_sub(LINES_TOLD)..].iter().map(|line| format!("\n  {line}")).collect()
}

/// The user's cache folder for this program.
fn cache() -> Result<PathBuf, Failure> {
    let own = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let cache = own("XDG_CACHE_HOME").or_else(|| Some(own("HOME")?.join(".cache")));
    let no_home = || Failure::new("MuJoCo needs a folder for its Python environment: set HOME or XDG_CACHE_HOME");
    Ok(cache.ok_or_else(no_home)?.join("halfstep"))
}

/// Tells texts apart; it need not be the same on another machine.
fn fingerprint(text: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}
