//! A stop is decided in the tick in which it is submitted, whatever is under evaluation, and no late answer undoes it.

use controller::{AdmissionJob, AdmissionTiming, AdmissionWorker, Controller, Driver, Tick};
use gait::{Start, Walk};
use halfstep_tests::mechanism;
use halfstep_tests::walking::{PERIOD, controller_parameters, nominal, plant_parameters};
use interface::{GaitChange, Intent, Lifetime, Measurement, Mode, Reason, Request, Source, Verdict};
use plant::Plant;

/// Completes no job until it is told to.
#[derive(Default)]
struct StuckWorker {
    job: Option<Box<AdmissionJob>>,
    completes: bool,
}

impl AdmissionWorker for StuckWorker {
    fn serve(&mut self, controller: &mut Controller, _: AdmissionTiming) -> bool {
        if let Some(job) = controller.take_job() {
            self.job = Some(job);
        }
        if !self.completes {
            return false;
        }
        let Some(mut job) = self.job.take() else { return false };
        job.evaluate();
        controller.complete(job);
        true
    }
}

struct Robot {
    driver: Driver<StuckWorker>,
    plant: Plant,
    measurement: Measurement,
}

impl Robot {
    /// A robot that has walked for two seconds.
    fn walking() -> Self {
        let (mechanism, parameters) = (mechanism(), controller_parameters());
        let motion = Walk::new(nominal(), &mechanism, &parameters.gait, Start::default()).unwrap().physical_motion();
        let mut plant = Plant::new(&mechanism, &plant_parameters(), &motion, PERIOD, 3);
        let measurement = plant.measure();
        let controller = Controller::new(&mechanism, nominal(), &parameters, Start::default()).unwrap();
        let mut robot = Self { driver: Driver { controller, worker: StuckWorker::default() }, plant, measurement };
        robot.ticks(2000);
        robot
    }

    /// One period; the request is submitted if the controller takes one like it.
    fn tick(&mut self, request: Option<Request>) -> Tick {
        let is_taken = |urgent_only: bool| request.filter(|request| !urgent_only || request.is_urgent());
        let tick = self.driver.step(PERIOD, Some(&self.measurement), is_taken).tick;
        self.measurement = self.plant.step(&tick.setpoint);
        tick
    }

    fn ticks(&mut self, count: u32) -> Tick {
        (1..count).for_each(|_| _ = self.tick(None));
        self.tick(None)
    }
}

fn intent(intent: Intent) -> Request {
    Request { intent: Some(intent), ..Request::new(Source::Console) }
}

fn turn(degrees: f64) -> Request {
    let gait = GaitChange { turn: Some(degrees.to_radians()), ..GaitChange::NONE };
    Request { gait, ..Request::new(Source::Script) }
}

#[test]
fn a_stop_is_granted_while_another_request_is_evaluated_for_ever() {
    for (stop, stand) in [(Intent::Stop, Mode::Standing), (Intent::Hold, Mode::Holding)] {
        let mut robot = Robot::walking();
        assert_eq!(robot.tick(Some(turn(20.0))).reply, None, "its evaluation does not end");
        assert_eq!(robot.ticks(50).reply, None);
        let before = robot.driver.controller.mode();
        assert_eq!(before, Mode::Walking);

        let tick = robot.tick(Some(intent(stop)));
        assert_eq!(tick.reply.map(|reply| (reply.verdict, reply.intent)), Some((Verdict::Accepted, Some(stop))));
        let superseded = tick.superseded.expect("the other request is refused in the same tick");
        assert_eq!((superseded.verdict, superseded.reason), (Verdict::Refused, Reason::Superseded));
        assert_eq!(robot.ticks(20).report.mode, Mode::Stopping, "within two knots");
        assert_eq!(robot.ticks(2500).report.mode, stand);
    }
}

