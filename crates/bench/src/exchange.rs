//! Round trip of measurement and setpoint between two processes that both wait actively, each on a core of its own.
//!
//! The services of `wire` are measured against plain iceoryx2 and a bare ring in shared memory. At the control rate a
//! round trip begins when it is due, whether or not the previous one has come back in time, so that waiting counts (no
//! coordinated omission). Without pause the next one begins when the last has ended.

use std::hint::{black_box, spin_loop};
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Stdio};
use std::time::Duration;

use runtime::{Scheduling, now_ns};
use wire::{ControllerPorts, Instance, Latest, MeasurementMessage, PlantPorts, SetpointMessage};

use crate::raw_iceoryx2::{Blackboards, PubSub, Services};
use crate::raw_ring::{Plain, SharedRing};
use crate::{BenchError, BenchReport, Machine, Ratio, Reduction, Series};

/// Options of the measurement.
#[derive(Clone, Copy, Debug)]
pub struct ExchangeOptions {
    /// Number of rounds.
    pub rounds: u32,
    /// Round trips without pause per round.
    pub trips: u64,
    /// Round trips at the control rate per round.
    pub trips_at_pace: u64,
    /// The control period.
    pub period: Duration,
    /// Scheduling of the two processes: the one that begins, and the one that answers. Each needs a core of its own.
    pub scheduling: [Scheduling; 2],
}

/// The compared ways of exchange, with the group in which each is shown.
const WAYS: [(&str, &str); 4] = [
    ("halfstep", "setpoint + measurement"),
    ("blackboard", "iceoryx2 blackboard"),
    ("pub-sub", "iceoryx2 publish-subscribe"),
    ("ring", "ring in shared memory"),
];

/// Fingerprint of the mechanism: both ends use the same one.
const MECHANISM: u64 = 0;
/// The tick of the last measurement of a round.
const LAST: u64 = u64::MAX / 2;
/// Pause in which other threads can run: a thread that waits actively with priority starves them.
const SETTLING_TIME: Duration = Duration::from_millis(100);
/// How long to wait for an answer (ns).
const TIMEOUT_NS: u64 = 5_000_000_000;

/// One end of a way: sends `Out`, receives `In`.
trait Way<Out, In> {
    fn send(&mut self, message: &Out);
    /// Reads a whole message, if one has arrived, and returns its tick.
    fn receive(&mut self) -> Option<u64>;
}

/// Measures all ways of exchange. `answering` is the command that runs [`answer`] in another process.
///
/// # Errors
/// A way cannot be opened, or the other process does not answer.
pub fn exchange(
    options: &ExchangeOptions,
    instance: &Instance,
    answering: impl FnOnce() -> std::io::Result<std::process::Command>,
    after_round: impl Fn(),
) -> Result<BenchReport, BenchError> {
    let _leftovers = instance.leftovers();
    let mut ways = asking_ways(instance)?;
    let mut other = Other::start(answering)?;
    let _granted = options.scheduling[0].request();

    let of_group = |group: &str| WAYS.map(|(_, name)| Series::new(group, name, Reduction::Median));
    let period_us = options.period.as_micros();
    let mut flat_out = of_group("round trip, flat out");
    let mut at_pace = of_group(&format!("round trip every {period_us} µs"));
    for round in 0..options.rounds as usize {
        // In another order in every round.
        for place in 0..WAYS.len() {
            let way = (place + round) % WAYS.len();
            let asking = ways[way].as_mut();
            other.turn_to(WAYS[way].0)?;
            warm_up(asking)?;
            flat_out[way].begin_round();
            at_pace[way].begin_round();
            time_flat_out(asking, options.trips, &mut flat_out[way])?;
            time_at_pace(asking, options, &mut at_pace[way])?;
            asking.send(&MeasurementMessage { tick: LAST, ..MeasurementMessage::EMPTY });
            std::thread::sleep(SETTLING_TIME);
        }
        after_round();
    }

    let mut ratios = Vec::new();
    for [ours, blackboard, pub_sub, ring] in [flat_out.each_ref(), at_pace.each_ref()] {
        let fastest = if blackboard.quantile(0.5) <= pub_sub.quantile(0.5) { blackboard } else { pub_sub };
        ratios.push(Ratio { of: ours.group.clone(), ..Ratio::of(ours, fastest, 0.5, 1.15) });
        ratios.push(Ratio { of: ours.group.clone(), ..Ratio::of(ours, ring, 0.5, 1.6) });
    }
    let notes = vec![format!(
        "Each number is the median of {} interleaved rounds, each ratio that of the rounds' ratios; {} B there, \
         {} B back.",
        options.rounds,
        size_of::<MeasurementMessage>(),
        size_of::<SetpointMessage>()
    )];
    let series = flat_out.into_iter().chain(at_pace).collect();
    Ok(BenchReport { what: "latency", machine: Machine::of_this_process(), series, ratios, notes })
}

