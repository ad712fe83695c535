//! Random goals and random lists of footsteps, in our plant or in MuJoCo: no fall, and the robot arrives where it was
//! asked to, by the plant's truth.

use std::f64::consts::PI;

use dynamics::poses_in_frame_of;
use halfstep_tests::destination::{STEPS, pose_error, random_footsteps, step_to, true_sole, walk_through};
use halfstep_tests::random;
use halfstep_tests::velocity::{to_half_circle, true_pose};
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::{Reply, Request, Verdict, WalkPose};
use model::Side;
use plant::Disturbances;
use rand::Rng;
use rand::rngs::StdRng;

use crate::cores::on_all_cores;
use crate::mujoco::Outside;
use crate::table;

#[derive(clap::Args)]
pub(crate) struct Options {
    /// How many
    #[arg(long, default_value_t = 200)]
    count: u64,
    /// Lists of footsteps instead of goals
    #[arg(long)]
    footsteps: bool,
    /// In MuJoCo instead of our plant
    #[arg(long)]
    mujoco: bool,
    /// Tell each of them
    #[arg(long)]
    each: bool,
    /// The first seed
    #[arg(long, default_value_t = 0)]
    first: u64,
}

/// Farthest goal, along x and y (m).
const DISTANCE_MAX: f64 = 4.0;
/// How near the robot must come to a goal: m and rad.
const NEAR_GOAL: [f64; 2] = [0.03, 2.0 / 180.0 * PI];
/// How near each foot must land to where it was asked to: m and rad.
const NEAR_FOOTSTEP: [f64; 2] = [0.01, 1.0 / 180.0 * PI];
/// When in a half-step it is measured (ticks).
const MEASURED: u32 = 200;
/// Largest half-step back, as a share of that ahead.
const BACK: f64 = 0.6;
/// Time that the weight takes to shift before the first step and after the last one (s).
const AT_ENDS: f64 = 2.0;
/// Longest walk (s).
const PATIENCE: f64 = 90.0;

/// What became of a walk.
#[derive(Default)]
struct Outcome {
    name: String,
    verdict: Option<Verdict>,
    /// Largest error of the goal or of a footstep: m and rad.
    error: [f64; 2],
    /// By how much more the estimate errs than that (m).
    estimated: f64,
    /// Time until the robot stood, and the time that its speeds allow (s).
    time: [f64; 2],
    trouble: Option<String>,
}

pub(crate) fn survey(options: &Options) -> bool {
    let outcomes = on_all_cores(options.count as usize, |seed| trial(options.first + seed as u64, options));
    let near = if options.footsteps { NEAR_FOOTSTEP } else { NEAR_GOAL };
    let is_good = |outcome: &Outcome| {
        outcome.trouble.is_none()
            && outcome.error[0] <= near[0]
            && outcome.error[1] <= near[1]
            && (options.footsteps || outcome.time[0] <= 1.5 * outcome.time[1] + AT_ENDS)
    };
    let rows: Vec<Vec<String>> = outcomes
        .iter()
        .enumerate()
        .filter(|(_, outcome)| options.each || !is_good(outcome))
        .map(|(seed, outcome)| {
            vec![
                (options.first + seed as u64).to_string(),
                outcome.name.clone(),
                outcome.verdict.map_or_else(|| "-".into(), |verdict| verdict.to_string()),
                table::millimetres(outcome.error[0]),
                format!("{:.2}", outcome.error[1].to_degrees()),
                table::millimetres(outcome.estimated),
                format!("{:.1} of {:.1}", outcome.time[0], outcome.time[1]),
                outcome.trouble.clone().unwrap_or_else(|| "arrives".into()),
            ]
        })
        .collect();
    let header = ["seed", "asked", "verdict", "off mm", "off °", "estimate off mm", "time s", "outcome"];
    table::print(&header, &rows);
    let count = |verdict| outcomes.iter().filter(|outcome| outcome.verdict == Some(verdict)).count();
    let [off, turned] = [0, 1].map(|part| outcomes.iter().map(|outcome| outcome.error[part]).fold(0.0, f64::max));
    let slowest = outcomes.iter().map(|outcome| (outcome.time[0] - AT_ENDS) / outcome.time[1].max(1e-9));
    println!(
        "{} of {}: {} accepted, {} limited, {} refused; at most {} mm and {:.2}° off; at most {:.2} × the time that \
         its speeds allow, beside {AT_ENDS} s at both ends; {} not as asked",
        if options.footsteps { "lists" } else { "goals" },
        outcomes.len(),
        count(Verdict::Accepted),
        count(Verdict::Limited),
        count(Verdict::Refused),
        table::millimetres(off),
        turned.to_degrees(),
        slowest.fold(0.0, f64::max),
        outcomes.iter().filter(|outcome| !is_good(outcome)).count(),
    );
    outcomes.iter().all(is_good)
}

