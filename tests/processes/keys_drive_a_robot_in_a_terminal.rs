//! `halfstep teleop` in a terminal of tmux, with keys by script: the robot turns, stops and walks back; when no key
//! comes any more it stops; the terminal is left as it was found.

use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use halfstep_tests::command_line::CommandLine;
use interface::{Mode, Report};
use wire::ObserverPorts;

/// Nothing here takes so long.
const SAFETY: Duration = Duration::from_secs(60);
/// Time between two keys of one that is held, of the tests' clock.
const REPEAT: Duration = Duration::from_millis(20);

/// A terminal of tmux with 80 × 24 characters.
struct Tmux<'a> {
    command_line: &'a CommandLine,
    socket: String,
}

impl<'a> Tmux<'a> {
    /// Runs `halfstep <words>` and then tells the state of the terminal.
    fn start(command_line: &'a CommandLine, words: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let socket = format!("halfstep-{}-{}", command_line.instance(), COUNT.fetch_add(1, Ordering::Relaxed));
        let tmux = Self { command_line, socket };
        let binary = env!("CARGO_BIN_EXE_halfstep-under-test");
        let shell = format!("{binary} {words}; echo \"exit code $?\"; stty -a; sleep 600");
        tmux.run(&["new-session", "-d", "-x", "80", "-y", "24", &shell]);
        tmux
    }

    fn run(&self, words: &[&str]) -> String {
        let output = Command::new("tmux")
            .args(["-L", &self.socket, "-f", "/dev/null"])
            .args(words)
            .env("XDG_RUNTIME_DIR", self.command_line.runtime_folder())
            .current_dir(self.command_line.folder())
            .output()
            .expect("tmux is installed: see docs/contributing.md");
        assert!(output.status.success(), "tmux {words:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    fn press(&self, key: &str) {
        self.run(&["send-keys", key]);
    }

    fn screen(&self) -> String {
        self.run(&["capture-pane", "-p"])
    }

    /// Waits for a screen that holds a text.
    fn wait_for(&self, text: &str) -> String {
        let began = Instant::now();
        loop {
            let screen = self.screen();
            if screen.contains(text) {
                return screen;
            }
            assert!(began.elapsed() < SAFETY, "no {text:?}:\n{screen}");
            std::thread::sleep(REPEAT);
        }
    }
}

impl Drop for Tmux<'_> {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = Command::new("tmux").args(["-L", &self.socket, "kill-server"]).output();
    }
}

/// Waits for a report that is as it should be, and presses a key now and then, if one is given, as if it were held.
fn wait_until(observer: &mut ObserverPorts, tmux: &Tmux, key: Option<&str>, what: &str, is: impl Fn(&Report) -> bool) {
    let began = Instant::now();
    let mut pressed = None;
    loop {
        while let Some(message) = observer.reports.next_report().expect("shared memory") {
            if is(&message.checked().expect("a good report")) {
                return;
            }
        }
        if let Some(key) = key
            && pressed.is_none_or(|pressed: Instant| pressed.elapsed() >= REPEAT)
        {
            tmux.press(key);
            pressed = Some(Instant::now());
        }
        assert!(began.elapsed() < SAFETY, "never {what}:\n{}", tmux.screen());
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
#[ignore = "needs tmux: see docs/contributing.md"]
fn keys_turn_stop_and_walk_back_and_their_silence_stops() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep --from-stand");
    command_line.wait_for_controller();
    let _plant = command_line.start_here("plant --lockstep --from-stand");
    let mut observer = ObserverPorts::connect(command_line.wire_instance()).expect("a controller");
    // Long, since lockstep runs many times as fast as the clock by which this machine schedules tmux.
    let words = format!("teleop --instance {} --age-limit 20s", command_line.instance());
    let tmux = Tmux::start(&command_line, &words);
    tmux.wait_for("standing");

    wait_until(&mut observer, &tmux, Some("a"), "turning", |report| report.odometry.pose.heading > 0.5);
    tmux.press("Space");
    let stands = |report: &Report| report.mode == Mode::Standing;
    wait_until(&mut observer, &tmux, None, "standing", stands);
    tmux.wait_for("accepted: stop");

    wait_until(&mut observer, &tmux, Some("s"), "walking back", |report| report.odometry.velocity.ahead < -0.1);
    let screen = tmux.screen();
    assert!(screen.lines().all(|line| line.chars().count() <= 80), "{screen}");
    for part in ["walking", "does not tell when a key is let go", "SPACE stops", "pace 50 %", "vx -0.2"] {
        assert!(screen.contains(part), "{part}:\n{screen}");
    }
    // No key comes any more.
    wait_until(&mut observer, &tmux, None, "standing after the age limit", stands);

    tmux.press("Escape");
    tmux.wait_for("exit code 0");
}

#[test]
#[ignore = "needs tmux: see docs/contributing.md"]
fn the_terminal_is_left_as_it_was_found_and_the_robot_stops() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep");
    command_line.wait_for_controller();
    let _plant = command_line.start_here("plant --lockstep");
    let mut observer = ObserverPorts::connect(command_line.wire_instance()).expect("a controller");
    for key in ["Escape", "C-c"] {
        let tmux = Tmux::start(&command_line, &format!("teleop --instance {}", command_line.instance()));
        tmux.wait_for("halfstep teleop");
        tmux.press("w");
        tmux.wait_for("vx 0.");
        tmux.press(key);
        let screen = tmux.wait_for("echoctl");
        assert!(screen.contains("left, and stopped the robot") && screen.contains("exit code 0"), "{key}:\n{screen}");
        assert!(screen.contains(" icanon") && !screen.contains("-icanon"), "{key}:\n{screen}");
        assert!(screen.contains(" echo ") && !screen.contains("-echo "), "{key}:\n{screen}");
        wait_until(&mut observer, &tmux, None, "standing", |report| report.mode == Mode::Standing);
    }
}

#[test]
#[ignore = "needs tmux: see docs/contributing.md"]
fn teleop_ends_with_its_terminal() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep --from-stand");
    command_line.wait_for_controller();
    let _plant = command_line.start_here("plant --lockstep --from-stand");
    let tmux = Tmux::start(&command_line, &format!("teleop --instance {}", command_line.instance()));
    tmux.wait_for("standing");

    let shell: u32 = tmux.run(&["display-message", "-p", "#{pane_pid}"]).trim().parse().expect("a process");
    let children = std::fs::read_to_string(format!("/proc/{shell}/task/{shell}/children")).expect("its children");
    let teleop = Path::new("/proc").join(children.trim());
    assert!(teleop.exists(), "{children:?}");
    tmux.run(&["kill-server"]);
    let began = Instant::now();
    while teleop.exists() {
        assert!(began.elapsed() < SAFETY, "it is still there");
        std::thread::sleep(REPEAT);
    }
}
