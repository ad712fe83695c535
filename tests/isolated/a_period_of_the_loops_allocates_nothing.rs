//! The loops as they run, both of them, with the exchange between them and a request in it: a period allocates nothing.
//!
//! Method: an allocator that counts what each thread asks of it. A run that is three times as long allocates as much as
//! the short one: whatever there is belongs to the beginning and the end. What the system did to the loops meanwhile is
//! printed; that depends on the machine, and on what it may ask for.

use std::time::Duration;

use controller::{Controller, Driver};
use gait::Start;
use halfstep_tests::counting::allocations;
use halfstep_tests::mechanism;
use halfstep_tests::walking::{controller_parameters, nominal, plant_parameters};
use interface::{GaitChange, Rate, Request, Source};
use node::admission_worker::ClockedWorker;
use node::announcements::{Announced, Announcements};
use node::controller_loop::run_controller;
use node::cycle::{Clock, CycleTiming, Cycles};
use node::interrupt::Interrupt;
use node::physics::OwnPhysics;
use node::plant_loop::{AfterFall, run_plant};
use node::push_bridge::PushBridge;
use node::recorder;
use node::request_bridge::RequestBridge;
use node::request_queue::{CAPACITY, RequestQueue};
use plant::Plant;
use runtime::{Scheduling, Usage};
use wire::{ControllerPorts, Instance, OperatorPorts, PlantPorts};

use crate::alone;

/// What happened to a loop's thread.
#[derive(Clone, Copy, Debug)]
struct Happened {
    ticks: u64,
    allocations: u64,
    usage: Usage,
}

/// Of what `run` does in this thread; it gives the ticks.
fn watch(run: impl FnOnce() -> u64) -> Happened {
    let _granted = Scheduling { lock_memory: true, ..Scheduling::default() }.request();
    let (usage, before) = (Usage::of_this_thread(), allocations());
    let ticks = run();
    Happened { ticks, allocations: allocations() - before, usage: Usage::of_this_thread().since(usage) }
}

/// Lets controller and plant walk in real time, in a thread each, with a request in between.
fn walk(ticks: u64) -> [Happened; 2] {
    let instance = Instance::new(&format!("loops-{}-{ticks}", std::process::id())).unwrap();
    let _leftovers = instance.leftovers();
    let (mechanism, table) = (mechanism(), nominal());
    let start = table.at(0.0);
    let timing = CycleTiming { clock: Clock::Realtime, rate: Rate::clamped(1000), spin: Duration::ZERO };
    let of_controller = ControllerPorts::connect(&instance, mechanism.fingerprint).unwrap();
    let of_plant = PlantPorts::connect(&instance, mechanism.fingerprint).unwrap();
    let operator = OperatorPorts::connect(&instance).unwrap();
    let gait = GaitChange { speed: Some(1.05), ..GaitChange::NONE };
    let asked = Request { not_before: ticks / 2, gait, ..Request::new(Source::Program) };
    let waiting = operator.requests.send(&(&asked).into()).unwrap();

    let happened = std::thread::scope(|threads| {
        let mechanism = &mechanism;
        let controller = threads.spawn(move || {
            let ControllerPorts { mut setpoints, measurements, requests, reports } = of_controller;
            let parameters = controller_parameters();
            let controller = Controller::new(mechanism, table, &parameters, Start::default()).unwrap();
            let worker = ClockedWorker::new(timing.clock, Scheduling::default()).unwrap();
            let mut driver = Driver { controller, worker };
            let announcements = Announcements::new(Announced::Faults, "allocates", |_, _| String::new());
            let (mut recorder, recorder_thread) =
                recorder::of_controller(timing.clock, timing.rate, None, reports, announcements).unwrap();
            let mut cycles = Cycles::new(timing, measurements, "plant", Some(ticks), Interrupt::default());
            let mut queue =
                RequestQueue::new(RequestBridge::new(requests, timing.clock, CAPACITY, Scheduling::default()).unwrap());
            let happened = watch(|| {
                let run = run_controller(&mut driver, &mut cycles, &mut setpoints, &mut queue, &mut recorder, 0);
                run.unwrap().ticks
            });
            queue.close(&mut recorder);
            drop(recorder);
            assert!(recorder_thread.finish().error.is_none());
            happened
        });
        let plant = threads.spawn(move || {
            let PlantPorts { setpoints, mut measurements, pushes, true_poses } = of_plant;
            let mut pushes = PushBridge::new(pushes, timing.clock).unwrap();
            let mut plant = Plant::new(mechanism, &plant_parameters(), &start, timing.rate.period_s(), 1);
            let (mut recorder, recorder_thread) =
                recorder::of_plant(timing.clock, timing.rate, None, Announced::Faults, true_poses).unwrap();
            let mut cycles = Cycles::new(timing, setpoints, "controller", Some(ticks), Interrupt::default());
            let happened = watch(|| {
                let (measurements, pushes, recorder) = (&mut measurements, &mut pushes, &mut recorder);
                let after_fall = &AfterFall::Stay;
                let physics = &mut OwnPhysics;
                let run = run_plant(&mut plant, physics, &mut cycles, measurements, pushes, recorder, after_fall);
                run.unwrap().ticks
            });
            drop(recorder);
            assert!(recorder_thread.finish().error.is_none());
            happened
        });
        [controller, plant].map(|thread| thread.join().unwrap())
    });
    assert!(waiting.poll().unwrap().is_some(), "the request was answered");
    happened
}

#[test]
fn a_period_of_the_loops_allocates_nothing() {
    let _alone = alone();
    assert!(watch(|| *std::hint::black_box(Box::new(1))).allocations > 0, "the allocator does not count");
    let [short, long] = [500, 1500].map(walk);
    for (role, (short, long)) in ["controller", "plant"].into_iter().zip(short.into_iter().zip(long)) {
        assert!(long.ticks > short.ticks + 900, "{role}: {long:?}");
        assert_eq!(long.allocations, short.allocations, "{role}: {short:?} {long:?}");
        let per_1000 = |count: u64| count as f64 * 1e3 / long.ticks as f64;
        let Usage { page_faults, voluntary_switches, involuntary_switches, .. } = long.usage;
        println!(
            "{role}, per 1000 ticks: {:.0} page faults, {:.0} sleeps, {:.0} times its core was taken; \
             {} allocations in all",
            per_1000(page_faults),
            per_1000(voluntary_switches),
            per_1000(involuntary_switches),
            long.allocations,
        );
    }
}
