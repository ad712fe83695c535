//! `kill -9` of every process in every phase, and a stop during every kind of flood or starvation.

use std::path::PathBuf;
use std::time::Duration;

use halfstep_tests::command_line::CommandLine;
use halfstep_tests::kill_trial::{Aftermath, Phase, Victim, kill};
use halfstep_tests::random;
use rand::Rng;

use crate::cores::on_all_cores;
use crate::starvation;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// The program that is killed [default: the halfstep beside this program]
    #[arg(long)]
    halfstep: Option<PathBuf>,
    /// How many kills; 1000 take an hour on two cores
    #[arg(long, default_value_t = 200)]
    kills: usize,
    /// Share of the kills in the first tenth of a second of a start
    #[arg(long, default_value_t = 0.3)]
    starting: f64,
    /// How many stops during floods and starvation
    #[arg(long, default_value_t = 200)]
    stops: usize,
    /// Seed of the instants
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Only the stops, of this process's own mount namespace whose shared memory is full
    #[arg(long, hide = true)]
    full_memory: bool,
}

/// Latest kill after the beginning of a phase.
const DELAY_MAX: Duration = Duration::from_millis(100);

pub(crate) fn survey(options: &Options) -> bool {
    let beside = || std::env::current_exe().ok().map(|own| own.with_file_name("halfstep"));
    let program = options.halfstep.clone().or_else(beside).filter(|program| program.exists());
    let Some(program) = program.and_then(|program| program.canonicalize().ok()?.into_os_string().into_string().ok())
    else {
        println!(
            "no halfstep beside this program: build it (cargo build --release -p halfstep), or name it (--halfstep)"
        );
        return false;
    };
    if options.full_memory {
        return starvation::full_memory(&program, options.stops);
    }
    let killed = options.kills == 0 || kills(options, &program);
    let stopped = options.stops == 0 || starvation::survey(&program, options.stops);
    killed && stopped
}

/// The kills, a row of the table for each victim and phase.
fn kills(options: &Options, program: &str) -> bool {
    let starts = (options.kills as f64 * options.starting).round() as usize;
    let later: Vec<(Victim, Phase)> =
        Phase::ALL[1..].iter().flat_map(|&phase| Victim::ALL.map(|victim| (victim, phase))).collect();
    let trials: Vec<(Victim, Phase)> = (0..options.kills)
        .map(|number| match number.checked_sub(starts) {
            None => (Victim::ALL[number % Victim::ALL.len()], Phase::Starting),
            Some(number) => later[number % later.len()],
        })
        .collect();
    let done = on_all_cores(trials.len(), |number| {
        let (victim, phase) = trials[number];
        let mut random = random(options.seed + number as u64);
        let delay = DELAY_MAX.mul_f64(random.random_range(0.0..1.0));
        let aftermath = kill(&CommandLine::new(program), victim, phase, delay);
        if !aftermath.is_clean() {
            println!("{victim:?} {phase:?} after {} ms: {aftermath:#?}", delay.as_millis());
        }
        aftermath
    });

    let cells = Victim::ALL.into_iter().map(|victim| (victim, Phase::Starting)).chain(later);
    let rows: Vec<Vec<String>> = cells
        .filter_map(|cell| {
            let of_cell: Vec<&Aftermath> =
                trials.iter().zip(&done).filter(|(trial, _)| **trial == cell).map(|(_, done)| done).collect();
            (!of_cell.is_empty()).then(|| row(&format!("{:?}", cell.0), &format!("{:?}", cell.1), &of_cell))
        })
        .chain([row("all", "", &done.iter().collect::<Vec<_>>())])
        .collect();
    table::print(&["killed", "phase", "kills", "stuck", "leaked", "unreadable", "wrong replays"], &rows);
    done.iter().all(Aftermath::is_clean)
}

fn row(victim: &str, phase: &str, done: &[&Aftermath]) -> Vec<String> {
    let count = |texts: fn(&Aftermath) -> &Vec<String>| done.iter().filter(|one| !texts(one).is_empty()).count();
    let counts =
        [count(|one| &one.stuck), count(|one| &one.leaked), count(|one| &one.unreadable), count(|one| &one.wrong)];
    let texts = [victim.to_owned(), phase.to_owned(), done.len().to_string()];
    texts.into_iter().chain(counts.map(|count| count.to_string())).collect()
}
