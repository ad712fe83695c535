//! A stop while others flood or starve the controller: how soon it is answered and walked.

use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use halfstep_tests::command_line::{CommandLine, Running};
use interface::{GaitChange, Intent, Mode, Request, Source, Verdict};
use wire::{
    Instance, MAX_OPERATORS, MAX_UNANSWERED, ObserverPorts, OperatorPorts, PendingReply, RequestMessage, UrgentClient,
};

use crate::table;

/// Latest answer.
const ANSWER_MAX: Duration = Duration::from_millis(100);
/// Most half-steps until the robot stands.
const HALF_STEPS_MAX: u64 = 2;
const SAFETY: Duration = Duration::from_secs(20);

/// What others do to the controller.
type Disturb = fn(&CommandLine, &AtomicBool);

const KINDS: &[(&str, Disturb)] = &[
    ("nothing", |_, ends| until(ends)),
    ("valid requests, 1 client", |line, ends| flood(line, 1, valid, ends)),
    ("valid requests, 6 clients", |line, ends| flood(line, 6, valid, ends)),
    ("refused requests, 3 clients", |line, ends| flood(line, 3, refused, ends)),
    ("invalid requests, 3 clients", |line, ends| flood(line, 3, invalid, ends)),
    ("empty requests, 6 clients", |line, ends| flood(line, 6, empty, ends)),
    ("all client slots taken", |line, ends| {
        let _taken: Vec<_> =
            (0..MAX_OPERATORS).map_while(|_| OperatorPorts::connect(line.wire_instance()).ok()).collect();
        until(ends);
    }),
    ("inbox full of later requests", |line, ends| flood(line, 9, later, ends)),
    ("stopped client that connects", |line, ends| {
        // As a process that is halted while it holds the lock.
        let lock = std::fs::File::open(line.wire_instance().folder().join("turn")).expect("a controller");
        lock.lock().expect("a lock");
        until(ends);
    }),
    ("16 observers at full speed", |line, ends| observe(line.wire_instance(), ends)),
    ("four busy programs", |_, ends| {
        std::thread::scope(|threads| {
            for _ in 0..4 {
                threads.spawn(|| while !ends.load(Ordering::Relaxed) {});
            }
        });
    }),
    ("connecting and leaving", |line, ends| {
        while !ends.load(Ordering::Relaxed) {
            let _ = OperatorPorts::connect(line.wire_instance());
        }
    }),
];

/// Stops during every kind, and the last row with a full shared memory.
pub(crate) fn survey(program: &str, stops: usize) -> bool {
    let each = stops.div_ceil(KINDS.len() + 1);
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut passed = true;
    for (name, disturb) in KINDS {
        let outcome = stops_during(program, each, *disturb);
        passed &= outcome.failures.is_empty();
        rows.push(outcome.row(name));
    }
    table::print(HEADER, &rows);
    passed & in_full_memory(program, each)
}

const HEADER: &[&str] = &["while", "stops", "in time", "latest answer ms", "most half-steps"];

/// The same in a mount namespace of its own with a small shared memory, which is filled.
fn in_full_memory(program: &str, stops: usize) -> bool {
    let own = std::env::current_exe().expect("this program");
    let script = format!(
        "mount -t tmpfs -o size=24m tmpfs /dev/shm && exec {} kill --full-memory --halfstep {program} --stops {stops}",
        own.display()
    );
    match Command::new("unshare").args(["-rm", "sh", "-c", &script]).status() {
        Ok(status) if status.code() == Some(0) => true,
        Ok(status) if status.code() == Some(1) => false,
        other => {
            println!("NOT RUN: a full shared memory, because no mount namespace can be made ({other:?})");
            true
        }
    }
}

/// The row of a full shared memory; the caller has made it small.
pub(crate) fn full_memory(program: &str, stops: usize) -> bool {
    let outcome = stops_during(program, stops, |_, ends| {
        let file = Path::new("/dev/shm/other");
        let _ = std::fs::File::create(file).and_then(|mut file| std::io::copy(&mut std::io::repeat(0), &mut file));
        until(ends);
        let _ = std::fs::remove_file(file);
    });
    table::print(HEADER, &[outcome.row("shared memory full")]);
    outcome.failures.is_empty()
}

/// Stops during one kind.
#[derive(Default)]
struct Outcome {
    stops: usize,
    failures: Vec<String>,
    latest: Duration,
    half_steps: u64,
}

impl Outcome {
    fn row(&self, name: &str) -> Vec<String> {
        self.failures.iter().for_each(|failure| println!("{name}: {failure}"));
        vec![
            name.to_owned(),
            self.stops.to_string(),
            (self.stops - self.failures.len()).to_string(),
            format!("{:.1}", self.latest.as_secs_f64() * 1e3),
            self.half_steps.to_string(),
        ]
    }
}

fn stops_during(program: &str, stops: usize, disturb: Disturb) -> Outcome {
    let line = CommandLine::new(program);
    let pair: [Running; 2] = ["controller", "plant"].map(|role| line.start_here(role));
    line.wait_for_controller();
    let mut observer = ObserverPorts::connect(line.wire_instance()).expect("a place");
    let mut outcome = Outcome { stops, ..Outcome::default() };
    for _ in 0..stops {
        if let Err(failure) = stop_once(&line, &mut observer, disturb, &mut outcome) {
            outcome.failures.push(failure);
        }
    }
    pair.into_iter().for_each(|process| drop(process.end()));
    outcome
}

