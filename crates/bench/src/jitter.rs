//! Jitter: how late a loop wakes up that does nothing in its periods.
//!
//! The loop of `runtime`, with and without spinning before the deadline, runs alternately on the same core with
//! cyclictest, or with a bare loop of absolute sleeps if that is not installed; while the machine is idle, and while
//! another core is busy.

use std::hint::{black_box, spin_loop};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use runtime::{Period, Scheduling, Usage, now_ns};
use rustix::thread::{ClockId, clock_nanosleep_absolute};
use rustix::time::Timespec;

use crate::{BenchError, BenchReport, Machine, Ratio, Reduction, Series, cyclictest};

/// Options of the measurement.
#[derive(Clone, Copy, Debug)]
pub struct JitterOptions {
    /// Number of segments of each loop.
    pub segments: u32,
    /// Length of a segment.
    pub segment: Duration,
    /// The loops' period.
    pub period: Duration,
    /// How long before its deadline the spinning loop stops sleeping.
    pub spin: Duration,
    /// Scheduling of all loops.
    pub scheduling: Scheduling,
    /// The other core that is kept busy, if any.
    pub busy_core: Option<usize>,
}

/// The series of one condition: idle or busy.
struct Loops {
    sleeping: Series,
    spinning: Series,
    other: Series,
    /// The longest interruption of a thread that never sleeps, in each period.
    floor: Series,
    /// Share of a core that the spinning loop uses, for each segment.
    share: Vec<f64>,
}

/// Measures all loops; calls `after_segment` after each segment of all of them.
///
/// # Errors
/// cyclictest is installed and fails.
pub fn jitter(options: &JitterOptions, after_segment: impl Fn()) -> Result<BenchReport, BenchError> {
    // Held for all loops: cyclictest does so, too.
    let awake = Scheduling { keep_awake: options.scheduling.keep_awake, ..Scheduling::default() }.request();
    let with_cyclictest = options.scheduling.priority.is_some() && cyclictest::is_installed();
    let mut notes: Vec<String> = awake.refused.iter().map(ToString::to_string).collect();
    notes.extend(on_core(&options.scheduling, |granted| granted));
    let mut conditions = vec![(Loops::new("idle", with_cyclictest), None)];
    conditions.extend(options.busy_core.map(|core| (Loops::new("other core busy", with_cyclictest), Some(core))));
    for segment in 0..options.segments {
        for (loops, busy_core) in &mut conditions {
            while_busy(*busy_core, || loops.take_turns(options, segment, with_cyclictest))?;
        }
        after_segment();
    }

    let mut ratios = Vec::new();
    for (Loops { sleeping, spinning, other, share, .. }, _) in &conditions {
        let group = &sleeping.group;
        let ratio = |ours: &Series, quantile, at_most| Ratio {
            of: format!("{} ({group})", ours.name),
            ..Ratio::of(ours, other, quantile, at_most)
        };
        ratios.extend([ratio(sleeping, 0.5, 1.1), ratio(sleeping, 0.99, 1.2)]);
        ratios.extend([ratio(spinning, 0.5, 0.05), ratio(spinning, 0.99, 0.05)]);
        let share = share.iter().sum::<f64>() / share.len().max(1) as f64;
        let (of, to) = (format!("{} ({group})", spinning.name), "a core".to_owned());
        ratios.push(Ratio { of, to, number: "time".to_owned(), ratio: share, interval: None, at_most: 0.2 });
    }
    notes.push(format!(
        "Each number is the median of {} interleaved segments of {:?}, at {:?}, each ratio that of the segments' \
         ratios. \
         p99.9 and max beside the noise floor: \
         what the machine does to a thread that never sleeps.",
        options.segments, options.segment, options.period
    ));
    let series = conditions
        .into_iter()
        .flat_map(|(Loops { sleeping, spinning, other, floor, .. }, _)| [sleeping, spinning, other, floor])
        .collect();
    Ok(BenchReport { what: "jitter", machine: Machine::of_this_process(), series, ratios, notes })
}

impl Loops {
    fn new(group: &str, with_cyclictest: bool) -> Self {
        let series = |name: &str| Series::new(format!("wake-up, {group}"), name, Reduction::Median);
        Self {
            sleeping: series("loop, sleeping"),
            spinning: series("loop, sleeping then spinning"),
            other: series(if with_cyclictest { "cyclictest" } else { "bare absolute sleep" }),
            floor: series("noise floor"),
            share: Vec::new(),
        }
    }