#[test]
fn a_walk_that_is_granted_too_late_does_not_undo_a_stop() {
    let mut robot = Robot::walking();
    let walk = Request { intent: Some(Intent::Walk), ..turn(20.0) };
    robot.tick(Some(walk));
    robot.tick(Some(intent(Intent::Stop)));
    robot.driver.worker.completes = true;
    for _ in 0..4000 {
        assert_eq!(robot.tick(None).reply, None, "it was refused already");
    }
    assert_eq!(robot.driver.controller.mode(), Mode::Standing);
    assert_eq!(robot.driver.controller.tick(PERIOD, Some(&robot.measurement)).command.turn, 0.0);
}

#[test]
fn requests_are_evaluated_again_after_a_stop() {
    let mut robot = Robot::walking();
    robot.tick(Some(turn(20.0)));
    robot.tick(Some(intent(Intent::Stop)));
    robot.driver.worker.completes = true;
    robot.ticks(3000);
    let walk = robot.tick(Some(intent(Intent::Walk))).reply.expect("it is evaluated at once");
    assert_eq!(walk.verdict, Verdict::Accepted);
    assert_eq!(robot.ticks(2000).report.mode, Mode::Walking);
}

#[test]
fn gait_parameters_of_a_stop_are_evaluated_after_it() {
    let mut robot = Robot::walking();
    robot.driver.worker.completes = true;
    let stop = Request { gait: turn(10.0).gait, ..intent(Intent::Stop) };
    let reply = robot.tick(Some(stop)).reply.expect("it is evaluated at once");
    assert_eq!((reply.verdict, reply.granted.turn), (Verdict::Accepted, 10_f64.to_radians()));
    assert_eq!(robot.ticks(2500).report.mode, Mode::Standing);
}

#[test]
fn of_an_outranked_stop_nothing_but_the_stop_is_taken() {
    let mut robot = Robot::walking();
    robot.driver.worker.completes = true;
    let stream = Request { lifetime: Lifetime::Streamed, timeout: Some(30.0), ..turn(3.0) };
    robot.tick(Some(Request { source: Source::Teleop, ..stream }));
    let hold = Request { intent: Some(Intent::Hold), ..turn(30.0) };
    let reply = robot.tick(Some(hold)).reply.expect("it is decided at once");
    assert_eq!((reply.verdict, reply.reason), (Verdict::Limited, Reason::Outranked));
    assert!((reply.granted.turn - 3_f64.to_radians()).abs() < 1e-12, "{reply:?}");
    assert_eq!(robot.ticks(2500).report.mode, Mode::Holding);
    assert!((robot.tick(None).command.turn - 3_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn a_stop_of_a_faulted_robot_is_granted_to_everyone() {
    let mut robot = Robot::walking();
    robot.driver.worker.completes = true;
    let stream = Request { lifetime: Lifetime::Streamed, timeout: Some(30.0), ..turn(3.0) };
    robot.tick(Some(Request { source: Source::Teleop, ..stream }));
    // No measurement arrives any more.
    (0..2500).for_each(|_| _ = robot.driver.step(PERIOD, None, |_| None));
    assert_eq!(robot.driver.controller.mode(), Mode::Faulted);
    let stop = Request { source: Source::Script, ..intent(Intent::Stop) };
    let reply = robot.driver.step(PERIOD, None, |_| Some(stop)).tick.reply.expect("it is decided at once");
    // It stands in stride and stays so until a reset.
    assert_eq!((reply.verdict, reply.reason), (Verdict::Limited, Reason::Faulted), "{reply:?}");
}

#[test]
fn a_source_whose_request_is_evaluated_does_not_time_out() {
    let mut robot = Robot::walking();
    robot.tick(Some(Request { lifetime: Lifetime::Streamed, timeout: Some(0.1), ..turn(20.0) }));
    assert_eq!(robot.ticks(500).report.mode, Mode::Walking);
    robot.driver.worker.completes = true;
    // The plan has gone on meanwhile, so that it is evaluated again.
    let reply = (0..10).find_map(|_| robot.tick(None).reply).expect("it is decided now");
    assert_eq!(reply.verdict, Verdict::Accepted);
}
