//! A Python script asks the controller and hears its reports; another one is a complete plant.
//!
//! Needs Python: `cargo test --workspace --tests -- --ignored`.

use std::process::{Command, Output};

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::{python, repository};

use crate::alone;

/// A script of `tools/python/examples`, run to its end.
fn run(mut python: Command, example: &str, command_line: &CommandLine) -> Output {
    python.arg(repository().join("tools/python/examples").join(example)).arg(command_line.instance());
    output(&mut python, command_line)
}

/// A Python program with the package, run to its end.
fn output(python: &mut Command, command_line: &CommandLine) -> Output {
    python.env("PYTHONPATH", repository().join("tools/python")).env("XDG_RUNTIME_DIR", command_line.runtime_folder());
    python.current_dir(command_line.folder()).output().expect("Python")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_python_script_streams_commands() {
    let _alone = alone();
    let python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller");
    let plant = command_line.start_here("plant");
    command_line.wait_for_controller();
    let told = run(python, "stream.py", &command_line);
    assert!(told.status.success(), "{}", text(&told.stderr));
    let lines = text(&told.stdout);
    assert_eq!(lines.matches("ACCEPTED").count(), 4, "{lines}");
    assert!(lines.contains("margin"), "it has heard a report: {lines}");
    plant.end();
    controller.end();
}

/// A program that keeps command and then says nothing more: the walk comes to a stand. However long that takes here.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn the_walk_stops_when_a_python_program_falls_silent() {
    let _alone = alone();
    let mut python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller");
    let plant = command_line.start_here("plant");
    command_line.wait_for_controller();
    let program = "
import sys
from halfstep import Intent, Mode, Observer, Operator
operator, observer = Operator(sys.argv[1]), Observer(sys.argv[1])
print(operator.ask(intent=Intent.WALK, silence_s=0.3).verdict.name)
for report in observer.reports(silence_max_s=30.0):
    if report.mode == Mode.STANDING:
        break
print('stands')
";
    let told = output(python.args(["-c", program, command_line.instance()]), &command_line);
    assert!(told.status.success(), "{}", text(&told.stderr));
    assert_eq!(text(&told.stdout), "ACCEPTED\nstands\n");
    plant.end();
    controller.end();
}

/// The controller reads the places that Python wrote: it names the one that is wrong.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_python_program_asks_for_a_destination() {
    let _alone = alone();
    let mut python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller");
    let plant = command_line.start_here("plant");
    command_line.wait_for_controller();
    let program = "
import math, sys
from halfstep import Footstep, Operator, Side, Waypoint
operator = Operator(sys.argv[1])
for wrong in (Waypoint(math.nan, 0.0), Waypoint(0.0, math.inf), Waypoint(0.0, 0.0, math.nan)):
    answer = operator.ask(goto=[Waypoint(1.0, 0.5, 90.0), Waypoint(2.0, 0.5), wrong], relative=True)
    print(answer.reason.name, answer.place)
answer = operator.ask(footsteps=[Footstep(Side.LEFT, 0.2, 0.1, 0.0), Footstep(Side.RIGHT, 0.2, math.nan, 0.0)])
print(answer.reason.name, answer.place)
for wrong in (dict(goto=[]), dict(goto=[Waypoint(1.0, 0.0)] * 25), dict(goto=Waypoint(1.0, 0.0), turn_deg=5),
              dict(relative=True), dict(goto=Waypoint(1.0, 0.0), footsteps=[Footstep(Side.LEFT, 0.2, 0.1, 0.0)])):
    try:
        operator.ask(**wrong)
    except ValueError:
        print('refused')
";
    let told = output(python.args(["-c", program, command_line.instance()]), &command_line);
    let expected = "NOT_FINITE 3\n".repeat(3) + "NOT_FINITE 2\n" + &"refused\n".repeat(5);
    assert_eq!(text(&told.stdout), expected, "{}", text(&told.stderr));
    plant.end();
    controller.end();
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_python_script_is_a_plant() {
    let _alone = alone();
    let python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --for 5s");
    let told = run(python, "kinematic_plant.py", &command_line);
    assert!(told.status.success(), "{}", text(&told.stderr));
    assert!(text(&told.stdout).contains("5000 ticks"), "{}", text(&told.stdout));
    let ended = controller.finish();
    assert!(ended.stdout.contains("8 half-steps"), "{}{}", ended.stdout, ended.stderr);
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_python_plant_for_another_robot_is_refused() {
    let _alone = alone();
    let mut python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller");
    command_line.wait_for_controller();
    let program = "import sys, halfstep; halfstep.Plant(0x1234, sys.argv[1])";
    let told = output(python.args(["-c", program, command_line.instance()]), &command_line);
    let said = text(&told.stderr);
    assert!(said.contains("Mismatch") && said.contains("0x0000000000001234"), "{said}");
    assert!(said.contains(&format!("{:#018x}", halfstep_tests::mechanism().fingerprint)), "{said}");
    controller.end();
}

#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_python_program_stops_the_robot_when_all_places_are_taken() {
    let _alone = alone();
    let mut python = python();
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let program = "
import sys
from halfstep import NoController, Operator, stop
try:
    stop(sys.argv[1])
except NoController:
    print('nobody')
";
    let told = output(python.args(["-c", program, command_line.instance()]), &command_line);
    assert_eq!(text(&told.stdout), "nobody\n", "{}", text(&told.stderr));

    let controller = command_line.start_here("controller");
    let plant = command_line.start_here("plant");
    command_line.wait_for_controller();
    let connect = || wire::OperatorPorts::connect(command_line.wire_instance());
    let _places: Vec<_> = (0..wire::MAX_OPERATORS).map(|_| connect().unwrap()).collect();
    let program = "import sys, halfstep; print(halfstep.stop(sys.argv[1]).verdict.name)";
    let mut again = halfstep_tests::python();
    let told = output(again.args(["-c", program, command_line.instance()]), &command_line);
    assert_eq!(text(&told.stdout), "ACCEPTED\n", "{}", text(&told.stderr));
    plant.end();
    controller.end();
}
