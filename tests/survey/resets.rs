//! Resets after falls: the robot is pushed over to every side at every phase, put on its feet, reset, and walks; and it
//! is put down in other postures, and another robot in its place.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use halfstep_tests::fall_trial::{AfterReset, FallTrial};
use interface::Reason;
use model::Joint::{self, *};

use crate::cores::on_all_cores;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// Phases of the first two half-steps after the start at which each push begins
    #[arg(long, default_value_t = 6)]
    phases: u32,
    /// Seeds of the sensors' noise
    #[arg(long, default_value_t = 2)]
    seeds: u64,
    /// In MuJoCo instead of our plant
    #[cfg(feature = "mujoco")]
    #[arg(long)]
    mujoco: bool,
}

/// Where the pushes go, each 45° from the one before.
const DIRECTIONS: [&str; 8] =
    ["ahead", "ahead, left", "left", "back, left", "back", "back, right", "right", "ahead, right"];
/// Two half-steps (s), and the time before (s).
const STRIDE: f64 = 1.2;
const WALKS_FOR: f64 = 2.4;
/// How long the robot is held before the reset (s).
const HELD: [f64; 4] = [0.3, 0.5, 1.0, 4.0];

/// A row of the table: how the robot is put down.
struct Kind {
    name: &'static str,
    bent: &'static [(Joint, f64)],
    is_other: bool,
    /// Why the reset must be refused, if it must.
    refused: Option<Reason>,
}

const fn kind(name: &'static str, bent: &'static [(Joint, f64)], is_other: bool, refused: Option<Reason>) -> Kind {
    Kind { name, bent, is_other, refused }
}

const KINDS: [Kind; 17] = [
    kind("in a stand", &[], false, None),
    kind("another robot, in a stand", &[], true, None),
    kind("right knee bent by 1.7°", &[(RightKnee, -0.03)], false, None),
    kind("left hip pitched by 1.7°", &[(LeftHipPitch, -0.03)], false, None),
    kind("right knee bent by 5.7°", &[(RightKnee, -0.1)], false, Some(Reason::NotInStand)),
    kind("left hip pitched by 5.7°", &[(LeftHipPitch, 0.1)], false, Some(Reason::NotInStand)),
    kind("right ankle rolled by 1.7°", &[(RightAnkleRoll, 0.03)], false, None),
    kind("leaning ahead by 6.3°", &[(RightAnklePitch, 0.11), (LeftAnklePitch, -0.11)], false, None),
    kind("leaning back by 2.9°", &[(RightAnklePitch, -0.05), (LeftAnklePitch, 0.05)], false, None),
    kind("leaning aside by 2.9°", &[(RightAnkleRoll, 0.05), (LeftAnkleRoll, -0.05)], false, None),
    kind("bent ahead by 5.7°", &[(RightHipPitch, 0.1), (LeftHipPitch, -0.1)], false, None),
    kind("left shoulder turned by 57°", &[(LeftShoulder, 1.0)], false, None),
    kind("leaning back by 5.7°", &[(RightAnklePitch, -0.1), (LeftAnklePitch, 0.1)], false, Some(Reason::Margin)),
    kind(
        "crouching by 34° at the knees",
        &[
            (RightAnklePitch, 0.3),
            (RightKnee, -0.6),
            (RightHipPitch, 0.3),
            (LeftAnklePitch, -0.3),
            (LeftKnee, 0.6),
            (LeftHipPitch, -0.3),
        ],
        false,
        Some(Reason::NotInStand),
    ),
    kind("left hip rolled by 17°", &[(LeftHipRoll, 0.3)], false, Some(Reason::NotInStand)),
    kind("another robot, left hip rolled by 17°", &[(LeftHipRoll, 0.3)], true, Some(Reason::NotInStand)),
    kind("leaning ahead by 29°", &[(RightAnklePitch, 0.5), (LeftAnklePitch, -0.5)], false, Some(Reason::FaultPersists)),
];

pub(crate) fn survey(options: &Options) -> bool {
    let per_kind = DIRECTIONS.len() * options.phases as usize * options.seeds as usize;
    let outcomes = on_all_cores(KINDS.len() * per_kind, |index| {
        let (kind, run) = (&KINDS[index / per_kind], index % per_kind);
        let direction = run % DIRECTIONS.len();
        let phase = run / DIRECTIONS.len() % options.phases as usize;
        let trial = FallTrial {
            seed: (run / DIRECTIONS.len() / options.phases as usize) as u64,
            pushed_at: WALKS_FOR + STRIDE * phase as f64 / f64::from(options.phases),
            towards: TAU * direction as f64 / DIRECTIONS.len() as f64,
            lies_for: 1.0,
            held_for: HELD[run % HELD.len()],
            bent: kind.bent,
            is_other: kind.is_other,
        };
        #[cfg(feature = "mujoco")]
        if options.mujoco {
            return crate::mujoco::after_fall(&trial);
        }
        trial.run()
    });

    let mut passed = true;
    let rows: Vec<Vec<String>> = std::iter::zip(&KINDS, outcomes.chunks(per_kind))
        .map(|(kind, outcomes)| {
            let mut counts: BTreeMap<String, usize> = BTreeMap::new();
            for outcome in outcomes {
                passed &= *outcome == kind.refused.map_or(AfterReset::Walks, AfterReset::Refused);
                *counts.entry(text(outcome)).or_default() += 1;
            }
            let counts: Vec<String> = counts.into_iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
            vec![kind.name.to_owned(), outcomes.len().to_string(), counts.join(", ")]
        })
        .collect();
    table::print(&["put on its feet", "resets", "outcome"], &rows);
    passed
}

fn text(outcome: &AfterReset) -> String {
    match outcome {
        AfterReset::DidNotFall => "did not fall".into(),
        AfterReset::Refused(reason) => format!("refused ({reason})"),
        AfterReset::FellAgain(_) => "fell again".into(),
        AfterReset::Stuck(mode) => format!("stuck {mode}"),
        AfterReset::Walks => "walks".into(),
    }
}