/// The other process of [`exchange`]: answers on the way that stdin names, until stdin ends.
///
/// # Errors
/// A way cannot be opened.
pub fn answer(instance: &Instance, scheduling: &Scheduling) -> Result<(), BenchError> {
    let mut ways = answering_ways(instance)?;
    let _granted = scheduling.request();
    let broken = |error| BenchError::new("answering", error);
    let mut setpoint = SetpointMessage { tick: 0, ..SetpointMessage::EMPTY };
    let mut stdout = std::io::stdout().lock();
    for name in std::io::stdin().lock().lines() {
        let name = name.map_err(broken)?;
        let Some(way) = WAYS.iter().position(|(way, _)| *way == name) else { continue };
        writeln!(stdout, "ready").and_then(|()| stdout.flush()).map_err(broken)?;
        loop {
            match ways[way].receive() {
                Some(LAST) => break,
                Some(tick) => {
                    setpoint.tick = tick;
                    ways[way].send(&setpoint);
                }
                None => spin_loop(),
            }
        }
    }
    Ok(())
}

/// The other process, which answers.
struct Other {
    child: Child,
    stdin: ChildStdin,
    stdout: BufReader<ChildStdout>,
}

impl Other {
    fn start(command: impl FnOnce() -> std::io::Result<std::process::Command>) -> Result<Self, BenchError> {
        let failed = |error| BenchError::new("starting the process that answers", error);
        let mut command = command().map_err(failed)?;
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(failed)?;
        let pipes = child.stdin.take().zip(child.stdout.take());
        let (stdin, stdout) = pipes.ok_or_else(|| BenchError::new("starting the process that answers", "no pipe"))?;
        Ok(Self { child, stdin, stdout: BufReader::new(stdout) })
    }

    fn turn_to(&mut self, way: &str) -> Result<(), BenchError> {
        let mut line = String::new();
        let result = writeln!(self.stdin, "{way}").and_then(|()| self.stdout.read_line(&mut line));
        match result {
            Ok(length) if length > 0 => Ok(()),
            Ok(_) => Err(BenchError::new("the process that answers", "it has ended")),
            Err(error) => Err(BenchError::new("the process that answers", error)),
        }
    }
}

