//! The sensor matrix: every kind of fault of every group of values, for a moment, for a while and for good, walking and
//! standing, in our plant or in MuJoCo. A fault must be noticed or do no harm: nobody falls without an alarm. Clean
//! walks raise none.

use std::collections::BTreeMap;

use clap::ValueEnum;
use config::Config;
use controller::Tick;
use halfstep_tests::pushing::{Direction, PUSH_DURATION};
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{Fault, GaitChange, Intent, Mode, Request, Source};
use plant::{Disturbances, Plant, PlantParameters};

use crate::cores::on_all_cores;
use crate::{streams, table};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Phases of the half-step at which each fault begins
    #[arg(long, default_value_t = 4)]
    phases: u32,
    /// How long each walk is watched after the onset (s)
    #[arg(long, default_value_t = 8.0)]
    watched: f64,
    /// Only faults whose name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// Only in this mode
    #[arg(long)]
    mode: Option<Activity>,
    /// In MuJoCo instead of our plant
    #[cfg(feature = "mujoco")]
    #[arg(long)]
    mujoco: bool,
    /// Print every run that fell
    #[arg(long)]
    runs: bool,
    /// How many clean streams are searched for false alarms
    #[arg(long, default_value_t = 5)]
    clean: u64,
    /// How long each clean stream (s)
    #[arg(long, default_value_t = 600.0)]
    clean_seconds: f64,
}

/// What the robot does when the fault begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Activity {
    Walking,
    Standing,
}

/// How long a fault lasts (s); the last is for good.
const DURATIONS: [(&str, f64); 3] = [("20 ms", 0.02), ("200 ms", 0.2), ("for good", 1e3)];
/// The first onset, and the time from the beginning to a stand (s).
const WALKING_FROM: f64 = 2.4;
const STANDING_FROM: f64 = 4.5;
/// Duration of the nominal half-step (s).
const HALF_STEP: f64 = 0.6;
/// How long a fall takes at most (s): what is said of a robot that trips is true.
const FALLING: f64 = 1.5;
/// A mass that bears the same push everywhere (N·s): what README promises, ahead, behind and aside.
const PUSHES: [(Direction, f64); 4] =
    [(Direction::Forward, 15.0), (Direction::Back, 15.0), (Direction::ToSupport, 6.0), (Direction::ToSwing, 6.0)];

/// A fault of the matrix: its row, and its lines of a script.
struct Cell {
    group: String,
    kind: String,
    script: String,
}

/// What became of a run.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    /// Time from the onset to the first alarm (s).
    noticed_after: Option<f64>,
    has_fallen: bool,
    mode: Mode,
}

pub(crate) fn survey(options: &Options) -> bool {
    let cells: Vec<Cell> = cells().into_iter().filter(|cell| cell.name().contains(&options.only)).collect();
    let activities = [Activity::Walking, Activity::Standing];
    let activities: Vec<Activity> =
        activities.into_iter().filter(|activity| options.mode.is_none_or(|only| only == *activity)).collect();
    let mut passed = true;
    for activity in activities {
        let per_cell = DURATIONS.len() * options.phases as usize;
        let outcomes = on_all_cores(cells.len() * per_cell, |index| {
            let (cell, run) = (&cells[index / per_cell], index % per_cell);
            let (duration, phase) = (DURATIONS[run / options.phases as usize].1, run as u32 % options.phases);
            run_cell(options, activity, cell, duration, phase)
        });
        passed &= print(options, activity, &cells, &outcomes);
    }
    passed & (options.clean == 0 || clean(options))
}

impl Cell {
    fn name(&self) -> String {
        format!("{} {}", self.group, self.kind)
    }
}

/// The onset of a fault (s).
fn onset(options: &Options, activity: Activity, phase: u32) -> f64 {
    let from = if activity == Activity::Walking { WALKING_FROM } else { STANDING_FROM };
    from + HALF_STEP * f64::from(phase) / f64::from(options.phases) + 0.03
}

