//! Spoilt files through the command line: whatever a file holds, the command ends with words, soon, and with little
//! memory.
//!
//! The committed configuration, a short recording, an exported robot and its map are spoilt at random, one file at a
//! time, and given to the commands that read them. What a command must not do with a file is kept with that file.

use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use halfstep_tests::repository;
use model::Joint;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

use crate::cores::on_all_cores;
use crate::spoiling::spoilt;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Number of spoilt files
    #[arg(long, default_value_t = 5000)]
    count: usize,
    /// Of all that is random
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// The halfstep command [default: the one beside this]
    #[arg(long, value_name = "FILE")]
    binary: Option<PathBuf>,
    /// Folder in which files are kept that did what must not happen
    #[arg(long, value_name = "DIR", default_value = "target/spoilt")]
    keep: PathBuf,
}

/// The committed files that `check` reads.
const CHECKED: [&str; 10] = [
    "mechanism.toml",
    "controller.toml",
    "plant.toml",
    "realtime.toml",
    "nominal_half_step.csv",
    "disturbances_demo.toml",
    "commands_demo.jsonl",
    "recorded_leg_shape.csv",
    "paper.toml",
    "scenarios/figure_04.toml",
];
/// What reads the others; the last word is the spoilt file.
const KINDS: usize = CHECKED.len() + 3;

/// A command may compute so long; most of it is spent by a walk's loops, which wait actively.
const CPU_MAX: Duration = Duration::from_secs(2);
/// What takes so long hangs, however loaded the machine is.
const WALL_MAX: Duration = Duration::from_secs(30);
/// Memory that a command may have at most (kB).
const MEMORY_MAX: u64 = 500 << 10;
const POLL_INTERVAL: Duration = Duration::from_millis(2);

/// How a command ended.
#[derive(Clone, Copy, Default)]
struct Ended {
    /// Exit code; as of a shell if a signal ended it; `None` if it had to be killed.
    code: Option<i32>,
    cpu: Duration,
    memory_kb: u64,
}

/// What became of one spoilt file.
#[derive(Clone, Default)]
struct Outcome {
    kind: usize,
    is_taken: bool,
    panicked: bool,
    is_slow: bool,
    is_large: bool,
    slowest: Duration,
    largest_kb: u64,
}

pub(crate) fn survey(options: &Options) -> bool {
    let beside = || std::env::current_exe().map(|survey| survey.with_file_name("halfstep"));
    let binary = options.binary.clone().unwrap_or_else(|| beside().expect("this program has a path"));
    assert!(binary.exists(), "{} is missing: cargo build -p halfstep, or --binary", binary.display());
    let base = std::env::temp_dir().join(format!("spoilt-{}", std::process::id()));
    let originals = Originals::make(&binary, &base);
    let outcomes = on_all_cores(options.count, |index| originals.spoil_one(options, index));
    let _ = fs::remove_dir_all(&base);

    let name = |kind: usize| CHECKED.get(kind).copied().unwrap_or(["run.mcap", "robot.urdf", "map.toml"][kind % 3]);
    let row = |name: String, of: &[&Outcome]| {
        let count = |what: fn(&Outcome) -> bool| of.iter().filter(|outcome| what(outcome)).count().to_string();
        let slowest = of.iter().map(|outcome| outcome.slowest.as_secs_f64()).fold(0.0, f64::max);
        let largest = of.iter().map(|outcome| outcome.largest_kb).max().unwrap_or(0);
        vec![
            name,
            of.len().to_string(),
            count(|outcome| outcome.is_taken),
            count(|outcome| outcome.panicked),
            count(|outcome| outcome.is_slow),
            count(|outcome| outcome.is_large),
            format!("{slowest:.1}"),
            (largest >> 10).to_string(),
        ]
    };
    let mut rows: Vec<Vec<String>> = (0..KINDS)
        .map(|kind| {
            let of: Vec<&Outcome> = outcomes.iter().filter(|outcome| outcome.kind == kind).collect();
            row(name(kind).to_owned(), &of)
        })
        .collect();
    rows.push(row("all".to_owned(), &outcomes.iter().collect::<Vec<_>>()));
    table::print(&["file", "spoilt", "taken", "panics", "> 2 s", "> 500 MB", "CPU max [s]", "memory max [MB]"], &rows);
    let passed = outcomes.iter().all(|outcome| !(outcome.panicked || outcome.is_slow || outcome.is_large));
    if !passed {
        println!("kept in {}", options.keep.display());
    }
    passed
}