fn stop_once(
    line: &CommandLine,
    observer: &mut ObserverPorts,
    disturb: Disturb,
    outcome: &mut Outcome,
) -> Result<(), String> {
    let walk = Request { intent: Some(Intent::Walk), ..Request::new(Source::Console) };
    let operator = OperatorPorts::connect(line.wire_instance()).map_err(|error| error.to_string())?;
    let began = Instant::now();
    // What others sent before they left may still fill the queue.
    while operator.requests.ask(&(&walk).into(), SAFETY).map_err(|error| error.to_string())?.verdict
        != Verdict::Accepted.code()
    {
        if began.elapsed() > SAFETY {
            return Err("it never walks".to_owned());
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    drop(operator);
    wait_for(observer, Mode::Walking)?;

    let ends = AtomicBool::new(false);
    std::thread::scope(|threads| {
        threads.spawn(|| disturb(line, &ends));
        std::thread::sleep(Duration::from_millis(300));
        let stopped = stop(line.wire_instance(), observer, outcome);
        ends.store(true, Ordering::Relaxed);
        stopped
    })
}

fn stop(instance: &Instance, observer: &mut ObserverPorts, outcome: &mut Outcome) -> Result<(), String> {
    let stop = Request { intent: Some(Intent::Stop), ..Request::new(Source::Console) };
    while let Ok(Some(_)) = observer.reports.next_report() {}
    let began = Instant::now();
    let reply = UrgentClient::connect(instance)
        .map_err(|error| error.to_string())?
        .stop(&(&stop).into(), SAFETY)
        .map_err(|error| error.to_string())?;
    let took = began.elapsed();
    let first = wait_for_any(observer)?;
    let last = wait_for(observer, Mode::Standing)?;
    outcome.latest = outcome.latest.max(took);
    outcome.half_steps = outcome.half_steps.max(last.saturating_sub(first));
    if reply.verdict != Verdict::Accepted.code() {
        return Err(format!("the stop was not accepted: {reply:?}"));
    }
    if took > ANSWER_MAX {
        return Err(format!("answered after {} ms", took.as_millis()));
    }
    if last - first > HALF_STEPS_MAX { Err(format!("{} half-steps until it stood", last - first)) } else { Ok(()) }
}

/// Waits for a mode, and gives the half-step in which it was reported.
fn wait_for(observer: &mut ObserverPorts, mode: Mode) -> Result<u64, String> {
    let began = Instant::now();
    let mut newest = None;
    while began.elapsed() < SAFETY {
        match observer.reports.next_report().map_err(|error| error.to_string())?.map(|report| report.checked()) {
            Some(Ok(report)) if report.mode == mode => return Ok(report.half_step.index),
            Some(Ok(report)) => newest = Some(report.mode),
            _ => std::thread::sleep(Duration::from_micros(500)),
        }
    }
    Err(format!("not {mode} within {} s, but {newest:?}", SAFETY.as_secs()))
}

fn wait_for_any(observer: &mut ObserverPorts) -> Result<u64, String> {
    let began = Instant::now();
    while began.elapsed() < SAFETY {
        if let Some(report) = observer.reports.next_report().map_err(|error| error.to_string())? {
            return Ok(report.half_step);
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    Err("nothing is reported".to_owned())
}

fn until(ends: &AtomicBool) {
    while !ends.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Clients that send as fast as they can.
fn flood(line: &CommandLine, clients: usize, message: fn(u64) -> RequestMessage, ends: &AtomicBool) {
    std::thread::scope(|threads| {
        for _ in 0..clients {
            threads.spawn(move || {
                let Ok(operator) = OperatorPorts::connect(line.wire_instance()) else { return };
                let mut unanswered: Vec<PendingReply> = Vec::with_capacity(MAX_UNANSWERED);
                for number in 0.. {
                    if ends.load(Ordering::Relaxed) {
                        return;
                    }
                    match operator.requests.send(&message(number)) {
                        Ok(pending) => unanswered.push(pending),
                        Err(_) => unanswered.retain(|pending| matches!(pending.poll(), Ok(None))),
                    }
                }
            });
        }
    });
}

fn observe(instance: &Instance, ends: &AtomicBool) {
    std::thread::scope(|threads| {
        for _ in 0..15 {
            threads.spawn(move || {
                let Ok(mut observer) = ObserverPorts::connect(instance) else { return };
                while !ends.load(Ordering::Relaxed) {
                    let _ = observer.reports.next_report();
                }
            });
        }
    });
}

fn change(gait: GaitChange, source: Source) -> RequestMessage {
    (&Request { gait, ..Request::new(source) }).into()
}

fn valid(number: u64) -> RequestMessage {
    let speed = 0.95 + 0.01 * (number % 10) as f64;
    change(GaitChange { speed: Some(speed), ..GaitChange::NONE }, Source::Program)
}

fn refused(_: u64) -> RequestMessage {
    change(GaitChange { turn: Some(3.0), speed: Some(9.0), extension: Some(3.0), sidestep: Some(3.0) }, Source::Script)
}

fn invalid(number: u64) -> RequestMessage {
    RequestMessage { speed: f64::NAN, ..valid(number) }
}

fn empty(_: u64) -> RequestMessage {
    change(GaitChange::NONE, Source::Teleop)
}

fn later(number: u64) -> RequestMessage {
    RequestMessage { not_before: u64::MAX / 2 + number, ..valid(number) }
}
