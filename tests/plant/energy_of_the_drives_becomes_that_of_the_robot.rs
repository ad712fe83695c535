//! Goal: the energy in the summary of a run, and with it the cost of transport, is the energy that the robot gets.
//!
//! Method: in free flight nothing but the drives gives energy. A knee speeds up while all other joints hold, so that no
//! drive brakes: the positive work that is computed from recorded currents and rates must be the gain in kinetic energy
//! of links and rotors, which comes from the plant's true state. The motion of the centre of mass is left out of it:
//! that is gravity's.

use dynamics::{Tree, kinetic_energy};
use halfstep_tests::walking::plant_parameters;
use halfstep_tests::{mechanism, repository};
use interface::Setpoint;
use model::{Joint, Mechanism, Motion};
use plant::{Plant, PlantParameters, SensorParameters};
use plots::run_log::{DriveEnergy, RunLog};
use record::{Provenance, RecordingWriter, RunEvent};
use wire::{MeasurementMessage, SetpointMessage};

const PERIOD: f64 = 1e-3;
const TICKS: u32 = 200;

/// Kinetic energy of links and rotors, seen from the centre of mass (J).
fn energy(plant: &Plant, mechanism: &Mechanism, tree: &Tree) -> f64 {
    let robot = &plant.robot;
    let kinematics = robot.kinematics(tree);
    let rotors = Joint::ALL.into_iter().filter_map(|joint| {
        let motor = mechanism.links[joint].motor?;
        Some(0.5 * motor.reflected_inertia() * robot.rates[joint] * robot.rates[joint])
    });
    kinetic_energy(tree, &kinematics, robot.angular_rate, robot.velocity, &robot.rates)
        - 0.5 * mechanism.mass() * plant.truth().com_velocity.norm_squared()
        + rotors.sum::<f64>()
}

/// Lets the robot fly while its knee is asked for an acceleration (rad/s²): what it gained (J), and what the recording
/// says.
fn flight(acceleration: f64) -> (f64, DriveEnergy) {
    let mechanism = mechanism();
    let tree = Tree::new(&mechanism);
    // With one integration step per period the sampled current is that of the whole period. With more, a servo's
    // torque falls while its joint catches up with a new setpoint: a sample at the end of a period is below its mean.
    let parameters = PlantParameters { steps_per_period: 1, sensors: SensorParameters::PERFECT, ..plant_parameters() };
    let mut plant = Plant::new(&mechanism, &parameters, &Motion::default(), PERIOD, 1);
    plant.robot.sole_to_world.translation.vector.z = 10.0;
    let before = energy(&plant, &mechanism, &tree);

    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("flight.mcap");
    let text = std::fs::read_to_string(repository().join("config/mechanism.toml")).expect("a committed file");
    let files = vec![("mechanism.toml".to_owned(), text)];
    let mut writer = RecordingWriter::create(&file, &Provenance { files, ..Provenance::default() }).expect("a file");
    for tick in 0..TICKS {
        let time = f64::from(tick + 1) * PERIOD;
        let mut setpoint = Setpoint::default();
        setpoint.angles[Joint::RightKnee] = -0.5 * acceleration * time * time;
        setpoint.rates[Joint::RightKnee] = -acceleration * time;
        let measured = plant.step(&setpoint);
        let events = [
            (tick, RunEvent::Setpoint(SetpointMessage::new(tick.into(), 0, &setpoint))),
            (tick + 1, RunEvent::Measurement(MeasurementMessage::new((tick + 1).into(), 0, &measured))),
        ];
        for (tick, event) in events {
            writer.write(u64::from(tick) * 1_000_000, tick, &event).expect("room");
        }
    }
    writer.finish().expect("room");
    let recorded = RunLog::read(&file).expect("a recording").measures(&mechanism).energy.expect("measurements");
    (energy(&plant, &mechanism, &tree) - before, recorded)
}

#[test]
fn positive_work_in_a_summary_is_the_energy_that_the_robot_gained() {
    let (gained, idle) = flight(0.0);
    assert!(gained.abs() < 1e-6 && idle.mechanical_j < 1e-6, "{gained} J, {idle:?}");
    for acceleration in [20.0, 40.0] {
        let (gained, recorded) = flight(acceleration);
        assert!(gained > 1.0, "{gained} J");
        let error = (recorded.mechanical_j - gained).abs();
        assert!(error < 0.02 * gained, "{gained} J gained, {recorded:?}");
        let heat = recorded.electrical_j.expect("DC motors") - recorded.mechanical_j;
        assert!(heat > 0.0, "resistances turn some of it into heat: {recorded:?}");
    }
}
