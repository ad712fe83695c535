//! Another robot's URDF becomes a mechanism, gets its own nominal half-step and parameters in its proportions, and
//! walks: the public robots with nothing but their soles, and our own body grown by 15 % with longer thighs, a heavier
//! trunk and motors as strong in proportion. Nominal half-steps, then turns, speeds and step lengths, with noise; no
//! falls.

use std::fs;
use std::sync::Arc;

use config::Config;
use controller::Parameters;
use halfstep_tests::walking::Walking;
use halfstep_tests::{mechanism, repository, shared};
use interchange::import::{NamedText, import};
use interchange::scaled_parameters::{controller_text, plant_text};
use interchange::urdf::urdf_text;
use interface::{GaitChange, Intent, Mode};
use model::{Joint, Mechanism, Motor};
use plant::PlantParameters;
use synthesis::fit_half_step;

/// From which half-step each request is made, and the last one.
const NOMINAL_UNTIL: u64 = 16;
const BETWEEN: u64 = 8;

#[test]
fn public_robots_walk_with_nothing_but_their_soles() {
    let Some(robots) = shared("robots") else { return };
    let folders = fs::read_dir(robots).expect("a folder").flatten().map(|entry| entry.path());
    let mut count = 0;
    for folder in folders.filter(|path| path.is_dir()) {
        let read = |name: &str| fs::read_to_string(folder.join(name)).expect("it is there");
        let robot = imported(&read("robot.urdf"), &read("sole.toml"));
        let said = read("robot.urdf").matches("<mass").count();
        assert!(robot.mass() > 1.0 && said > 0, "{}", robot.name);
        assert_walks(&robot, 1);
        count += 1;
    }
    assert!(count >= 9, "{count} robots");
}

#[test]
fn our_body_grown_and_of_other_proportions_gets_its_own_nominal_and_walks() {
    let robot = imported(&urdf_text(&grown(mechanism(), 1.15)).expect("it can be written"), &map_of_our_own(1.15));
    assert!(robot.mass() > 1.5 * mechanism().mass(), "{} kg", robot.mass());
    assert_walks(&robot, 3);
}

fn imported(urdf: &str, map: &str) -> Mechanism {
    let map = NamedText { text: map, file: "map.toml" };
    let imported = import(NamedText { text: urdf, file: "robot.urdf" }, Some(map));
    let text = imported.unwrap_or_else(|failure| panic!("{failure}")).text;
    Mechanism::from_toml(&text, "mechanism.toml").unwrap_or_else(|failure| panic!("{failure}"))
}

fn parameters(robot: &Mechanism) -> (Parameters, PlantParameters) {
    let paper = |name: &str| fs::read_to_string(repository().join("config").join(name)).expect("it is committed");
    let controller = controller_text(&paper("controller.toml"), robot);
    let plant = plant_text(&paper("plant.toml"), robot);
    (
        Parameters::from_toml(&controller, "controller.toml").expect("it loads"),
        PlantParameters::from_toml(&plant, "plant.toml").expect("it loads"),
    )
}

fn assert_walks(robot: &Mechanism, seeds: u64) {
    let nominal = fit_half_step(robot).unwrap_or_else(|error| panic!("{}: {error}", robot.name)).synthesis;
    assert!(nominal.report.residual < 1e-3, "{}: {} m", robot.name, nominal.report.residual);
    let table = Arc::new(nominal.table);
    let (controller, plant) = parameters(robot);
    let asked = |turn: f64, speed: f64, extension: f64| GaitChange {
        turn: Some(turn.to_radians()),
        speed: Some(speed),
        extension: Some(extension.to_radians()),
        ..GaitChange::NONE
    };
    let script = [asked(15.0, 1.0, 0.0), asked(-15.0, 1.1, 0.0), asked(0.0, 1.2, 3.0), asked(10.0, 0.9, -3.0)];

    for seed in 0..seeds {
        let mut walking = Walking::begin_by(robot, Arc::clone(&table), &controller, &plant, seed);
        let mut coming = script.iter();
        let (mut half_step, mut due_at) = (0, NOMINAL_UNTIL);
        let mut needed = Overload::default();
        while half_step < NOMINAL_UNTIL + BETWEEN * (script.len() as u64 + 1) {
            let due = if half_step >= due_at { coming.next() } else { None };
            due_at += if due.is_some() { BETWEEN } else { 0 };
            let tick = walking.tick(due.map(|request| (request, Some(Intent::Walk))));
            half_step = tick.report.half_step.index;
            needed.absorb(robot, &tick.setpoint.feed_forward);
            assert!(
                !walking.has_fallen(&tick) && tick.report.mode == Mode::Walking && walking.time() < 120.0,
                "{}, seed {seed}: {:?} at {:.2} s in half-step {half_step} with {:?}, {:?}",
                robot.name,
                tick.report.mode,
                walking.time(),
                tick.command,
                tick.rejection
            );
        }
        assert!(needed.0 <= 1.0 + 1e-9, "{}: a torque of {:.2} times its limit", robot.name, needed.0);
    }
}

/// The largest feed-forward torque as a share of its limit.
#[derive(Default)]
struct Overload(f64);

impl Overload {
    fn absorb(&mut self, robot: &Mechanism, torques: &model::JointVector) {
        let motors = Joint::ALL.into_iter().filter_map(|joint| Some((joint, robot.links[joint].motor?)));
        let shares = motors.map(|(joint, motor)| torques[joint].abs() / motor.torque_max());
        self.0 = shares.fold(self.0, f64::max);
    }
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
    for length in [&mut sole.behind, &mut sole.ahead, &mut sole.inside, &mut sole.outside, &mut sole.ankle_height] {
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
    let motor = *ours.links[Joint::LeftKnee].motor.as_ref().and_then(Motor::dc).expect("powered by a DC motor");
    let mut text = format!(
        "name = \"grown by {scale}\"\n[sole]\nbehind_m = {}\nahead_m = {}\nwidth_m = {}\nankle_height_m = {}\n\
         [motor.leg]\nresistance_ohm = {}\ntorque_constant_n_m_per_a = {}\nrotor_inertia_kg_m2 = {}\n\
         gear_ratio = {}\nvoltage_max_v = {}\n",
        sole.behind * scale,
        sole.ahead * scale,
        (sole.inside + sole.outside) * scale,
        sole.ankle_height * scale,
        motor.resistance / scale.powi(4),
        motor.torque_constant,
        motor.rotor_inertia,
        motor.gear_ratio,
        motor.voltage_max
    );
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered() && !joint.is_in_arm()) {
        text += &format!("[joint.{name}]\nurdf = \"{name}\"\nmotor = \"leg\"\n", name = joint.name());
    }
    text
}