impl Drop for Other {
    fn drop(&mut self) {
        // It may wait for a measurement that will not come.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn trip(way: &mut dyn Way<MeasurementMessage, SetpointMessage>, tick: u64) -> Result<(), BenchError> {
    way.send(&MeasurementMessage { tick, sample: tick, ..MeasurementMessage::EMPTY });
    let mut looks = 0_u64;
    let mut began = None;
    loop {
        if way.receive() == Some(tick) {
            return Ok(());
        }
        looks += 1;
        if looks.is_multiple_of(1 << 20) {
            let began_ns = *began.get_or_insert_with(now_ns);
            if now_ns() - began_ns > TIMEOUT_NS {
                return Err(BenchError::new("the process that answers", "no message for too long"));
            }
        }
        spin_loop();
    }
}

fn warm_up(way: &mut dyn Way<MeasurementMessage, SetpointMessage>) -> Result<(), BenchError> {
    (1..1000).try_for_each(|tick| trip(way, tick))
}

fn time_flat_out(
    way: &mut dyn Way<MeasurementMessage, SetpointMessage>,
    trips: u64,
    series: &mut Series,
) -> Result<(), BenchError> {
    let mut began_ns = now_ns();
    for tick in 1000..1000 + trips {
        trip(way, tick)?;
        let ended_ns = now_ns();
        series.add((ended_ns - began_ns) as f64);
        // Adding to the series is not part of the next trip.
        began_ns = now_ns();
    }
    Ok(())
}

fn time_at_pace(
    way: &mut dyn Way<MeasurementMessage, SetpointMessage>,
    options: &ExchangeOptions,
    series: &mut Series,
) -> Result<(), BenchError> {
    let period_ns = options.period.as_nanos() as u64;
    let mut due_ns = now_ns() + period_ns;
    for tick in 0..options.trips_at_pace {
        while now_ns() < due_ns {
            spin_loop();
        }
        trip(way, LAST + 1 + tick)?;
        series.add((now_ns() - due_ns) as f64);
        due_ns += period_ns;
    }
    Ok(())
}

type Ways<Out, In> = [Box<dyn Way<Out, In>>; 4];

/// The ends of the process that begins, in the order of [`WAYS`].
fn asking_ways(instance: &Instance) -> Result<Ways<MeasurementMessage, SetpointMessage>, BenchError> {
    let end = PlantPorts::connect(instance, MECHANISM).map_err(|error| BenchError::new("our services", error))?;
    let services = Services::new(instance, true)?;
    let ring = |error| BenchError::new("a ring", error);
    let out = SharedRing::make(&ring_file(instance, "measurement")).map_err(ring)?;
    let into = SharedRing::make(&ring_file(instance, "setpoint")).map_err(ring)?;
    Ok([
        Box::new(end),
        Box::new(services.blackboards("board/measurement", "board/setpoint")?),
        Box::new(services.pub_sub("published/measurement", "published/setpoint")?),
        Box::new(Rings { into, out }),
    ])
}

/// The ends of the process that answers, in the order of [`WAYS`].
fn answering_ways(instance: &Instance) -> Result<Ways<SetpointMessage, MeasurementMessage>, BenchError> {
    let end = ControllerPorts::connect(instance, MECHANISM).map_err(|error| BenchError::new("our services", error))?;
    let services = Services::new(instance, false)?;
    let ring = |error| BenchError::new("a ring", error);
    let out = SharedRing::open(&ring_file(instance, "setpoint")).map_err(ring)?;
    let into = SharedRing::open(&ring_file(instance, "measurement")).map_err(ring)?;
    Ok([
        Box::new(end),
        Box::new(services.blackboards("board/setpoint", "board/measurement")?),
        Box::new(services.pub_sub("published/setpoint", "published/measurement")?),
        Box::new(Rings { into, out }),
    ])
}

fn ring_file(instance: &Instance, name: &str) -> PathBuf {
    PathBuf::from(format!("/dev/shm/{}ring-{name}", instance.prefix()))
}

/// A ring in each direction.
struct Rings<Out: Plain, In: Plain> {
    out: SharedRing<Out>,
    into: SharedRing<In>,
}

impl Way<MeasurementMessage, SetpointMessage> for PlantPorts {
    fn send(&mut self, message: &MeasurementMessage) {
        self.measurements.write(message);
    }

    fn receive(&mut self) -> Option<u64> {
        self.setpoints.take_new().map(|message| black_box(message).tick)
    }
}

impl Way<SetpointMessage, MeasurementMessage> for ControllerPorts {
    fn send(&mut self, message: &SetpointMessage) {
        self.setpoints.write(message);
    }

    fn receive(&mut self) -> Option<u64> {
        self.measurements.take_new().map(|message| black_box(message).tick)
    }
}

impl<Out: Latest, In: Latest> Way<Out, In> for Blackboards<Out, In> {
    fn send(&mut self, message: &Out) {
        Blackboards::send(self, message);
    }

    fn receive(&mut self) -> Option<u64> {
        Blackboards::receive(self).map(|message| black_box(message).tick())
    }
}

impl<Out: Latest, In: Latest> Way<Out, In> for PubSub<Out, In> {
    fn send(&mut self, message: &Out) {
        PubSub::send(self, message);
    }

    fn receive(&mut self) -> Option<u64> {
        PubSub::receive(self).map(|message| black_box(&message).tick())
    }
}

impl<Out: Plain, In: Plain + Latest> Way<Out, In> for Rings<Out, In> {
    fn send(&mut self, message: &Out) {
        self.out.write(message);
    }

    fn receive(&mut self) -> Option<u64> {
        self.into.read().map(|message| black_box(&message).tick())
    }
}
