//! Goal: robots that cannot stand on one foot start from a stand and come to a stand; they sway as in a walk.
//! Method: two robots in the box, in one process with the plant. The hip roll of the Booster T1 permits 25 N·m, and
//! needs 35 to stand on one foot; that of the Fourier GR1T1 permits 48 N·m and −5.2°, and needs 61 and −9.2°.

use std::sync::Arc;

use config::Config;
use gait::NominalTable;
use halfstep_tests::repository;
use halfstep_tests::walking::Walking;
use interface::{GaitChange, Intent, Mode, Reason, Verdict};
use model::{Joint, Mechanism};

const NOTHING: GaitChange = GaitChange::NONE;
/// Ticks of a second.
const SECOND: usize = 1000;

/// A robot in the box, in a stand.
fn standing(name: &str, spoil: impl Fn(&mut Mechanism)) -> Walking {
    let folder = repository().join("config/robots").join(name);
    let file = |name: &str| folder.join(name);
    let mut mechanism = Mechanism::load(file("mechanism.toml")).expect("it is committed");
    let nominal = NominalTable::read_csv(&file("nominal_half_step.csv")).expect("it is committed");
    spoil(&mut mechanism);
    let controller = controller::Parameters::load(file("controller.toml")).expect("it is committed");
    let plant = plant::PlantParameters::load(file("plant.toml")).expect("it is committed");
    Walking::stand_by(&mechanism, Arc::new(nominal), &controller, &plant, 0)
}

/// Walks on for some seconds, and returns the mode at the end. No fault stops the robot.
fn after(walking: &mut Walking, seconds: usize, what: &str) -> Mode {
    let mut mode = Mode::Standing;
    for tick in 0..seconds * SECOND {
        let now = walking.tick(None);
        mode = now.report.mode;
        assert!(!matches!(mode, Mode::Faulted | Mode::Fallen), "{what}, after {tick} ms: {:?}", now.latched);
    }
    assert!(!walking.plant.truth().has_fallen(), "{what}");
    mode
}

fn starts_and_stops(name: &str, then: &[(Intent, Mode)]) {
    let mut walking = standing(name, |_| {});
    assert_eq!(after(&mut walking, 1, name), Mode::Standing);
    for (intent, mode) in [(Intent::Walk, Mode::Walking), (Intent::Stop, Mode::Standing)].iter().chain(then) {
        let reply = walking.ask(NOTHING, Some(*intent)).reply.expect("it is replied to");
        assert_eq!(reply.verdict, Verdict::Accepted, "{name}: {intent:?}: {reply:?}");
        let what = format!("{name}: {intent:?}");
        assert_eq!(after(&mut walking, 4, &what), *mode, "{what}");
    }
}

#[test]
fn booster_t1_starts_and_stops() {
    starts_and_stops("t1", &[(Intent::Walk, Mode::Walking), (Intent::Hold, Mode::Holding)]);
}

#[test]
fn fourier_gr1t1_starts_and_stops() {
    let in_place = [(Intent::InPlace, Mode::InPlace), (Intent::Stop, Mode::Standing)];
    let then = [(Intent::Walk, Mode::Walking), (Intent::Hold, Mode::Holding), (Intent::Walk, Mode::Walking)];
    starts_and_stops("gr1t1", &[in_place.as_slice(), &then].concat());
}

/// A start that no sway makes possible is refused, with the joint.
#[test]
fn a_robot_whose_hips_cannot_carry_it_stays_in_its_stand() {
    let mut walking = standing("t1", |mechanism| {
        for joint in [Joint::RightHipRoll, Joint::LeftHipRoll] {
            let Some(model::Motor::Torque(source)) = &mut mechanism.links[joint].motor else { panic!("no source") };
            source.effort *= 0.85;
        }
    });
    for (gait, intent) in [(NOTHING, Some(Intent::Walk)), (NOTHING, Some(Intent::InPlace))] {
        let reply = walking.ask(gait, intent).reply.expect("it is replied to");
        assert_eq!((reply.verdict, reply.reason), (Verdict::Refused, Reason::Torque), "{reply:?}");
        let limit = reply.active_limit.expect("it has numbers");
        assert!(matches!(limit.joint, Some(Joint::RightHipRoll | Joint::LeftHipRoll)), "{limit:?}");
        assert!(limit.value.abs() > 1.1 * limit.limit.abs(), "{limit:?}");
    }
    assert_eq!(after(&mut walking, 1, "a stand"), Mode::Standing);
}
