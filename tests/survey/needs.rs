//! Needs: the paper's lean at ankle or trunk against what the preview adds, and what falls without either.

use config::{self, Document};
use controller::{Compensation, Parameters};
use dynamics::Tree;
use gait::{NominalTable, at_speed};
use halfstep_tests::walking::{Walking, controller_parameters, nominal, plant_parameters};
use halfstep_tests::{mechanism, repository};
use model::{Mechanism, Motion};
use nalgebra::Vector2;
use paper::{LeanAt, PaperLean};
use stabilizer::FeedbackParameters;

use crate::cores::on_all_cores;
use crate::playback::Playback;
use crate::watched::Watched;
use crate::{asked, table};

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How long each walk
    #[arg(long, default_value_t = 30.0)]
    seconds: f64,
}

const SPEEDS: [f64; 11] = [0.6, 0.7, 0.8, 0.9, 0.95, 1.0, 1.05, 1.1, 1.2, 1.3, 1.4];
/// The figures of straight walks at a speed, with and without leans.
const FIGURES: std::ops::RangeInclusive<u32> = 13..=37;
/// Half-steps of the nominal walk before the speed changes, and until the walk is steady again.
const ENTRY: u64 = 4;
const SETTLING: u64 = 8;

/// A lean of the paper.
struct Stated {
    speed: f64,
    lean: PaperLean,
}

/// What a speed needs, and what falls (s).
struct Need {
    best: [PaperLean; 2],
    /// Largest angles that the preview adds at ankle and waist, and the feedback at the ankle (rad).
    ours: [f64; 3],
    /// Without and with feedback: uncompensated, leaning at the ankle, leaning at the trunk, preview.
    falls: [[Option<f64>; 4]; 2],
}

pub(crate) fn survey(options: &Options) -> bool {
    let stated = stated();
    let needs = on_all_cores(SPEEDS.len(), |index| need(SPEEDS[index], &stated, options.seconds));

    println!(
        "Largest angles in degrees; the paper's as (first, second) joint, 3 and 4 at the ankle, 15 and 16 at the trunk:"
    );
    let rows: Vec<Vec<String>> = std::iter::zip(SPEEDS, &needs)
        .map(|(speed, need)| {
            let paper = [LeanAt::Ankle, LeanAt::Trunk].map(|at| of_paper(&stated, speed, at));
            let [ankle, waist, feedback] = need.ours.map(|angle| format!("{:.2}", angle.to_degrees()));
            vec![
                format!("{speed:.2}"),
                paper[0].as_ref().map_or_else(|| "–".into(), pair),
                pair(&need.best[0]),
                ankle,
                feedback,
                paper[1].as_ref().map_or_else(|| "–".into(), pair),
                pair(&need.best[1]),
                waist,
            ]
        })
        .collect();
    table::print(
        &[
            "c",
            "paper ankle",
            "computed ankle",
            "preview ankle",
            "feedback ankle",
            "paper trunk",
            "computed trunk",
            "preview trunk",
        ],
        &rows,
    );

    for (feedback, name) in ["without feedback", "with feedback"].into_iter().enumerate() {
        println!(
            "\nWhen it falls, {name}, in seconds (the lean is the paper's, or the computed one where it states none):"
        );
        let rows: Vec<Vec<String>> = std::iter::zip(SPEEDS, &needs)
            .map(|(speed, need)| {
                let falls = need.falls[feedback].map(|fall| fall.map_or("walks".into(), |at| format!("{at:.1}")));
                std::iter::once(format!("{speed:.2}")).chain(falls).collect()
            })
            .collect();
        table::print(&["c", "uncompensated", "lean at ankle", "lean at trunk", "preview"], &rows);
    }
    // Only what the controller does by itself must walk.
    needs.iter().all(|need| need.falls[1][3].is_none())
}

