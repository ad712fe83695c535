//! Random velocities in every direction, in our plant or in MuJoCo: no fall, and what is granted is walked.

use halfstep_tests::random;
use halfstep_tests::velocity::{MeanVelocity, random_velocity, true_pose};
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{Reply, Request, Source, Verdict, WalkPose, WalkVelocity};
use plant::Disturbances;
use rand::Rng;

use crate::cores::on_all_cores;
use crate::mujoco::{self, Outside};
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// How long each (s)
    #[arg(long, default_value_t = 600.0)]
    seconds: f64,
    /// In MuJoCo instead of our plant
    #[arg(long)]
    mujoco: bool,
    /// The first seed
    #[arg(long, default_value_t = 0)]
    first: u64,
}

/// A velocity is judged once all of it has been in effect for this long (s): a speed takes a ramp of 1.2 s.
const SETTLED: f64 = 1.5;
/// Over how long it is measured (s): over whole full steps, of which each foot makes one, that take about as long.
const MEASURED: f64 = 1.0;

/// Where the robot is at a time (s).
struct Sample {
    time: f64,
    half_step: u64,
    pose: WalkPose,
}

/// What became of a stream.
#[derive(Default)]
struct Stream {
    /// Accepted, limited, refused.
    verdicts: [u32; 3],
    /// Velocities that were measured, and those of them that were not walked.
    measured: u32,
    missed: u32,
    /// The largest deviation (m/s), and by what.
    worst: (f64, String),
    fall: Option<String>,
}

pub(crate) fn survey(options: &Options) -> bool {
    let streams = on_all_cores(options.seeds as usize, |seed| stream(options.first + seed as u64, options));
    let rows: Vec<Vec<String>> = streams
        .iter()
        .enumerate()
        .map(|(seed, Stream { verdicts, measured, missed, worst, fall })| {
            let mut row = vec![(options.first + seed as u64).to_string()];
            row.extend(verdicts.map(|count| count.to_string()));
            row.extend([measured.to_string(), missed.to_string(), format!("{:.3} {}", worst.0, worst.1)]);
            row.push(fall.clone().unwrap_or_else(|| "walks".into()));
            row
        })
        .collect();
    let header = ["seed", "accepted", "limited", "refused", "measured", "missed", "largest deviation m/s", "outcome"];
    table::print(&header, &rows);
    let falls = streams.iter().filter(|stream| stream.fall.is_some()).count();
    let (measured, missed) = streams.iter().fold((0, 0), |sum, one| (sum.0 + one.measured, sum.1 + one.missed));
    println!("{falls} falls of {} streams of {} s; {missed} of {measured} missed", streams.len(), options.seconds);
    falls == 0 && missed == 0
}

fn stream(seed: u64, options: &Options) -> Stream {
    let (mechanism, controller, plant) = (halfstep_tests::mechanism(), controller_parameters(), plant_parameters());
    let mut outside = options.mujoco.then(|| {
        let start = mujoco::start(&mechanism, &controller);
        Outside::begin(&mechanism, &plant, &Disturbances::default(), &start, seed)
    });
    let mut walking = Walking::begin_with(&mechanism, &controller, &plant, seed);
    let (mut random, mut next) = (random(seed), 1.0);
    let mut stream = Stream::default();
    // The true path since the last request, and the reply to it with the time from which all of it is in effect.
    let mut path: Vec<Sample> = Vec::new();
    let mut granted: Option<(Reply, Option<f64>)> = None;
    while walking.time() < options.seconds {
        let request = (walking.time() >= next).then(|| {
            stream.judge(&path, granted.as_ref());
            path.clear();
            granted = None;
            next = walking.time() + random.random_range(0.3..6.0);
            Request { velocity: Some(random_velocity(&mut random)), ..Request::new(Source::Console) }
        });
        let tick = walking.tick_in(request.as_ref(), |plant, setpoint| match &mut outside {
            Some(outside) => outside.step(plant, setpoint),
            None => plant.step(setpoint),
        });
        if let Some(reply) = tick.reply {
            let verdicts = [Verdict::Accepted, Verdict::Limited, Verdict::Refused];
            for (count, verdict) in stream.verdicts.iter_mut().zip(verdicts) {
                *count += u32::from(reply.verdict == verdict);
            }
            granted = Some((reply, None));
        }
        if let Some((reply, since @ None)) = &mut granted
            && tick.report.half_step.index >= reply.effect_half_step
        {
            *since = Some(walking.time());
        }
        let half_step = tick.report.half_step.index;
        path.push(Sample { time: walking.time(), half_step, pose: true_pose(&walking) });
        if walking.has_fallen(&tick) {
            stream.fall = Some(format!("fell at {:.2} s by {:?}", walking.time(), tick.command));
            break;
        }
    }
    stream
}

impl Stream {
    /// Compares the mean velocity of the last second with what was granted, if that has been in effect for long enough.
    fn judge(&mut self, path: &[Sample], granted: Option<&(Reply, Option<f64>)>) {
        let (Some((reply, Some(since))), Some(last)) = (granted, path.last()) else { return };
        let begins = |half_step: u64| path.partition_point(|sample| sample.half_step < half_step);
        let end = begins(last.half_step);
        let from = (1..).map(|full_steps| begins(last.half_step.saturating_sub(2 * full_steps)));
        let Some(from) = from.take(10).find(|&from| path[end].time - path[from].time > MEASURED - 0.2) else { return };
        if path[from].time < since + SETTLED {
            return;
        }
        let asked = reply.walk.velocity;
        let mut walked = MeanVelocity::since(path[from].time, path[from].pose);
        path[from..=end].iter().for_each(|sample| walked.add(sample.time, sample.pose));
        let walked = walked.value();
        let lost = (asked.ahead - walked.ahead).hypot(asked.left - walked.left);
        self.measured += 1;
        if lost > (0.1 * asked.ahead.hypot(asked.left)).max(0.02) {
            self.missed += 1;
        }
        if lost > self.worst.0 {
            let at = |velocity: &WalkVelocity| {
                format!("({:.3}, {:.3}, {:.1}°/s)", velocity.ahead, velocity.left, velocity.turn.to_degrees())
            };
            self.worst = (lost, format!("{} for {}", at(&walked), at(&asked)));
        }
    }
}