fn trial(seed: u64, options: &Options) -> Outcome {
    let mut random = random(seed);
    let mut walk = Walk::stand(seed, options.mujoco);
    if options.footsteps { walk_footsteps(&mut walk, &mut random) } else { walk_to_goal(&mut walk, &mut random) }
}

fn walk_to_goal(walk: &mut Walk, random: &mut StdRng) -> Outcome {
    let [x, y] = [(); 2].map(|()| random.random_range(-DISTANCE_MAX..=DISTANCE_MAX));
    let goal = WalkPose { x, y, heading: random.random_range(-PI..=PI) };
    let mut outcome = Outcome { name: told(&goal), ..Outcome::default() };
    let Some(reply) = walk.go(&walk_through(&[goal]), &mut outcome) else { return outcome };
    let began = walk.walking.time();
    let arrived = walk.until_arrived(&mut outcome, |_| {});
    outcome.time = [walk.walking.time() - began, least_time(&goal, &reply)];
    if arrived {
        walk.rest();
        let [expected] = poses_in_frame_of(&walk.origin, &[goal]);
        outcome.error = pose_error(&expected, &true_pose(&walk.walking));
        let estimate = walk.estimate;
        outcome.estimated = pose_error(&poses_in_frame_of(&walk.origin, &[estimate])[0], &true_pose(&walk.walking))[0];
    }
    outcome
}

/// The time that the granted speeds allow (s): ahead with a turn before and after, or straight there in any direction.
fn least_time(goal: &WalkPose, reply: &Reply) -> f64 {
    let speeds = reply.walk.velocity;
    let (distance, bearing) = (goal.x.hypot(goal.y), goal.y.atan2(goal.x));
    let turns = bearing.abs() + to_half_circle(goal.heading - bearing).abs();
    let ahead = distance / speeds.ahead + turns / speeds.turn;
    let along = if goal.x < 0.0 { BACK * speeds.ahead } else { speeds.ahead };
    let parts = [goal.x / along, goal.y / speeds.left, goal.heading / speeds.turn];
    ahead.min(parts.iter().map(|part| part * part).sum::<f64>().sqrt())
}

