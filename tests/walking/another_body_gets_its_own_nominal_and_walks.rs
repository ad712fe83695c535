//! Another robot's URDF becomes a mechanism, gets its own nominal half-step, and walks, with the controller's and the
//! plant's parameters as they are: a public humanoid, and our own body grown by 15 % with longer thighs and a heavier
//! trunk. Sixty half-steps as the nominal has them, then turns, speeds and step lengths, with noise; no falls.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use halfstep_tests::{mechanism, python, repository};
use interchange::import::{NamedText, import};
use interchange::urdf::urdf_text;
use interface::{GaitChange, Intent, Mode};
use model::{Joint, Mechanism, Motor};
use synthesis::{LegPattern, SynthesisParameters, synthesize};

/// The URDF is fetched from PyPI.
#[test]
#[ignore = "needs Python packages: see docs/contributing.md"]
fn a_public_humanoid_gets_its_own_nominal_and_walks() {
    let mut python = python();
    let folder = repository().join("examples/gr1t1");
    let urdf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gr1t1.urdf");
    if !urdf.exists() {
        let fetched = python.arg(folder.join("fetch.py")).arg(&urdf).status().expect("Python");
        assert!(fetched.success(), "the package registry has no fourier-robot-descriptions");
    }
    let read = |file: PathBuf| fs::read_to_string(file).expect("it is there");
    let robot = imported(&read(urdf), &read(folder.join("map.toml")));
    assert!((robot.mass() - 52.8268).abs() < 1e-6, "nothing of its mass is lost: {} kg", robot.mass());
    let leg = leg_length(&robot);
    assert!((leg - 0.7).abs() < 1e-9, "{leg} m");
    assert_walks(&robot, &in_proportion(&robot));
}

#[test]
fn our_body_grown_and_of_other_proportions_gets_its_own_nominal_and_walks() {
    let robot = imported(&urdf_text(&grown(mechanism(), 1.15)).expect("it can be written"), &map_of_our_own(1.15));
    assert!(robot.mass() > 1.5 * mechanism().mass(), "{} kg", robot.mass());
    assert_walks(&robot, &in_proportion(&robot));
}

fn imported(urdf: &str, map: &str) -> Mechanism {
    let imported = import(NamedText { text: urdf, file: "robot.urdf" }, NamedText { text: map, file: "map.toml" });
    imported.unwrap_or_else(|failure| panic!("{failure}")).mechanism
}

fn assert_walks(robot: &Mechanism, half_step: &SynthesisParameters) {
    let nominal =
        synthesize(robot, &LegPattern::Pendulum, half_step, "a test").unwrap_or_else(|error| panic!("{error}"));
    assert!(nominal.report.residual < 1e-3, "{} m", nominal.report.residual);
    let asked = |turn: f64, speed: f64, extension: f64| GaitChange {
        turn: Some(turn.to_radians()),
        speed: Some(speed),
        extension: Some(extension.to_radians()),
    };
    // from which half-step
    let script = [
        (60, asked(15.0, 1.0, 0.0)),
        (70, asked(-15.0, 1.1, 0.0)),
        (80, asked(0.0, 1.2, 3.0)),
        (90, asked(0.0, 0.8, 0.0)),
        (100, asked(10.0, 0.9, -3.0)),
    ];
    const LAST: u64 = 110;

    for seed in 0..3 {
        let (controller, plant) = (controller_parameters(), plant_parameters());
        let mut walking = Walking::begin_by(robot, Arc::new(nominal.table.clone()), &controller, &plant, seed);
        let mut coming = script.iter().peekable();
        let mut half_step = 0;
        while half_step < LAST {
            let due = coming.next_if(|(at, _)| half_step >= *at);
            let report = walking.tick(due.map(|(_, request)| (request, Some(Intent::Walk))));
            half_step = report.report.half_step.index;
            if let Some((_, request)) = due {
                let granted = [report.command.turn, report.command.speed, report.command.extension].map(Some);
                assert_eq!(granted, [request.turn, request.speed, request.extension], "{}", robot.name);
            }
            assert!(
                !walking.has_fallen(&report) && report.report.mode == Mode::Walking && walking.time() < 120.0,
                "{}, seed {seed}: {:?} at {:.2} s in half-step {half_step} with {:?}",
                robot.name,
                report.report.mode,
                walking.time(),
                report.command
            );
        }
    }
}

