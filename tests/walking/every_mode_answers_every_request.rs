//! In each of its modes the controller answers every kind of request as it should, and ends in the mode it should: all
//! transitions, with the real plant. After a fall or a fault nothing goes on until a reset.

use controller::{Controller, Tick};
use gait::Start;
use halfstep_tests::mechanism;
use halfstep_tests::walking::{PERIOD, Walking, controller_parameters, nominal};
use interface::{GaitChange, Intent, Measurement, Mode, Reason, Request, Source, Verdict};
use model::Wrench;
use nalgebra::{Quaternion, Vector3};
use plant::{SensorFault, SensorFaultKind};

const MODES: [Mode; 8] = [
    Mode::Standing,
    Mode::Starting,
    Mode::Walking,
    Mode::InPlace,
    Mode::Stopping,
    Mode::Holding,
    Mode::Faulted,
    Mode::Fallen,
];

/// What can be asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ask {
    Walk,
    InPlace,
    Stop,
    Hold,
    Reset,
    Values,
    WalkWithValues,
    SignOfLife,
}

const ASKS: [Ask; 8] =
    [Ask::Walk, Ask::InPlace, Ask::Stop, Ask::Hold, Ask::Reset, Ask::Values, Ask::WalkWithValues, Ask::SignOfLife];

impl Ask {
    fn asked(self) -> Request {
        let values = GaitChange { turn: Some(0.1), speed: Some(0.9), extension: Some(0.05), sidestep: Some(0.05) };
        let (gait, intent) = match self {
            Ask::Walk => (GaitChange::default(), Some(Intent::Walk)),
            Ask::InPlace => (GaitChange::default(), Some(Intent::InPlace)),
            Ask::Stop => (GaitChange::default(), Some(Intent::Stop)),
            Ask::Hold => (GaitChange::default(), Some(Intent::Hold)),
            Ask::Reset => (GaitChange::default(), Some(Intent::Reset)),
            Ask::Values => (values, None),
            Ask::WalkWithValues => (values, Some(Intent::Walk)),
            Ask::SignOfLife => (GaitChange::default(), None),
        };
        Request { gait, intent, ..Request::new(Source::Console) }
    }
}

/// What must be answered, and the mode that must be reached.
fn expected(mode: Mode, ask: Ask) -> (Result<(), Reason>, Mode) {
    let is_start = matches!(ask, Ask::Walk | Ask::WalkWithValues);
    match (mode, ask) {
        (Mode::Fallen, Ask::Reset) => (Err(Reason::FaultPersists), Mode::Fallen),
        (Mode::Fallen, _) => (Err(Reason::Fallen), Mode::Fallen),
        (Mode::Faulted, Ask::Reset) => (Ok(()), Mode::Holding),
        (Mode::Faulted, Ask::Hold | Ask::SignOfLife) => (Ok(()), Mode::Faulted),
        (Mode::Faulted, _) => (Err(Reason::Faulted), Mode::Faulted),
        (Mode::Starting, Ask::Reset) => (Err(Reason::NothingToReset), Mode::Walking),
        (Mode::Stopping, Ask::Reset) => (Err(Reason::NothingToReset), Mode::Standing),
        (_, Ask::Reset) => (Err(Reason::NothingToReset), mode),
        _ if is_start => (Ok(()), Mode::Walking),
        (_, Ask::InPlace) => (Ok(()), Mode::InPlace),
        // The feet are side by side after each step in place.
        (Mode::InPlace, Ask::Stop | Ask::Hold) => (Ok(()), Mode::Standing),
        // The extension waits for the walk.
        (Mode::InPlace, Ask::Values) => (Err(Reason::InPlace), Mode::InPlace),
        (Mode::InPlace, _) => (Ok(()), Mode::InPlace),
        (Mode::Walking, Ask::Stop) => (Ok(()), Mode::Standing),
        (Mode::Walking, Ask::Hold) => (Ok(()), Mode::Holding),
        (Mode::Walking, _) => (Ok(()), Mode::Walking),
        (Mode::Starting, Ask::Stop | Ask::Hold) => (Ok(()), Mode::Standing),
        (Mode::Starting, _) => (Ok(()), Mode::Walking),
        // Not too late to stand otherwise.
        (Mode::Stopping, Ask::Hold) => (Ok(()), Mode::Holding),
        (Mode::Standing | Mode::Stopping, _) => (Ok(()), Mode::Standing),
        (Mode::Holding, Ask::Stop) => (Ok(()), Mode::Standing),
        (Mode::Holding, _) => (Ok(()), Mode::Holding),
    }
}