    fn take_turns(&mut self, options: &JitterOptions, segment: u32, with_cyclictest: bool) -> Result<(), BenchError> {
        let scheduling = Scheduling { keep_awake: false, ..options.scheduling };
        let periods = options.segment.div_duration_f64(options.period).max(1.0) as u64;
        // In another order in every segment.
        for place in 0..4 {
            match (place + segment) % 4 {
                0 => {
                    self.sleeping.begin_round();
                    let series = &mut self.sleeping;
                    on_core(&scheduling, |_| our_loop(options.period, Duration::ZERO, periods, series));
                }
                1 => {
                    self.spinning.begin_round();
                    let series = &mut self.spinning;
                    let share = on_core(&scheduling, |_| our_loop(options.period, options.spin, periods, series));
                    self.share.push(share);
                }
                2 => {
                    self.other.begin_round();
                    let (series, period) = (&mut self.other, options.period);
                    match (scheduling.core, scheduling.priority) {
                        (Some(core), Some(priority)) if with_cyclictest => {
                            cyclictest::run(core, priority, period, periods, series)?;
                        }
                        _ => on_core(&scheduling, |_| bare_loop(period, periods, series)),
                    }
                }
                _ => {
                    self.floor.begin_round();
                    let series = &mut self.floor;
                    // Without priority: the kernel throttles a real-time thread that never sleeps.
                    let ordinary = Scheduling { priority: None, ..scheduling };
                    on_core(&ordinary, |_| longest_gaps(options.period, periods, series));
                }
            }
        }
        Ok(())
    }
}

/// Runs `work` in a thread with this scheduling; `work` receives what was refused.
fn on_core<T: Send>(scheduling: &Scheduling, work: impl FnOnce(Vec<String>) -> T + Send) -> T {
    std::thread::scope(|threads| {
        let thread = threads.spawn(|| {
            let granted = scheduling.request();
            work(granted.refused.iter().map(ToString::to_string).collect())
        });
        thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Runs `work` while another core is kept busy.
fn while_busy<T>(core: Option<usize>, work: impl FnOnce() -> T) -> T {
    let over = AtomicBool::new(false);
    std::thread::scope(|threads| {
        if core.is_some() {
            threads.spawn(|| {
                let _granted = Scheduling { core, ..Scheduling::default() }.request();
                let mut number = 1.0_f64;
                while !over.load(Ordering::Relaxed) {
                    number = black_box(number * 1.000_000_1 + 1e-9);
                }
            });
        }
        let result = work();
        over.store(true, Ordering::Relaxed);
        result
    })
}

/// Runs the loop of `runtime`, and returns the share of a core that it used.
fn our_loop(length: Duration, spin: Duration, periods: u64, series: &mut Series) -> f64 {
    let (began, began_ns) = (Usage::of_this_thread(), now_ns());
    let mut period = Period::starting_now(length).with_spin(spin);
    let mut waited = 0;
    while waited < periods {
        let wake = period.wait();
        // A loop that misses deadlines was late for each of them.
        for missed in (0..=wake.skipped).rev() {
            series.add(wake.late_ns as f64 + missed as f64 * length.as_nanos() as f64);
        }
        waited += 1 + wake.skipped;
    }
    Usage::of_this_thread().since(began).cpu_ns as f64 / (now_ns() - began_ns) as f64
}

/// Runs the simplest loop: absolute sleeps and nothing else.
fn bare_loop(length: Duration, periods: u64, series: &mut Series) {
    let length_ns = length.as_nanos() as u64;
    let mut deadline_ns = now_ns() + length_ns;
    for _ in 0..periods {
        let deadline =
            Timespec { tv_sec: (deadline_ns / 1_000_000_000) as i64, tv_nsec: (deadline_ns % 1_000_000_000) as i64 };
        let _ = clock_nanosleep_absolute(ClockId::Monotonic, &deadline);
        series.add(now_ns().saturating_sub(deadline_ns) as f64);
        deadline_ns += length_ns;
    }
}

/// Reads the clock without pause, and adds the longest time between two readings in each period.
fn longest_gaps(length: Duration, periods: u64, series: &mut Series) {
    let mut last_ns = now_ns();
    let over_ns = last_ns + periods * length.as_nanos() as u64;
    while last_ns < over_ns {
        let end_ns = last_ns + length.as_nanos() as u64;
        let mut longest_ns = 0;
        while last_ns < end_ns {
            let look_ns = now_ns();
            longest_ns = longest_ns.max(look_ns - last_ns);
            last_ns = look_ns;
            spin_loop();
        }
        series.add(longest_ns as f64);
    }
}