fn run_cell(options: &Options, activity: Activity, cell: &Cell, duration: f64, phase: u32) -> Outcome {
    let start = onset(options, activity, phase);
    let script = format!("[[sensor_fault]]\nat_s = {start}\nlasts_s = {duration}\n{}", cell.script);
    let script = Disturbances::from_toml(&script, &cell.name()).unwrap_or_else(|error| panic!("{error}"));
    let mut walking = Walking::begin(u64::from(phase));
    walking.plant.disturbances = script;
    #[cfg(feature = "mujoco")]
    if options.mujoco {
        let (mechanism, controller) = (halfstep_tests::mechanism(), controller_parameters());
        let begins = crate::mujoco::start(&mechanism, &controller);
        let plant = plant_parameters();
        let mut engine =
            crate::mujoco::Outside::begin(&mechanism, &plant, &walking.plant.disturbances, &begins, u64::from(phase));
        return watch(options, activity, walking, start, |plant, setpoint| engine.step(plant, setpoint));
    }
    watch(options, activity, walking, start, Plant::step)
}

/// Walks, or comes to a stand, and watches what follows the onset.
fn watch(
    options: &Options,
    activity: Activity,
    mut walking: Walking,
    start: f64,
    mut step: impl FnMut(&mut Plant, &interface::Setpoint) -> interface::Measurement,
) -> Outcome {
    let mut outcome = Outcome { noticed_after: None, has_fallen: false, mode: Mode::Walking };
    let stop = Request { intent: Some(Intent::Stop), ..Request::new(Source::Console) };
    let mut is_stopped = activity == Activity::Walking;
    while walking.time() < start + options.watched {
        let request = (!is_stopped && walking.time() > 1.0).then_some(&stop);
        is_stopped |= request.is_some();
        let report = walking.tick_in(request, &mut step).report;
        outcome.mode = report.mode;
        // What follows a fall is no warning of it.
        let can_warn = walking.time() >= start && !outcome.has_fallen;
        if can_warn && outcome.noticed_after.is_none() && is_alarm(report.faults) {
            outcome.noticed_after = Some(walking.time() - start);
        }
        outcome.has_fallen |= walking.plant.truth().has_fallen();
    }
    outcome
}

/// Whether a measurement was rejected, or missed for too long. A fall that is noticed is no alarm.
fn is_alarm(faults: interface::Faults) -> bool {
    const ALARMS: [Fault; 8] = [
        Fault::MeasurementNotFinite,
        Fault::MeasurementImplausible,
        Fault::MeasurementStale,
        Fault::MeasurementOutOfOrder,
        Fault::MeasurementFrozen,
        Fault::MeasurementInconsistent,
        Fault::JointOffSetpoint,
        Fault::OrientationAskew,
    ];
    ALARMS.into_iter().any(|fault| faults.contains(fault))
}

/// Prints a row per fault; whether nobody fell unnoticed.
fn print(options: &Options, activity: Activity, cells: &[Cell], outcomes: &[Outcome]) -> bool {
    let phases = options.phases as usize;
    let mut rows = Vec::new();
    let mut unnoticed = BTreeMap::new();
    let (mut falls, mut believed) = (0, 0);
    for (cell, outcomes) in cells.iter().zip(outcomes.chunks(DURATIONS.len() * phases)) {
        let mut row = vec![cell.group.clone(), cell.kind.clone()];
        for ((name, _), outcomes) in DURATIONS.iter().zip(outcomes.chunks(phases)) {
            row.push(text(outcomes));
            falls += outcomes.iter().filter(|outcome| outcome.has_fallen).count();
            believed += outcomes.iter().filter(|outcome| outcome.is_believed_fallen()).count();
            let bad = outcomes.iter().filter(|outcome| outcome.is_unnoticed_fall()).count();
            if bad > 0 {
                unnoticed.insert(format!("{}, {name}", cell.name()), bad);
            }
        }
        rows.push(row);
    }
    println!("{activity:?}: phases noticed (after at most … ms), phases that fell");
    table::print(&["values", "kind", DURATIONS[0].0, DURATIONS[1].0, DURATIONS[2].0], &rows);
    if options.runs {
        for (index, outcome) in outcomes.iter().enumerate().filter(|(_, outcome)| outcome.has_fallen) {
            let run = index % (DURATIONS.len() * phases);
            let cell = &cells[index / (DURATIONS.len() * phases)];
            println!("{}, {}, phase {}: {outcome:?}", cell.name(), DURATIONS[run / phases].0, run % phases);
        }
    }
    println!(
        "{} runs, {falls} falls, {} of them unnoticed, {believed} believed fallen though upright",
        outcomes.len(),
        unnoticed.values().sum::<usize>()
    );
    for (cell, count) in &unnoticed {
        println!("unnoticed: {cell}: {count} of {phases}");
    }
    unnoticed.is_empty()
}

