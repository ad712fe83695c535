//! Random streams: a new request from the whole box every few half-steps.

use halfstep_tests::random;
use halfstep_tests::walking::{Walking, controller_parameters};
use interface::Verdict;
use rand::{Rng, rngs::StdRng};

use crate::asked;
use crate::cores::on_all_cores;
use crate::table::{self, millimetres};
use crate::watched::Watched;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// The first one's seed
    #[arg(long, default_value_t = 0)]
    first_seed: u64,
    /// How long each
    #[arg(long, default_value_t = 600.0)]
    seconds: f64,
    /// From the whole configured range, sideways and backward too, instead of the box of the first acceptance runs
    #[arg(long)]
    every_direction: bool,
}

/// What became of a stream.
struct Stream {
    verdicts: [u32; 3],
    watched: Watched,
}

pub(crate) fn survey(options: &Options) -> bool {
    let streams = on_all_cores(options.seeds as usize, |index| {
        let mut stream = Stream { verdicts: [0; 3], watched: Watched::new(Walking::begin(seed(options, index))) };
        let seed = seed(options, index);
        let mut source = if options.every_direction { Source::in_every_direction(seed) } else { Source::new(seed) };
        while stream.watched.fall.is_none() && stream.watched.walking.time() < options.seconds {
            let request = source.next(stream.watched.report.report.half_step.index);
            stream.watched.tick(request.as_ref());
            if let Some(answer) = stream.watched.report.reply {
                let verdicts = [Verdict::Accepted, Verdict::Limited, Verdict::Refused];
                for (count, verdict) in stream.verdicts.iter_mut().zip(verdicts) {
                    *count += u32::from(answer.verdict == verdict);
                }
            }
        }
        stream
    });

    let rows: Vec<Vec<String>> = streams
        .iter()
        .enumerate()
        .map(|(index, Stream { verdicts, watched })| {
            vec![
                seed(options, index).to_string(),
                watched.report.report.half_step.index.to_string(),
                verdicts[0].to_string(),
                verdicts[1].to_string(),
                verdicts[2].to_string(),
                millimetres(watched.least_margin),
                watched.fall.as_ref().map_or_else(|| "walks".into(), ToString::to_string),
            ]
        })
        .collect();
    table::print(&["seed", "half-steps", "accepted", "limited", "refused", "least margin mm", "outcome"], &rows);
    let falls = streams.iter().filter(|stream| stream.watched.fall.is_some()).count();
    println!("{falls} falls of {} streams of {} s", streams.len(), options.seconds);
    falls == 0
}

fn seed(options: &Options, index: usize) -> u64 {
    options.first_seed + index as u64
}

/// Where the requests come from: a new one every 2 to 6 half-steps.
pub(crate) struct Source {
    random: StdRng,
    next: u64,
    range: Range,
}

/// What the requests are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Range {
    /// The box of the first acceptance runs.
    FirstBox,
    /// The configured range of all gait parameters.
    Configured,
}

impl Source {
    /// The first request comes after two half-steps.
    pub(crate) fn new(seed: u64) -> Self {
        Self { random: random(seed), next: 2, range: Range::FirstBox }
    }

    /// The same, from the configured range.
    pub(crate) fn in_every_direction(seed: u64) -> Self {
        Self { range: Range::Configured, ..Self::new(seed) }
    }

    /// The request of this tick, in the half-step of this index.
    pub(crate) fn next(&mut self, half_step: u64) -> Option<interface::GaitChange> {
        (half_step >= self.next).then(|| {
            self.next = half_step + self.random.random_range(2..=6);
            match self.range {
                Range::FirstBox => asked::any(&mut self.random),
                Range::Configured => asked::any_direction(&mut self.random, &controller_parameters().gait.limits),
            }
        })
    }
}
