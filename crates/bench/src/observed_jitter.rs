//! Timing of the controller's loop in company, against the same loop by itself.
//!
//! This process is the plant and, in two of three segments, two observers and a page, whose server is a process of its
//! own. The controllers run one after the other, each in a process of its own, and report their timing at the end.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use interface::Rate;
use model::Mechanism;
use node::summary::ControllerSummary;
use node::timing::TimingStats;
use plant::Plant;
use runtime::{Period, keep_off};
use rustix::process::{Pid, Signal, kill_process};
use wire::{Instance, ObserverPorts, OperatorPorts};

use crate::control_latency::{SimulatedRobot, connect_retrying};
use crate::page_viewer::PageViewer;
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

/// Largest ratio to the loop by itself that passes.
const AT_MOST: f64 = 1.1;
/// How long a page may take to show a robot.
const PATIENCE: Duration = Duration::from_secs(60);
/// Number of observers, beside the page.
const OBSERVERS: usize = 2;

/// What a controller is beside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Company {
    /// Nobody else.
    Nobody,
    /// A recorder, observers, and a page in which it is shown.
    Spectators,
    /// Observers that read nothing, and a page whose server is stopped.
    StoppedSpectators,
}

/// The processes that are started.
pub struct Commands<'a> {
    /// A controller, which records into the folder if one is given.
    pub controller: &'a (dyn Fn(Option<&Path>) -> std::io::Result<Command> + Sync),
    /// A viewer that prints the address of its page as JSON.
    pub viewer: &'a (dyn Fn() -> std::io::Result<Command> + Sync),
}

/// Measures controllers of an instance, in turn alone and in company.
///
/// # Errors
/// A process does not start, or it fails.
pub fn observed_jitter(
    options: &ObservedJitterOptions,
    instance: &Instance,
    commands: &Commands,
    mechanism: &Mechanism,
    new_plant: impl Fn() -> Plant,
    after_segment: impl Fn(),
) -> Result<(Vec<Series>, Vec<Ratio>), BenchError> {
    let failed = |error| BenchError::new("a folder to record into", error);
    let folder = tempfile::tempdir().map_err(failed)?;
    let mut measured = Company::ALL.map(|company| {
        ["wake-up", "tick"].map(|what| {
            Series::new(format!("controller's {what}, p99 of each segment"), company.text(), Reduction::Median)
        })
    });
    for segment in 0..options.segments as usize {
        for place in 0..measured.len() {
            let which = (place + segment) % measured.len();
            let company = Company::ALL[which];
            let viewer = match company {
                Company::Nobody => None,
                _ => {
                    let command = (commands.viewer)().map_err(|error| BenchError::new("the viewer", error))?;
                    Some(PageViewer::open(command, company == Company::StoppedSpectators)?)
                }
            };
            let is_recorded = company == Company::Spectators;
            let controller = (commands.controller)(is_recorded.then(|| folder.path())).and_then(|mut command| {
                command.arg("--json");
                command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()
            });
            let controller = controller.map_err(|error| BenchError::new("the controller", error))?;
            let kept = one(options, instance, controller, mechanism, &mut new_plant(), company, viewer.as_ref())?;
            for (series, spread) in measured[which].iter_mut().zip([kept.late, kept.took]) {
                series.begin_round();
                series.add(spread.p99_us * 1e3);
            }
        }
        after_segment();
    }
    let [alone, others @ ..] = measured;
    let ratio = |(ours, theirs): (&Series, &Series)| Ratio {
        of: format!("{}, {}", ours.group, ours.name),
        number: "p99".to_owned(),
        ..Ratio::of(ours, theirs, 0.5, AT_MOST)
    };
    let ratios = others.iter().flat_map(|company| company.iter().zip(&alone).map(ratio)).collect();
    // Those of one quantity beside each other.
    let by_company = [alone].into_iter().chain(others).collect::<Vec<_>>();
    let series = [0, 1].into_iter().flat_map(|what| by_company.iter().map(move |series| series[what].clone()));
    Ok((series.collect(), ratios))
}

impl Company {
    const ALL: [Self; 3] = [Self::Nobody, Self::Spectators, Self::StoppedSpectators];

    fn text(self) -> &'static str {
        match self {
            Self::Nobody => "left alone",
            Self::Spectators => "recorded, shown and observed",
            Self::StoppedSpectators => "beside stopped viewers",
        }
    }
}

/// Runs a controller for a segment, which begins once all look on, and returns its timing.
fn one(
    options: &ObservedJitterOptions,
    instance: &Instance,
    mut controller: Child,
    mechanism: &Mechanism,
    plant: &mut Plant,
    company: Company,
    viewer: Option<&PageViewer>,
) -> Result<TimingStats, BenchError> {
    let _leftovers = instance.leftovers();
    let gone = |error: std::io::Error| BenchError::new("the controller", error);
    connect_retrying(|| OperatorPorts::connect(instance))?;
    let mut robot = SimulatedRobot::connect(instance, mechanism, plant)?;
    let observers = if company == Company::Nobody { 0 } else { OBSERVERS };
    let observers = (0..observers).map(|_| connect_retrying(|| ObserverPorts::connect(instance)));
    let observers = observers.collect::<Result<Vec<_>, _>>()?;
    let over = AtomicBool::new(false);
    std::thread::scope(|threads| {
        for mut observer in observers {
            // Each polls as often as the loop reports, if it does.
            let (over, core, poll_interval) = (&over, options.loop_core, options.rate.period());
            threads.spawn(move || {
                // As an observer that does not want to disturb the loop.
                let _ = core.map(keep_off);
                while !over.load(Ordering::Relaxed) {
                    while company == Company::Spectators
                        && let Ok(Some(report)) = observer.reports.next_report()
                    {
                        std::hint::black_box(report);
                    }
                    std::thread::sleep(poll_interval);
                }
            });
        }
        let mut period = Period::starting_now(options.rate.period());
        let (began, mut all_look_on) = (Instant::now(), None);
        let mut is_over = false;
        let result = loop {
            robot.take_setpoint();
            robot.step();
            period.wait();
            if all_look_on.is_none() && viewer.is_none_or(PageViewer::has_shown) {
                all_look_on = Some(Instant::now());
            } else if all_look_on.is_none() && began.elapsed() > PATIENCE {
                break Err(BenchError::new("the viewer", "its page shows nothing"));
            }
            if !is_over && all_look_on.is_some_and(|since| since.elapsed() >= options.segment) {
                is_over = true;
                // It may have ended by itself.
                let _ = kill_process(Pid::from_child(&controller), Signal::TERM);
            }
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
