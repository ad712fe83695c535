//! The loops as they run, both of them, with the exchange between them and a request in it: a period allocates nothing.
//!
//! Method: an allocator that counts what each thread asks of it. A run that is three times as long allocates as much as the
//! short one: whatever there is belongs to the beginning and the end. What the system did to the loops meanwhile is printed;
//! that depends on the machine, and on what it may ask for.

use std::time::Duration;

use controller::Controller;
use gait::Start;
use halfstep::advisor::Advisor;
use halfstep::clerk::Clerk;
use halfstep::inbox::{CAPACITY, Inbox};
use halfstep::interrupt::Interrupt;
use halfstep::record;
use halfstep::run_controller::run_controller;
use halfstep::run_plant::run_plant;
use halfstep::turns::{Clock, Pace, Turns};
use halfstep_tests::counting::{Counting, allocations};
use halfstep_tests::mechanism;
use halfstep_tests::walking::{controller_parameters, nominal, plant_parameters};
use plant::{Plant, Setpoint};
use runtime::{Rate, Scheduling, Usage};
use wire::{ControllerEnd, Instance, OperatorEnd, PlantEnd, Request, Source};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// What happened to a loop's thread.
#[derive(Clone, Copy, Debug)]
struct Happened {
    ticks: u64,
    allocations: u64,
    usage: Usage,
}

/// Of what `run` does in this thread; it gives the ticks.
fn watch(run: impl FnOnce() -> u64) -> Happened {
    let _granted = Scheduling { lock_memory: true, ..Scheduling::default() }.ask();
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
    let pace = Pace { clock: Clock::Realtime, rate: Rate::default(), spin: Duration::ZERO };
    let of_controller = ControllerEnd::connect(&instance, mechanism.fingerprint).unwrap();
    let of_plant = PlantEnd::connect(&instance, mechanism.fingerprint).unwrap();
    let operator = OperatorEnd::connect(&instance).unwrap();
    let asked = Request { not_before: ticks / 2, speed: Some(1.05), ..Request::by(Source::Program) };
    let waiting = operator.requests.send(&(&asked).into()).unwrap();

    let happened = std::thread::scope(|threads| {
        let mechanism = &mechanism;
        let controller = threads.spawn(move || {
            let ControllerEnd { mut setpoints, measurements, requests, reports } = of_controller;
            let parameters = controller_parameters();
            let mut controller = Controller::new(mechanism, table, &parameters, Start::default()).unwrap();
            let (mut record, record_end) = record::of_controller(pace.clock, pace.rate, None, reports).unwrap();
            let mut turns = Turns::new(pace, measurements, "plant", Some(ticks), Interrupt::default());
            let mut inbox = Inbox::new(Clerk::new(requests, pace.clock, CAPACITY, Scheduling::default()).unwrap());
            let mut advisor = Advisor::new(pace.clock, Scheduling::default());
            let happened = watch(|| {
                let run = run_controller(
                    &mut controller,
                    &mut turns,
                    &mut setpoints,
                    &mut inbox,
                    &mut advisor,
                    &mut record,
                    0,
                );
                run.unwrap().ticks
            });
            inbox.close(&mut record);
            drop(record);
            record_end.finish().unwrap();
            happened
        });
        let plant = threads.spawn(move || {
            let PlantEnd { setpoints, mut measurements } = of_plant;
            let mut plant = Plant::new(mechanism, &plant_parameters(), &start, pace.rate.period_s(), 1);
            let (mut record, record_end) = record::of_plant(pace.clock, pace.rate, None).unwrap();
            let mut turns = Turns::new(pace, setpoints, "controller", Some(ticks), Interrupt::default());
            let stands = Setpoint { angles: start.angles, ..Setpoint::default() };
            let step = |plant: &mut Plant, setpoint: &Setpoint| Ok(plant.step(setpoint));
            let happened = watch(|| {
                let run = run_plant(&mut plant, step, stands, &mut turns, &mut measurements, &mut record, false);
                run.unwrap().ticks
            });
            drop(record);
            record_end.finish().unwrap();
            happened
        });
        [controller, plant].map(|thread| thread.join().unwrap())
    });
    assert!(waiting.poll().unwrap().is_some(), "the request was answered");
    happened
}

#[test]
fn a_period_allocates_nothing() {
    assert!(watch(|| *std::hint::black_box(Box::new(1))).allocations > 0, "the allocator does not count");
    let [short, long] = [500, 1500].map(walk);
    for (role, (short, long)) in ["controller", "plant"].into_iter().zip(short.into_iter().zip(long)) {
        assert!(long.ticks > short.ticks + 900, "{role}: {long:?}");
        assert_eq!(long.allocations, short.allocations, "{role}: {short:?} {long:?}");
        let per_1000 = |count: u64| count as f64 * 1e3 / long.ticks as f64;
        let Usage { page_faults, voluntary_switches, involuntary_switches, .. } = long.usage;
        println!(
            "{role}, per 1000 ticks: {:.0} page faults, {:.0} sleeps, {:.0} times its core was taken; {} allocations in all",
            per_1000(page_faults),
            per_1000(voluntary_switches),
            per_1000(involuntary_switches),
            long.allocations,
        );
    }
}
