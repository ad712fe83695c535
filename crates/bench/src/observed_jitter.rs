//! Timing of the controller's loop while it is recorded and observed, against the same loop by itself.
//!
//! This process is the plant and, in every other segment, an observer. The controllers run one after the other, each in
//! a process of its own, and report their timing at the end.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use interface::Rate;
use model::Mechanism;
use node::summary::ControllerSummary;
use node::timing::TimingStats;
use plant::Plant;
use runtime::{Period, keep_off};
use wire::{Instance, ObserverPorts, OperatorPorts};

use crate::control_latency::{SimulatedRobot, connect_retrying};
use crate::{BenchError, Ratio, Reduction, Series};

/// Options of the measurement.
#[derive(Clone, Copy, Debug)]
pub struct ObservedJitterOptions {
    /// Control periods per second.
    pub rate: Rate,
    /// The core of the controller's loop, if it has one.
    pub loop_core: Option<usize>,
    /// Number of segments of each kind.
    pub segments: u32,
    /// Length of a segment.
    pub segment: Duration,
}

/// Largest ratio of observed to unobserved that passes.
const AT_MOST: f64 = 1.1;

/// Measures controllers of an instance, in turn observed and not; `command` starts one, which records into the folder
/// if one is given.
///
/// # Errors
/// A controller does not start, or it fails.
pub fn observed_jitter(
    options: &ObservedJitterOptions,
    instance: &Instance,
    command: impl Fn(Option<&Path>) -> std::io::Result<Command>,
    mechanism: &Mechanism,
    new_plant: impl Fn() -> Plant,
    after_segment: impl Fn(),
) -> Result<(Vec<Series>, Vec<Ratio>), BenchError> {
    let failed = |error| BenchError::new("a folder to record into", error);
    let folder = tempfile::tempdir().map_err(failed)?;
    let series = |what: &str, how: &str| {
        Series::new(format!("controller's {what}, p99 of each segment"), how, Reduction::Median)
    };
    let of = |how: &str| [series("wake-up", how), series("tick", how)];
    let mut both = [of("left alone"), of("recorded and observed")];
    for segment in 0..options.segments as usize {
        for place in 0..both.len() {
            let how = (place + segment) % both.len();
            let is_observed = how == 1;
            let controller = command(is_observed.then(|| folder.path())).and_then(|mut command| {
                command.args(["--for", &format!("{}ms", options.segment.as_millis()), "--json"]);
                command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()
            });
            let controller = controller.map_err(|error| BenchError::new("the controller", error))?;
            let kept = one(options, instance, controller, mechanism, &mut new_plant(), is_observed)?;
            for (series, spread) in both[how].iter_mut().zip([kept.late, kept.took]) {
                series.begin_round();
                series.add(spread.p99_us * 1e3);
            }
        }
        after_segment();
    }
    let [alone, observed] = both;
    let ratio = |(ours, theirs): (&Series, &Series)| Ratio {
        of: format!("{}, {}", ours.group, ours.name),
        number: "p99".to_owned(),
        ..Ratio::of(ours, theirs, 0.5, AT_MOST)
    };
    let ratios = observed.iter().zip(&alone).map(ratio).collect();
    let [[late, took], [late_observed, took_observed]] = [alone, observed];
    Ok((vec![late, late_observed, took, took_observed], ratios))
}

/// Runs a controller to its end, and returns its timing.
fn one(
    options: &ObservedJitterOptions,
    instance: &Instance,
    mut controller: Child,
    mechanism: &Mechanism,
    plant: &mut Plant,
    is_observed: bool,
) -> Result<TimingStats, BenchError> {
    let _leftovers = instance.leftovers();
    let gone = |error: std::io::Error| BenchError::new("the controller", error);
    connect_retrying(|| OperatorPorts::connect(instance))?;
    let mut robot = SimulatedRobot::connect(instance, mechanism, plant)?;
    let observer = is_observed.then(|| connect_retrying(|| ObserverPorts::connect(instance))).transpose()?;
    let over = AtomicBool::new(false);
    std::thread::scope(|threads| {
        if let Some(mut observer) = observer {
            // The observer polls as often as the loop reports.
            let (over, core, poll_interval) = (&over, options.loop_core, options.rate.period());
            threads.spawn(move || {
                // As an observer that does not want to disturb the loop.
                let _ = core.map(keep_off);
                while !over.load(Ordering::Relaxed) {
                    while let Ok(Some(report)) = observer.reports.next_report() {
                        std::hint::black_box(report);
                    }
                    std::thread::sleep(poll_interval);
                }
            });
        }
        let mut period = Period::starting_now(options.rate.period());
        let result = loop {
            robot.take_setpoint();
            robot.step();
            period.wait();
            match controller.try_wait() {
                Ok(None) => {}
                Ok(Some(_)) => break Ok(()),
                Err(error) => break Err(gone(error)),
            }
        };
        over.store(true, Ordering::Relaxed);
        result
    })?;
    let output = controller.wait_with_output().map_err(gone)?;
    let summary: ControllerSummary =
        serde_json::from_slice(&output.stdout).map_err(|error| BenchError::new("the controller's summary", error))?;
    summary.timing.ok_or_else(|| BenchError::new("the controller's summary", "it kept no time"))
}