/// The files as they are, and where they are spoilt.
struct Originals<'b> {
    binary: &'b Path,
    base: &'b Path,
}

impl<'b> Originals<'b> {
    /// Copies the configuration, and makes recording, robot and map.
    fn make(binary: &'b Path, base: &'b Path) -> Self {
        let originals = Self { binary, base };
        copy_folder(&repository().join("config"), &base.join("config"));
        let walk = "walk --lockstep --for 300ms --out run";
        assert_eq!(originals.run(base, walk, &[]).code, Some(0), "{walk}");
        let export = Command::new(binary).args(["export", "urdf"]).current_dir(base).output().expect("the command");
        fs::write(base.join("robot.urdf"), export.stdout).expect("a file");
        fs::write(base.join("map.toml"), map()).expect("a file");
        let import = "import robot.urdf --map map.toml --out imported";
        assert_eq!(originals.run(base, import, &[]).code, Some(0), "{import}");
        originals
    }

    fn spoil_one(&self, options: &Options, index: usize) -> Outcome {
        let mut random = StdRng::seed_from_u64(options.seed.wrapping_mul(1 << 32).wrapping_add(index as u64));
        let kind = random.random_range(0..KINDS);
        let folder = self.base.join(index.to_string());
        let file = match CHECKED.get(kind) {
            Some(name) => {
                copy_folder(&self.base.join("config"), &folder.join("config"));
                folder.join("config").join(name)
            }
            None => folder.join(["run.mcap", "robot.urdf", "map.toml"][kind % 3]),
        };
        let original = match file.file_name().and_then(|name| name.to_str()) {
            Some("run.mcap") => self.base.join("run/run.mcap"),
            Some(name @ ("robot.urdf" | "map.toml")) => self.base.join(name),
            _ => file.clone(),
        };
        fs::create_dir_all(&folder).expect("a folder");
        let bytes = spoilt(&fs::read(original).expect("the original"), &mut random);
        fs::write(&file, &bytes).expect("a file");

        let mut outcome = Outcome { kind, ..Outcome::default() };
        let mut run = |words: &str, files: &[&Path]| {
            let ended = self.run(&folder, words, files);
            let panicked = !matches!(ended.code, Some(0..=2) | None);
            let is_slow = ended.code.is_none() || ended.cpu > CPU_MAX;
            let is_large = ended.memory_kb > MEMORY_MAX;
            if panicked || is_slow || is_large {
                self.keep(options, index, words, &file, &ended);
            }
            outcome.panicked |= panicked;
            outcome.is_slow |= is_slow;
            outcome.is_large |= is_large;
            outcome.slowest = outcome.slowest.max(ended.cpu);
            outcome.largest_kb = outcome.largest_kb.max(ended.memory_kb);
            outcome.is_taken |= ended.code == Some(0);
            ended.code == Some(0)
        };
        let [urdf, map] = ["robot.urdf", "map.toml"].map(|name| {
            let spoilt = folder.join(name);
            if spoilt.exists() { spoilt } else { self.base.join(name) }
        });
        match file.file_name().and_then(|name| name.to_str()) {
            Some("run.mcap") => {
                run("plot --csv --out pictures", &[&file]);
                run("replay", &[&file]);
            }
            Some("robot.urdf" | "map.toml") => {
                run("import --out robot --map", &[&map, &urdf]);
            }
            _ => {
                let is_good = run("check", &[]);
                let walk = "walk --lockstep --for 200ms --out run";
                match file.file_name().and_then(|name| name.to_str()) {
                    Some("disturbances_demo.toml") if is_good => {
                        run(&format!("{walk} --disturbances"), &[&file]);
                    }
                    Some("commands_demo.jsonl") if is_good => {
                        run(&format!("{walk} --commands"), &[&file]);
                    }
                    Some("recorded_leg_shape.csv" | "paper.toml" | "figure_04.toml") => {}
                    _ if is_good => {
                        run(walk, &[]);
                    }
                    _ => {}
                }
            }
        }
        let _ = fs::remove_dir_all(&folder);
        outcome
    }