/// The default half-step in the leg's proportions: lengths as the leg, time as its root (Froude).
fn in_proportion(robot: &Mechanism) -> SynthesisParameters {
    let ours = mechanism();
    let scale = leg_length(robot) / leg_length(&ours);
    let default = SynthesisParameters::default();
    SynthesisParameters {
        step_length: default.step_length * scale,
        duration: default.duration * scale.sqrt(),
        clearance: default.clearance * scale,
        hip_height: robot.sole.ankle_height + (default.hip_height - ours.sole.ankle_height) * scale,
        pelvis_sway: default.pelvis_sway * scale,
        pelvis_setback: default.pelvis_setback * scale,
        pendulum_height: default.pendulum_height * scale,
        ..default
    }
}

fn leg_length(robot: &Mechanism) -> f64 {
    [Joint::LeftKnee, Joint::LeftAnklePitch].iter().map(|joint| robot.links[*joint].origin.norm()).sum()
}

/// Grown alike in all directions, at the same density; then its thighs are made 8 % longer and its trunk 20 % heavier.
fn grown(mut robot: Mechanism, scale: f64) -> Mechanism {
    for link in &mut robot.links.0 {
        link.origin *= scale;
        link.body.com *= scale;
        link.body.mass *= scale.powi(3);
        link.body.inertia *= scale.powi(5);
    }
    let sole = &mut robot.sole;
    for length in [&mut sole.behind, &mut sole.ahead, &mut sole.half_width, &mut sole.ankle_height] {
        *length *= scale;
    }
    for (thigh, after) in [(Joint::RightKnee, Joint::RightHipPitch), (Joint::LeftHipPitch, Joint::LeftKnee)] {
        robot.links[thigh].body.com *= 1.08;
        robot.links[after].origin *= 1.08;
    }
    let trunk = &mut robot.links[Joint::WaistRoll].body;
    trunk.mass *= 1.2;
    trunk.inertia *= 1.2;
    robot
}

/// The map for a robot grown of ours: motors as fast as ours and stronger by the fourth power, as weight times length
/// is.
fn map_of_our_own(scale: f64) -> String {
    let ours = mechanism();
    let sole = ours.sole;
    let mut text = format!(
        "name = \"grown by {scale}\"\n[sole]\nbehind_m = {}\nahead_m = {}\nwidth_m = {}\nankle_height_m = {}\n",
        sole.behind * scale,
        sole.ahead * scale,
        2.0 * sole.half_width * scale,
        sole.ankle_height * scale
    );
    for (name, joint) in [("leg", Joint::LeftKnee), ("arm", Joint::LeftElbow)] {
        let motor = *ours.links[joint].motor.as_ref().and_then(Motor::dc).expect("powered by a DC motor");
        text += &format!(
            "[motor.{name}]\nresistance_ohm = {}\ntorque_constant_n_m_per_a = {}\nrotor_inertia_kg_m2 = {}\n\
             gear_ratio = {}\nvoltage_max_v = {}\n",
            motor.resistance / scale.powi(4),
            motor.torque_constant,
            motor.rotor_inertia,
            motor.gear_ratio,
            motor.voltage_max
        );
    }
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let motor = if joint < Joint::RightShoulder { "leg" } else { "arm" };
        text += &format!("[joint.{name}]\nurdf = \"{name}\"\nmotor = \"{motor}\"\n", name = joint.name());
    }
    text
}