fn walk_footsteps(walk: &mut Walk, random: &mut StdRng) -> Outcome {
    let first = if random.random() { Side::Left } else { Side::Right };
    let footsteps = random_footsteps(random, first);
    let mut outcome =
        Outcome { name: format!("{first:?} first, to {}", told(&footsteps[STEPS - 1].sole)), ..Outcome::default() };
    if walk.go(&step_to(&footsteps), &mut outcome).is_none() {
        return outcome;
    }
    // Each foot is measured in the half-step in which it bears, the last one in the stand.
    let stands_on = walk.support;
    let first_landed = walk.half_step + 1 + u64::from(first == stands_on);
    let (mut worst, mut measured, mut ticks) = ([0.0_f64; 2], 0, (u64::MAX, 0));
    let mut measure = |walk: &Walk, index: usize| {
        let footstep = &footsteps[index];
        let [expected] = poses_in_frame_of(&walk.origin, &[footstep.sole]);
        let off = pose_error(&expected, &true_sole(&walk.walking, footstep.side));
        worst = [0, 1].map(|part| worst[part].max(off[part]));
        measured += 1;
    };
    let arrived = walk.until_arrived(&mut outcome, |walk| {
        ticks = if walk.half_step == ticks.0 { (ticks.0, ticks.1 + 1) } else { (walk.half_step, 0) };
        let landed = walk.half_step.checked_sub(first_landed).map(|index| index as usize);
        if let Some(index) = landed.filter(|&index| ticks.1 == MEASURED && index + 1 < STEPS) {
            measure(walk, index);
        }
    });
    if arrived {
        walk.rest();
        measure(walk, STEPS - 1);
    }
    outcome.error = worst;
    if arrived && measured != STEPS {
        outcome.trouble = Some(format!("{measured} of {STEPS} footsteps seen"));
    }
    outcome
}

/// A walk from a stand, in either plant.
struct Walk {
    walking: Walking,
    outside: Option<Outside>,
    /// The walk frame in the world.
    origin: WalkPose,
    estimate: WalkPose,
    places_left: u32,
    half_step: u64,
    support: Side,
}

impl Walk {
    fn stand(seed: u64, mujoco: bool) -> Self {
        let (mechanism, plant) = (halfstep_tests::mechanism(), plant_parameters());
        let walking = Walking::stand(seed);
        let outside = mujoco.then(|| {
            let start = halfstep_tests::walking::standing(&mechanism, &controller_parameters());
            Outside::begin(&mechanism, &plant, &Disturbances::default(), &start, seed)
        });
        let origin = true_pose(&walking);
        let (estimate, support) = (WalkPose::default(), Side::Right);
        Self { walking, outside, origin, estimate, places_left: u32::MAX, half_step: 0, support }
    }

    fn tick(&mut self, request: Option<&Request>) -> controller::Tick {
        let Self { walking, outside, .. } = self;
        let tick = walking.tick_in(request, |plant, setpoint| match outside {
            Some(outside) => outside.step(plant, setpoint),
            None => plant.step(setpoint),
        });
        self.estimate = tick.report.odometry.pose;
        self.places_left = tick.report.destination.map_or(u32::MAX, |progress| progress.places_left);
        (self.half_step, self.support) = (tick.report.half_step.index, tick.report.half_step.support);
        tick
    }

    /// Stands until it has come to rest.
    fn rest(&mut self) {
        (0..500).for_each(|_| _ = self.tick(None));
    }

    /// Stands for a while and asks; the reply, unless it is a refusal.
    fn go(&mut self, request: &Request, outcome: &mut Outcome) -> Option<Reply> {
        self.rest();
        let mut reply = self.tick(Some(request)).reply;
        while reply.is_none() {
            reply = self.tick(None).reply;
        }
        let reply = reply?;
        outcome.verdict = Some(reply.verdict);
        if reply.verdict == Verdict::Refused {
            outcome.trouble =
                Some(format!("refused: {}, place {:?}, {:?}", reply.reason, reply.place, reply.active_limit));
            return None;
        }
        Some(reply)
    }

    /// Walks until the robot stands at its destination.
    fn until_arrived(&mut self, outcome: &mut Outcome, mut watch: impl FnMut(&Self)) -> bool {
        let end = self.walking.time() + PATIENCE;
        loop {
            let tick = self.tick(None);
            watch(self);
            if self.walking.has_fallen(&tick) {
                outcome.trouble = Some(format!("fell at {:.2} s", self.walking.time()));
                return false;
            } else if self.places_left == 0 {
                return true;
            } else if self.walking.time() > end {
                outcome.trouble = Some("never arrives".into());
                return false;
            }
        }
    }
}

fn told(pose: &WalkPose) -> String {
    format!("({:.2}, {:.2}, {:.0}°)", pose.x, pose.y, pose.heading.to_degrees())
}
