//! `send goto` and `send footsteps` ask for a destination, and wait for the arrival if they are told to. The test is
//! the controller, so that it says what becomes of the walk.

use std::fs;
use std::io::Write;
use std::process::Stdio;
use std::time::{Duration, Instant};

use halfstep_tests::command_line::{CommandLine, Ended};
use interface::{
    Command, Destination, DestinationProgress, Footstep, Mode, PeriodTiming, PlaceFrame, PlaceList, Places, Reason,
    Reply, Report, Request, Verdict, WalkPose, Waypoint,
};
use model::Side;
use runtime::now_ns;
use wire::{ControllerPorts, ReplyMessage, ReportMessage};

const SAFETY: Duration = Duration::from_secs(30);

/// A controller without a robot.
struct Teller {
    ports: ControllerPorts,
    tick: u64,
}

impl Teller {
    fn connect(command_line: &CommandLine) -> Self {
        Self { ports: ControllerPorts::connect(command_line.wire_instance(), 1).unwrap(), tick: 0 }
    }

    /// Answers the next request. A report of before, of another destination, comes after the reply.
    fn answer(&mut self, reply: &Reply) -> Request {
        let (began, before) = (Instant::now(), now_ns());
        loop {
            if let Some((message, responder)) = self.ports.requests.next_request().unwrap() {
                assert!(responder.reply(&ReplyMessage::from(reply)));
                self.report_at(before, Mode::Walking, Some((0, 0.0)));
                return message.checked().unwrap();
            }
            assert!(began.elapsed() < SAFETY, "no request");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Reports for a while, as many places being left at a distance.
    fn report(&mut self, seconds: f64, mode: Mode, left: Option<(u32, f64)>) {
        // The reports' own time, however busy the machine is.
        let began = now_ns();
        for number in 0..(seconds * 100.0) as u64 {
            self.report_at(began + number * 10_000_000, mode, left);
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    fn report_at(&mut self, time_ns: u64, mode: Mode, left: Option<(u32, f64)>) {
        let destination = left.map(|(places_left, distance)| DestinationProgress { places_left, distance, turn: 0.0 });
        let report = Report { destination, ..Report::of(mode) };
        let timing = PeriodTiming { tick: self.tick, time_ns, missed: 0, compute_ns: 0 };
        self.ports.reports.publish(&ReportMessage::new(&timing, &report)).unwrap();
        self.tick += 1;
    }
}

fn accepted() -> Reply {
    let reply = Reply::refused(Reason::None, 3, Command::NOMINAL, None);
    Reply { verdict: Verdict::Accepted, arrival: Some(7.5), ..reply }
}

#[test]
fn the_arrival_is_waited_for_and_the_way_left_is_told() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let mut controller = Teller::connect(&command_line);
    let send = command_line.start_here("send goto 1 -0.5 90 --relative --speed 1.2 --wait");
    let request = controller.answer(&accepted());
    let goal = Waypoint { x: 1.0, y: -0.5, heading: Some(90_f64.to_radians()) };
    let places = Places::Waypoints(PlaceList::new(&[goal]).unwrap());
    assert_eq!(request.destination, Some(Destination { frame: PlaceFrame::Robot, places }));
    assert_eq!((request.gait.speed, request.intent), (Some(1.2), None));
    controller.report(1.5, Mode::Walking, Some((1, 1.25)));
    controller.report(0.5, Mode::Standing, Some((0, 0.01)));
    let ended = send.finish();
    assert_eq!(
        ended.stdout,
        "accepted: speed 1, goal x 1.000 m, y -0.500 m, heading 90°, seen from the robot, there in 7.5 s, from \
         half-step 3\narrived\n"
    );
    assert_eq!((ended.code, &*ended.stderr), (Some(0), "goal in 1.2 m, 1 place left\n"));
}

#[test]
fn a_walk_that_does_not_arrive_is_a_failure() {
    let ended = |words: &str, reply: Reply, mode, left| -> Ended {
        let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
        let mut controller = Teller::connect(&command_line);
        let send = command_line.start_here(words);
        controller.answer(&reply);
        controller.report(0.2, Mode::Walking, Some((2, 1.5)));
        controller.report(0.3, mode, left);
        send.finish()
    };
    let cancelled = ended("send goto 2 0 --wait", accepted(), Mode::Stopping, None);
    assert_eq!(cancelled.code, Some(1));
    let told = cancelled.stdout.lines().last();
    assert_eq!(told, Some("cancelled by another request, or by the end of its stream: goal in 1.5 m, 2 places left"));
    let fallen = ended("send --json goto 2 0 --wait", accepted(), Mode::Fallen, Some((2, 1.5)));
    assert_eq!(fallen.code, Some(1));
    let told: serde_json::Value = serde_json::from_str(&fallen.stdout).expect("one value");
    assert_eq!(told["verdict"], "accepted", "{told}");
    let end = serde_json::json!({"destination": "fallen", "distance_m": 1.5, "turn_deg": 0.0});
    assert_eq!(told["walk_end"], end, "{told}");
    let refused = Reply { place: Some(1), ..Reply::refused(Reason::TooFar, 0, Command::NOMINAL, None) };
    let refused = ended("send goto 9999 0 --wait", refused, Mode::Walking, None);
    let told = "refused: way-point 1: it is farther away than is permitted\n";
    assert_eq!((refused.code, &*refused.stdout), (Some(1), told));
}

#[test]
fn footsteps_come_from_a_file_or_from_standard_input() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let text = r#"[{"side":"right","x_m":0.2,"y_m":-0.1,"heading_deg":0},
        {"side":"left","x_m":0.4,"y_m":0.1,"heading_deg":180}]"#;
    let sole = |x, y, heading| WalkPose { x, y, heading };
    let steps = [
        Footstep { side: Side::Right, sole: sole(0.2, -0.1, 0.0) },
        Footstep { side: Side::Left, sole: sole(0.4, 0.1, std::f64::consts::PI) },
    ];
    let places = Places::Footsteps(PlaceList::new(&steps).unwrap());
    let expected = Some(Destination { frame: PlaceFrame::Walk, places });
    fs::write(command_line.folder().join("steps.json"), text).unwrap();
    let mut controller = Teller::connect(&command_line);
    let send = command_line.start_here("send footsteps steps.json");
    assert_eq!(controller.answer(&accepted()).destination, expected);
    let told = send.finish().stdout;
    assert_eq!(told, "accepted: 2 footsteps, there in 7.5 s, from half-step 3\n");

    let words = format!("send --instance {} footsteps -", command_line.instance());
    let mut send = command_line.spawn(&words, Stdio::null(), Stdio::null());
    send.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    assert_eq!(controller.answer(&accepted()).destination, expected);
    assert!(send.wait().unwrap().success());
}

#[test]
fn a_place_that_is_no_number_is_refused_by_its_number() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep --from-stand");
    let _plant = command_line.start_here("plant --lockstep --from-stand");
    command_line.wait_for_controller();
    let ended = command_line.start_here("send goto 1 nan --wait").finish();
    let told = "refused: way-point 1: a value is not a finite number\n";
    assert_eq!((ended.code, &*ended.stdout), (Some(1), told), "{}", ended.stderr);
}
