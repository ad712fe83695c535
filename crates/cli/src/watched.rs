//! The controller's loop while it is recorded and observed, beside the same loop left alone: neither may hold it up.
//!
//! This process is the plant and, now and then, an observer. The controllers take turns, each a process of its own, and
//! say at their end how they kept time.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use bench::{BenchError, Over, Ratio, Series};
use model::Mechanism;
use plant::Plant;
use runtime::{Period, Rate, keep_off};
use wire::{Instance, ObserverEnd, OperatorEnd};

use crate::in_command::{Robot, patiently};
use crate::loop_times::KeptTime;
use crate::summary::ControllerSummary;

/// How it is measured.
#[derive(Clone, Copy, Debug)]
pub struct WatchedOptions {
    /// The loops' rate.
    pub rate: Rate,
    /// The core of the controller's loop, if it has one.
    pub loop_core: Option<usize>,
    /// How often both take turns.
    pub segments: u32,
    /// How long a turn lasts.
    pub segment: Duration,
}

/// How much more is allowed when watched.
const AT_MOST: f64 = 1.1;
/// An observer looks as often as the loop reports.
const GLANCE: Duration = Duration::from_millis(1);

/// Lets controllers of an instance take turns; `command` starts one, which records into the folder, if there is one.
///
/// # Errors
/// A controller does not come, or ends badly.
pub fn watched(
    options: &WatchedOptions,
    instance: &Instance,
    command: impl Fn(Option<&Path>) -> std::io::Result<Command>,
    mechanism: &Mechanism,
    new_plant: impl Fn() -> Plant,
) -> Result<(Vec<Series>, Vec<Ratio>), BenchError> {
    let failed = |error| BenchError::new("a folder to record into", error);
    let folder = tempfile::tempdir().map_err(failed)?;
    let series =
        |what: &str, how: &str| Series::new(format!("controller's {what}, p99 of each segment"), how, Over::Median);
    let of = |how: &str| [series("wake-up", how), series("tick", how)];
    let mut both = [of("left alone"), of("recorded and observed")];
    for segment in 0..options.segments as usize {
        for place in 0..both.len() {
            let how = (place + segment) % both.len();
            let is_watched = how == 1;
            let controller = command(is_watched.then(|| folder.path())).and_then(|mut command| {
                command.args(["--for", &format!("{}ms", options.segment.as_millis()), "--json"]);
                command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()
            });
            let controller = controller.map_err(|error| BenchError::new("the controller", error))?;
            let kept = one(options, instance, controller, mechanism, &mut new_plant(), is_watched)?;
            for (series, spread) in both[how].iter_mut().zip([kept.late, kept.took]) {
                series.begin_round();
                series.add(spread.p99_us * 1e3);
            }
        }
    }
    let [alone, watched] = both;
    let ratio = |(ours, theirs): (&Series, &Series)| Ratio {
        of: format!("{}, {}", ours.group, ours.name),
        number: "p99".to_owned(),
        ..Ratio::of(ours, theirs, 0.5, AT_MOST)
    };
    let ratios = watched.iter().zip(&alone).map(ratio).collect();
    let [[late, took], [late_watched, took_watched]] = [alone, watched];
    Ok((vec![late, late_watched, took, took_watched], ratios))
}

/// A controller from its beginning to its end.
fn one(
    options: &WatchedOptions,
    instance: &Instance,
    mut controller: Child,
    mechanism: &Mechanism,
    plant: &mut Plant,
    is_watched: bool,
) -> Result<KeptTime, BenchError> {
    let _leftovers = instance.leftovers();
    let gone = |error: std::io::Error| BenchError::new("the controller", error);
    patiently(|| OperatorEnd::connect(instance))?;
    let mut robot = Robot::connect(instance, mechanism, plant)?;
    let observer = is_watched.then(|| patiently(|| ObserverEnd::connect(instance))).transpose()?;
    let over = AtomicBool::new(false);
    std::thread::scope(|threads| {
        if let Some(mut observer) = observer {
            let (over, core) = (&over, options.loop_core);
            threads.spawn(move || {
                // As a person would who wants to hear and not to disturb.
                let _ = core.map(keep_off);
                while !over.load(Ordering::Relaxed) {
                    while let Ok(Some(report)) = observer.reports.next_report() {
                        std::hint::black_box(report);
                    }
                    std::thread::sleep(GLANCE);
                }
            });
        }
        let mut period = Period::starting_now(options.rate.period());
        let walked = loop {
            robot.hear();
            robot.step();
            period.wait();
            match controller.try_wait() {
                Ok(None) => {}
                Ok(Some(_)) => break Ok(()),
                Err(error) => break Err(gone(error)),
            }
        };
        over.store(true, Ordering::Relaxed);
        walked
    })?;
    let told = controller.wait_with_output().map_err(gone)?;
    let summary: ControllerSummary =
        serde_json::from_slice(&told.stdout).map_err(|error| BenchError::new("the controller's summary", error))?;
    summary.kept_time.ok_or_else(|| BenchError::new("the controller's summary", "it kept no time"))
}