fn need(speed: f64, stated: &[Stated], seconds: f64) -> Need {
    let (mechanism, table, parameters) = (mechanism(), nominal(), controller_parameters());
    let motions = steady(&table, speed);
    let tree = Tree::new(&mechanism);
    let ats = [LeanAt::Ankle, LeanAt::Trunk];
    let best = ats.map(|at| PaperLean::best(&tree, &mechanism.sole, at, &motions));

    let steps = (seconds * speed / table.duration) as u64;
    let mut ours = [0.0; 3];
    let falls = [0.0, parameters.stabilizer.feedback.gain].map(|gain| {
        let feedback = FeedbackParameters { gain, ..parameters.stabilizer.feedback };
        let [ankle, trunk] = [0, 1].map(|place| {
            let lean = of_paper(stated, speed, ats[place]).unwrap_or(best[place]);
            let plant = plant_parameters();
            Playback::begin(&mechanism, table.clone(), &parameters.gait, &plant, feedback, speed, lean)
                .falls_within(seconds)
        });
        let controlled = |compensation| {
            let mut parameters = Parameters { compensation, ..parameters };
            parameters.stabilizer.feedback = feedback;
            walk(&mechanism, &parameters, speed, steps)
        };
        let (_, uncompensated) = controlled(Compensation::None);
        let (added, preview) = controlled(Compensation::Preview);
        // The last round is the controller as it is.
        ours = added;
        [uncompensated, ankle, trunk, preview]
    });
    Need { best, ours, falls }
}

/// Walks at a speed, entered from the nominal: the largest angles once it is steady, and when it fell.
fn walk(mechanism: &Mechanism, parameters: &Parameters, speed: f64, half_steps: u64) -> ([f64; 3], Option<f64>) {
    let mut watched = Watched::new(Walking::begin_with(mechanism, parameters, &plant_parameters(), 0));
    watched.walk_half_steps(ENTRY);
    watched.tick(Some(&asked::request(speed, 0.0, 0.0)));
    let mut largest: [f64; 3] = [0.0; 3];
    while watched.fall.is_none() && watched.report.report.half_step.index < ENTRY + SETTLING + half_steps {
        watched.tick(None);
        let report = &watched.report;
        if report.report.half_step.index >= ENTRY + SETTLING {
            let (ankle, waist) =
                report.report.added.map_or((0.0, 0.0), |added| (added.ankle.amax(), added.waist.amax()));
            let now = [ankle, waist, report.report.lean.amax()];
            largest = [0, 1, 2].map(|angle: usize| largest[angle].max(now[angle]));
        }
    }
    (largest, watched.fall.map(|fall| fall.time))
}

/// The nominal half-step at a constant speed.
fn steady(table: &NominalTable, speed: f64) -> Vec<Motion> {
    let intervals = table.intervals();
    (0..=intervals).map(|row| at_speed(&table.at(row as f64 / intervals as f64), speed, 0.0)).collect()
}

/// The leans that the paper states for straight walks, from `config/scenarios`.
fn stated() -> Vec<Stated> {
    FIGURES.filter_map(stated_in).collect()
}

/// Of one figure, if it leans. `halfstep check` reads these files strictly; here only what is needed is read.
fn stated_in(figure: u32) -> Option<Stated> {
    let file = repository().join(format!("config/scenarios/figure_{figure:02}.toml"));
    let text = config::read_text(&file).unwrap_or_else(|errors| panic!("{errors}"));
    let document = Document::parse(&text, &file.display().to_string()).unwrap_or_else(|errors| panic!("{errors}"));
    let root = document.root();
    root.has("lean").then(|| {
        let lean = root.table("lean");
        let at = lean.choice("at", [("ankle", LeanAt::Ankle), ("trunk", LeanAt::Trunk)]).expect("a place to lean at");
        let angles = Vector2::from(lean.angles("angles_deg").between(-45.0, 45.0));
        Stated { speed: root.table("request").number("speed").between(0.1, 2.0), lean: PaperLean { at, angles } }
    })
}

fn of_paper(stated: &[Stated], speed: f64, at: LeanAt) -> Option<PaperLean> {
    stated.iter().find(|it| it.speed == speed && it.lean.at == at).map(|it| it.lean)
}

fn pair(lean: &PaperLean) -> String {
    let [first, second] = [lean.angles.x, lean.angles.y].map(f64::to_degrees);
    format!("({first:.1}, {second:.1})")
}