    /// Keeps a file with the command that must not have ended so.
    fn keep(&self, options: &Options, index: usize, words: &str, file: &Path, ended: &Ended) {
        let name = file.file_name().and_then(|name| name.to_str()).unwrap_or("file");
        let Ended { code, cpu, memory_kb } = ended;
        eprintln!("{index}: halfstep {words} ({name}): {code:?}, {:.1} s, {} MB", cpu.as_secs_f64(), memory_kb >> 10);
        let kept = options.keep.join(format!("{}-{index}-{name}", options.seed));
        let copied = fs::create_dir_all(&options.keep).and_then(|()| fs::copy(file, &kept));
        copied.expect("a folder for what is kept");
    }

    /// Runs a command in a folder; the files are its last words.
    fn run(&self, folder: &Path, words: &str, files: &[&Path]) -> Ended {
        let child = Command::new(self.binary)
            .args(words.split_whitespace())
            .args(files)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        watched(child.expect("the halfstep command"))
    }
}

/// Waits for a command, and measures it meanwhile.
fn watched(mut child: Child) -> Ended {
    let began = Instant::now();
    let mut ended = Ended::default();
    loop {
        if let Some(memory_kb) = memory_kb(child.id()) {
            ended.memory_kb = ended.memory_kb.max(memory_kb);
        }
        if let Some(cpu) = cpu(child.id()) {
            ended.cpu = cpu;
        }
        if let Some(status) = child.try_wait().expect("a child") {
            ended.code = status.code().or(status.signal().map(|signal| 128 + signal));
            return ended;
        }
        if began.elapsed() > WALL_MAX || ended.memory_kb > 4 * MEMORY_MAX {
            let _ = child.kill();
            let _ = child.wait();
            return ended;
        }
        std::thread::sleep(POLL_INTERVAL);
    }
}

/// The most memory that a process ever had (kB).
fn memory_kb(pid: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?.parse().ok()
}

/// The time that a process has computed.
fn cpu(pid: u32) -> Option<Duration> {
    /// Ticks per second in which Linux tells it.
    const TICKS: f64 = 100.0;
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let fields: Vec<&str> = stat.rsplit(") ").next()?.split(' ').collect();
    let ticks = |field: usize| fields.get(field)?.parse::<f64>().ok();
    Some(Duration::from_secs_f64((ticks(11)? + ticks(12)?) / TICKS))
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").flatten() {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy_folder(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), to).expect("a copy");
        }
    }
}

/// A joint map for the exported robot, whose joints have our names.
fn map() -> String {
    let mut map = "name = \"ours\"\n[sole]\nbehind_m = 0.07\nahead_m = 0.21\nwidth_m = 0.08\nankle_height_m = 0.07\n\
                   [motor.all]\nresistance_ohm = 0.608\ntorque_constant_n_m_per_a = 0.0934\n\
                   rotor_inertia_kg_m2 = 5.6e-5\ngear_ratio = 50\nvoltage_max_v = 48\n"
        .to_owned();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let name = joint.name();
        map += &format!("[joint.{name}]\nurdf = \"{name}\"\nmotor = \"all\"\n");
    }
    map
}
