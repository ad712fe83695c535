//! The `halfstep` command as a person types it: in a folder of its own, with the committed configuration.

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::fs::DirBuilderExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use wire::{Instance, Leftovers, OperatorPorts};

/// Nothing here takes so long; whatever does hangs.
const SAFETY: Duration = Duration::from_secs(60);
const GLANCE: Duration = Duration::from_millis(5);
/// Name of the runtime folder, which holds the files of instances.
const RUNTIME: &str = "runtime";

/// A folder to type commands in, and an instance to talk to.
pub struct CommandLine {
    binary: PathBuf,
    folder: TempDir,
    instance: Instance,
    outputs: AtomicU32,
    _leftovers: Leftovers,
}

/// What a command that has ended left behind.
#[derive(Clone, Debug)]
pub struct Ended {
    /// `None` if it was killed.
    pub code: Option<i32>,
    /// All that it printed.
    pub stdout: String,
    /// All that it complained of.
    pub stderr: String,
}

/// A command that runs; killed when dropped.
pub struct Running {
    child: Child,
    outputs: [PathBuf; 2],
}

impl CommandLine {
    /// A new folder with a copy of `config/`. `binary` is `env!("CARGO_BIN_EXE_halfstep-under-test")`.
    pub fn new(binary: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("test-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = tempfile::tempdir().expect("a temporary folder");
        // A runtime folder of its own: no other test sweeps what killed processes leave here, or sees it.
        let runtime = folder.path().join(RUNTIME);
        fs::DirBuilder::new().mode(0o700).create(&runtime).expect("an empty folder");
        let instance = Instance::new_in(&name, &runtime).expect("a good name");
        let config = folder.path().join("config");
        fs::create_dir(&config).expect("an empty folder");
        for file in fs::read_dir(crate::repository().join("config")).expect("the committed configuration") {
            let file = file.expect("a file").path();
            if file.is_dir() {
                continue;
            }
            fs::copy(&file, config.join(file.file_name().expect("a name"))).expect("a copy");
        }
        let leftovers = instance.leftovers();
        Self { binary: binary.into(), folder, instance, outputs: AtomicU32::new(0), _leftovers: leftovers }
    }

    /// The instance's name.
    pub fn instance(&self) -> &str {
        self.instance.name().as_str()
    }

    /// The instance, to connect to.
    pub fn wire_instance(&self) -> &Instance {
        &self.instance
    }

    /// The folder in which the processes keep the files of instances: their `$XDG_RUNTIME_DIR`.
    pub fn runtime_folder(&self) -> PathBuf {
        self.folder().join(RUNTIME)
    }

    /// Copies the scenarios of the paper's figures to the configuration.
    pub fn copy_scenarios(&self) {
        let to = self.folder().join("config/scenarios");
        fs::create_dir(&to).expect("a folder of its own");
        for file in fs::read_dir(crate::repository().join("config/scenarios")).expect("the committed ones").flatten() {
            fs::copy(file.path(), to.join(file.file_name())).expect("it is copied");
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Text of a file in the folder.
    pub fn read(&self, file: &str) -> String {
        fs::read_to_string(self.folder().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    }

    /// What was recorded of a run in the folder as a table: `plant` or `controller`.
    pub fn csv(&self, run: &str, table: &str) -> String {
        let ended = self.run(&format!("plot {run} --csv"));
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        self.read(&format!("{run}/{table}.csv"))
    }

    /// Replaces `from`, which must be there, by `to` in a file of the folder.
    pub fn edit(&self, file: &str, from: &str, to: &str) {
        let text = self.read(file);
        assert!(text.contains(from), "{file} does not contain {from:?}");
        fs::write(self.folder().join(file), text.replace(from, to)).expect("a file that can be written");
    }

    /// `halfstep <words>`, run to its end.
    pub fn run(&self, words: &str) -> Ended {
        self.start(words).finish()
    }

    /// `halfstep <words> --instance <this one>`, started.
    pub fn start_here(&self, words: &str) -> Running {
        self.start(&format!("{words} --instance {}", self.instance.name()))
    }

    /// `halfstep <words>`, started.
    pub fn start(&self, words: &str) -> Running {
        let number = self.outputs.fetch_add(1, Ordering::Relaxed);
        // Files, not pipes: nobody has to read while it runs.
        let outputs = ["stdout", "stderr"].map(|name| self.folder().join(format!("{name}-{number}")));
        let [stdout, stderr] = outputs.each_ref().map(|path| File::create(path).expect("a new file"));
        let child = self.spawn(words, stdout.into(), stderr.into());
        Running { child, outputs }
    }

    /// `halfstep <words>` with its output to wherever; the standard input is a pipe.
    pub fn spawn(&self, words: &str, stdout: Stdio, stderr: Stdio) -> Child {
        Command::new(&self.binary)
            .args(words.split_whitespace())
            .current_dir(self.folder())
            .env_remove("RUST_LOG")
            .env("XDG_RUNTIME_DIR", self.runtime_folder())
            .stdin(Stdio::piped())
            .stdout(stdout)
            .stderr(stderr)
            .spawn()
            .expect("the binary under test")
    }

    /// Waits until a controller of the instance takes requests.
    pub fn wait_for_controller(&self) {
        let began = Instant::now();
        while let Err(error) = OperatorPorts::connect(&self.instance) {
            assert!(began.elapsed() < SAFETY, "{error}");
            std::thread::sleep(GLANCE);
        }
    }
}

impl Running {
    /// Pipes text into it and closes the pipe.
    pub fn type_in(&mut self, text: &str) {
        self.type_on(text);
        drop(self.child.stdin.take());
    }

    /// Pipes text into it; there may be more to come.
    pub fn type_on(&mut self, text: &str) {
        let pipe = self.child.stdin.as_mut().expect("an open pipe");
        pipe.write_all(text.as_bytes()).and_then(|()| pipe.flush()).expect("somebody who reads");
    }

    /// Waits until it has printed a whole line.
    pub fn wait_for_line(&mut self) -> String {
        let began = Instant::now();
        loop {
            let ended = self.ended(None);
            if let Some((line, _)) = ended.stdout.split_once('\n') {
                return line.to_owned();
            }
            assert!(began.elapsed() < SAFETY, "it prints nothing: {}", ended.stderr);
            std::thread::sleep(GLANCE);
        }
    }

    /// How many whole lines it has printed.
    pub fn lines_so_far(&self) -> usize {
        self.ended(None).stdout.matches('\n').count()
    }

    /// Waits until it ends.
    pub fn finish(mut self) -> Ended {
        drop(self.child.stdin.take());
        let began = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().expect("a child") {
                break status;
            }
            assert!(began.elapsed() < SAFETY, "it does not end: {}", self.ended(None).stderr);
            std::thread::sleep(GLANCE);
        };
        self.ended(status.code())
    }

    /// Asks it to end, as Ctrl-C does, and waits until it has.
    pub fn end(self) -> Ended {
        self.ask_to_end();
        self.finish()
    }

    /// Asks it to end, as Ctrl-C does.
    pub fn ask_to_end(&self) {
        rustix::process::kill_process(rustix::process::Pid::from_child(&self.child), rustix::process::Signal::TERM)
            .expect("a child that was not waited for");
    }

    /// Halts it, as a debugger does, and lets it go on after a while.
    pub fn halt_for(&self, time: Duration) {
        let pid = rustix::process::Pid::from_child(&self.child);
        rustix::process::kill_process(pid, rustix::process::Signal::STOP).expect("it is still there");
        std::thread::sleep(time);
        rustix::process::kill_process(pid, rustix::process::Signal::CONT).expect("it is still there");
    }

    /// Halts it for good.
    pub fn halt(&self) {
        let pid = rustix::process::Pid::from_child(&self.child);
        rustix::process::kill_process(pid, rustix::process::Signal::STOP).expect("it is still there");
    }

    /// Whether it still runs.
    pub fn is_running(&mut self) -> bool {
        matches!(self.child.try_wait(), Ok(None))
    }

    /// Id of its process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Kills it; it has no chance to clean up.
    pub fn kill(mut self) {
        self.child.kill().expect("it is still there");
        self.child.wait().expect("a child");
    }

    fn ended(&self, code: Option<i32>) -> Ended {
        let [stdout, stderr] = self.outputs.each_ref().map(|path| fs::read_to_string(path).expect("its output"));
        Ended { code, stdout, stderr }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