/// A robot in a mode.
fn in_mode(mode: Mode) -> Walking {
    let mut walking = Walking::begin(7);
    let ask = |walking: &mut Walking, ask: Ask| walking.tick_with(Some(&ask.asked()));
    walking.walk(2.0);
    match mode {
        Mode::Walking => {}
        Mode::InPlace => {
            ask(&mut walking, Ask::InPlace);
            walking.walk(3.0);
        }
        Mode::Stopping => {
            ask(&mut walking, Ask::Stop);
            walking.walk(0.1);
        }
        Mode::Standing | Mode::Starting => {
            ask(&mut walking, Ask::Stop);
            walking.walk(4.0);
            if mode == Mode::Starting {
                ask(&mut walking, Ask::Walk);
                walking.walk(0.3);
            }
        }
        Mode::Holding => {
            ask(&mut walking, Ask::Hold);
            walking.walk(4.0);
        }
        Mode::Faulted => {
            let start = walking.time() + 0.1;
            let fault = SensorFault { start, duration: 0.2, kind: SensorFaultKind::DropOut };
            walking.plant.disturbances.sensor_faults.push(fault);
            walking.walk(4.0);
        }
        Mode::Fallen => {
            walking.plant.push(Vector3::new(0.0, 150.0, 0.0), 0.1);
            for _ in 0..3000 {
                walking.tick(None);
            }
        }
    }
    walking
}

#[test]
fn every_mode_answers_every_request_and_reaches_the_expected_mode() {
    for mode in MODES {
        for ask in ASKS {
            let mut walking = in_mode(mode);
            let report = walking.tick_with(Some(&ask.asked()));
            let (answered, reached) = expected(mode, ask);
            let answer = report.reply.unwrap_or_else(|| panic!("{mode:?}, {ask:?}: no answer"));
            match answered {
                Ok(()) => assert_eq!(answer.verdict, Verdict::Accepted, "{mode:?}, {ask:?}: {answer:?}"),
                Err(reason) => {
                    // A stop is never refused, but a faulted robot stays in stride.
                    let is_limited = (mode, ask) == (Mode::Faulted, Ask::Stop) || reason == Reason::InPlace;
                    let verdict = if is_limited { Verdict::Limited } else { Verdict::Refused };
                    assert_eq!((answer.verdict, answer.reason), (verdict, reason), "{mode:?}, {ask:?}");
                }
            }
            let mut last: Option<Tick> = None;
            for _ in 0..6000 {
                last = Some(walking.tick(None));
            }
            let last = last.expect("it ticked");
            assert_eq!(last.report.mode, reached, "{mode:?}, {ask:?}");
            assert_eq!(walking.plant.truth().has_fallen(), mode == Mode::Fallen, "{mode:?}, {ask:?}");
        }
    }
}

/// A robot that was put on its feet again goes back to a stand slowly, and then walks when asked to.
#[test]
fn after_a_fall_a_reset_leads_back_to_a_stand() {
    let mechanism = mechanism();
    let mut controller =
        Controller::new(&mechanism, nominal(), &controller_parameters(), Start::default()).expect("it walks");
    // It hangs in the air.
    let mut measurement = Measurement {
        sample: 0,
        angles: nominal().at(0.0).angles,
        rates: model::JointVector::ZERO,
        feet: [Wrench::ZERO; 2],
        orientation: Quaternion::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt(), 0.0),
        angular_rate: Vector3::zeros(),
        currents: model::JointVector::ZERO,
        specific_force: Vector3::z() * model::GRAVITY,
        missing: interface::SensorGroups::NONE,
    };
    let mut tick = |controller: &mut Controller, orientation| {
        measurement = Measurement { sample: measurement.sample + 1, orientation, ..measurement };
        let tick = controller.tick(PERIOD, Some(&measurement));
        // Ideal drives.
        measurement.angles = tick.setpoint.angles;
        tick
    };
    let lying = Quaternion::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt(), 0.0);
    let upright = Quaternion::identity();
    let mut held = tick(&mut controller, lying);
    for _ in 0..200 {
        held = tick(&mut controller, lying);
    }
    assert_eq!(held.report.mode, Mode::Fallen);
    controller.submit(&Ask::Reset.asked());
    assert_eq!(tick(&mut controller, lying).reply.map(|reply| reply.reason), Some(Reason::FaultPersists));

    // Nothing on the way up was sensed: the orientation is believed after 0.25 s only.
    for _ in 0..300 {
        let report = tick(&mut controller, upright);
        assert_eq!((report.report.mode, report.setpoint.angles), (Mode::Fallen, held.setpoint.angles), "nothing moves");
    }
    controller.submit(&Ask::Reset.asked());
    let mut last = tick(&mut controller, upright);
    assert_eq!(last.reply.map(|answer| answer.verdict), Some(Verdict::Accepted));
    for _ in 0..4000 {
        assert!(matches!(last.report.mode, Mode::Starting | Mode::Standing), "{:?}", last.report.mode);
        let report = tick(&mut controller, upright);
        let step = (report.setpoint.angles - last.setpoint.angles).max_abs();
        assert!(step < 2e-3, "a joint jumps by {step} rad");
        last = report;
    }
    assert_eq!(last.report.mode, Mode::Standing);
    let [right, left] = [model::Joint::RightKnee, model::Joint::LeftKnee].map(|knee| last.setpoint.angles[knee]);
    assert!((right.abs() - left.abs()).abs() < 1e-6, "it stands on both legs alike: {right} and {left} rad");
}