impl Outcome {
    fn is_unnoticed_fall(&self) -> bool {
        self.has_fallen && self.noticed_after.is_none()
    }

    fn is_believed_fallen(&self) -> bool {
        self.mode == Mode::Fallen && !self.has_fallen
    }
}

/// "4 (12) 1 falls": four phases noticed, the last after 12 ms, one fell.
fn text(outcomes: &[Outcome]) -> String {
    let noticed: Vec<f64> = outcomes.iter().filter_map(|outcome| outcome.noticed_after).collect();
    let latest = noticed.iter().copied().fold(0.0, f64::max);
    let falls = outcomes.iter().filter(|outcome| outcome.has_fallen).count();
    let mut text =
        if noticed.is_empty() { "–".to_owned() } else { format!("{} ({:.0})", noticed.len(), latest * 1e3) };
    if falls > 0 {
        text += &format!(" {falls} fell");
    }
    text
}

/// Walks that nothing is wrong with: random streams, with pushes, on tiles, on slopes. Whether no alarm was raised.
fn clean(options: &Options) -> bool {
    type Floor = (&'static str, fn(&mut PlantParameters));
    let floors: [Floor; 7] = [
        ("streams", |_| {}),
        ("streams and pushes", |_| {}),
        ("tiles 2 mm", |plant| plant.unevenness.height = 0.002),
        ("slope 2° up ahead", |plant| plant.slope.ahead = 2_f64.to_radians()),
        ("slope 2° down ahead", |plant| plant.slope.ahead = -2_f64.to_radians()),
        ("slope 2° to the left", |plant| plant.slope.left = 2_f64.to_radians()),
        ("sensor delay 3 ms", |plant| plant.sensors.delay_periods = 3),
    ];
    let count = floors.len() * options.clean as usize;
    let walks = on_all_cores(count, |index| {
        let (kind, seed) = (index / options.clean as usize, (index % options.clean as usize) as u64);
        let mut plant = plant_parameters();
        floors[kind].1(&mut plant);
        // Whatever is asked is walked on the level; other floors bear the nominal walk.
        walk_clean(options, &plant, seed, kind < 2, kind == 1)
    });
    let rows: Vec<Vec<String>> = walks
        .chunks(options.clean as usize)
        .zip(floors)
        .map(|(walks, (name, _))| {
            let sum = |of: fn(&Clean) -> u64| walks.iter().map(of).sum::<u64>().to_string();
            vec![name.into(), sum(|walk| walk.ticks), sum(|walk| walk.alarms), sum(|walk| u64::from(walk.has_fallen))]
        })
        .collect();
    println!("Clean walks, {} of {} s each:", options.clean, options.clean_seconds);
    table::print(&["", "ticks", "false alarms", "falls"], &rows);
    for (index, walk) in walks.iter().enumerate() {
        if let Some((tick, rejection)) = walk.first_alarm.map(|tick| (tick, tick.rejection)) {
            let (name, seed) = (floors[index / options.clean as usize].0, index % options.clean as usize);
            let why = rejection.map_or_else(|| "no sample".to_owned(), |rejection| rejection.to_string());
            println!("{name}, seed {seed}: {why}, in {:?} at {:?}", tick.report.mode, tick.report.half_step);
        }
    }
    walks.iter().all(|walk| walk.alarms == 0)
}

struct Clean {
    ticks: u64,
    alarms: u64,
    first_alarm: Option<Tick>,
    has_fallen: bool,
}

fn walk_clean(options: &Options, plant: &PlantParameters, seed: u64, is_streamed: bool, is_pushed: bool) -> Clean {
    let mut walking = Walking::begin_with(&halfstep_tests::mechanism(), &controller_parameters(), plant, seed);
    let mut source = streams::Source::new(seed);
    let mut clean = Clean { ticks: 0, alarms: 0, first_alarm: None, has_fallen: false };
    let (mut half_step, mut pushes) = (0, 0);
    let mut alarms = Vec::new();
    while walking.time() < options.clean_seconds && !clean.has_fallen {
        let request: Option<GaitChange> = if is_streamed && !is_pushed { source.next(half_step) } else { None };
        let tick = walking.tick(request.as_ref().map(|request| (request, None)));
        half_step = tick.report.half_step.index;
        if is_pushed && half_step >= 8 * (pushes + 1) {
            let (direction, impulse) = PUSHES[(pushes % 4) as usize];
            let push = direction.in_world(&walking, tick.report.half_step.support) * impulse;
            walking.plant.push(push, PUSH_DURATION);
            pushes += 1;
        }
        clean.has_fallen = walking.plant.truth().has_fallen();
        clean.ticks += 1;
        if !clean.has_fallen && is_alarm(tick.report.faults) {
            alarms.push((walking.time(), tick));
        }
    }
    if clean.has_fallen {
        let end = walking.time();
        alarms.retain(|(time, _)| end - time > FALLING);
    }
    clean.alarms = alarms.len() as u64;
    clean.first_alarm = alarms.first().map(|(_, tick)| *tick);
    clean
}

/// All faults of the matrix.
fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    let mut add = |group: &str, kind: &str, script: String| {
        cells.push(Cell { group: group.to_owned(), kind: kind.to_owned(), script });
    };
    for kind in ["drop_out", "half_rate"] {
        add("samples", kind, format!("kind = \"{kind}\""));
    }
    for late in [3, 10, 31] {
        add("samples", &format!("late by {late} ms"), format!("kind = \"delay\"\ndelay_periods = {late}"));
    }
    let joints = ["right_hip_roll", "right_knee", "left_ankle_pitch", "waist_roll", "left_shoulder"];
    let mut groups: Vec<(String, String, [&str; 3])> = vec![
        ("all".into(), "values = \"all\"".into(), ["", "", ""]),
        ("orientation".into(), "values = \"orientation\"".into(), ["size_deg = 3", "size_deg = -8", "size_deg = 30"]),
        (
            "angular rate".into(),
            "values = \"angular_rate\"".into(),
            ["size_deg_per_s = 30", "size_deg_per_s = -30", "size_deg_per_s = 200"],
        ),
        ("feet".into(), "values = \"feet\"".into(), ["size_n = 50", "size_n = -400", "size_n = 2000"]),
        (
            "right foot".into(),
            "values = \"feet\"\nfoot = \"right\"".into(),
            ["size_n = 50", "size_n = -400", "size_n = 2000"],
        ),
        ("angles".into(), "values = \"angles\"".into(), ["size_deg = 2", "size_deg = -10", "size_deg = 30"]),
        (
            "rates".into(),
            "values = \"rates\"".into(),
            ["size_deg_per_s = 30", "size_deg_per_s = -200", "size_deg_per_s = 1000"],
        ),
    ];
    for joint in joints {
        groups.push((
            joint.replace('_', " "),
            format!("values = \"angles\"\njoint = \"{joint}\""),
            ["size_deg = 2", "size_deg = -10", "size_deg = 30"],
        ));
    }
    for joint in &joints[..3] {
        groups.push((
            format!("{} rate", joint.replace('_', " ")),
            format!("values = \"rates\"\njoint = \"{joint}\""),
            ["size_deg_per_s = 30", "size_deg_per_s = -200", "size_deg_per_s = 1000"],
        ));
    }
    for (group, values, sizes) in groups {
        for kind in ["freeze", "nan", "reverse"] {
            // Every value of the opposite sign is no rotation and no sensor's fault.
            if (group.as_str(), kind) != ("all", "reverse") {
                add(&group, kind, format!("kind = \"{kind}\"\n{values}"));
            }
        }
        for size in sizes.into_iter().filter(|size| !size.is_empty()) {
            let amount = size.split(" = ").nth(1).unwrap_or_default();
            add(&group, &format!("off by {amount}"), format!("kind = \"spike\"\n{values}\n{size}"));
        }
        for (kind, size) in [("drift", 0), ("saturate", 0)] {
            if !sizes[size].is_empty() {
                add(&group, kind, format!("kind = \"{kind}\"\n{values}\n{}", sizes[size]));
            }
        }
        if matches!(group.as_str(), "feet" | "angles" | "rates" | "right hip roll" | "right knee") {
            add(&group, "swapped", format!("kind = \"swap\"\n{values}"));
        }
    }
    cells
}
