//! Reproduces a figure of the paper: the path of the ZMP, and whether the paper's verdict is the same.

use crate::{GroundSplit, LeanAt, PaperLean, ZmpExtents, zmp_by_newton_euler, zmp_by_speed_law};
use dynamics::{Kinematics, NewtonEuler, Tree};
use gait::{Robot, WalkError};
use model::Motion;
use nalgebra::Vector2;

use super::{Reading, Scenario, SteadyHalfStep};

/// A figure of the paper, reproduced.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The scenario of the figure.
    pub scenario: Scenario,
    /// The two half-steps of the steady walk; equal when it walks straight.
    pub half_steps: [SteadyHalfStep; 2],
    /// Path of the ZMP in each half-step, in support coordinates (m).
    pub zmp: [Vec<Vector2<f64>>; 2],
    /// Path of the centre of mass in each half-step, in support coordinates (m).
    pub com: [Vec<Vector2<f64>>; 2],
    /// Extents of the ZMP path in each half-step.
    pub extents_of: [ZmpExtents; 2],
    /// Extents of the ZMP path in both half-steps.
    pub extents: ZmpExtents,
    /// The best lean of the same two joints, if the figure has a lean.
    pub best: Option<BestLean>,
    /// Greatest distance of the ZMP by the `c²` law from the ZMP by Newton–Euler (m).
    pub ways_differ: f64,
}

/// The smallest lean with the greatest minimum of the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestLean {
    /// The lean.
    pub lean: PaperLean,
    /// Least margin with this lean (m).
    pub margin: f64,
}

impl Figure {
    /// Whether every ZMP point of the steady half-steps is inside the sole.
    pub fn is_inside(&self) -> bool {
        self.extents.is_inside()
    }

    /// Whether the paper's verdict is the same; `None` when it states none.
    pub fn agrees(&self) -> Option<bool> {
        self.scenario.paper_verdict.agrees(self.is_inside())
    }
}

/// Computes the steady walk of a scenario and its ZMP.
///
/// # Errors
/// The mechanism cannot turn or extend its steps.
pub fn reproduce(robot: &Robot, reading: Reading, scenario: &Scenario) -> Result<Figure, WalkError> {
    let (tree, sole) = (Tree::new(&robot.mechanism), &robot.mechanism.sole);
    let speed = scenario.request.speed;
    let half_steps = SteadyHalfStep::steady(robot, &scenario.request, reading)?;
    let lean = scenario.lean.unwrap_or(PaperLean::none(LeanAt::Ankle));
    let leaning = |motions: &[Motion]| -> Vec<Motion> { motions.iter().map(|motion| lean.lean(motion)).collect() };

    // The two ways to the ZMP, and how far they are apart.
    let motions = half_steps.each_ref().map(|half_step| leaning(&half_step.at_speed(speed)));
    let zmp = motions.each_ref().map(|motions| zmp_by_newton_euler(&tree, motions).collect::<Vec<_>>());
    let by_law = half_steps.each_ref().map(|half_step| {
        let mut inverse = NewtonEuler::default();
        let leaning = leaning(&half_step.at_nominal_speed);
        let splits = leaning.iter().map(|motion| GroundSplit::of_motion(&mut inverse, &tree, motion));
        zmp_by_speed_law(&splits.collect::<Vec<_>>(), speed).collect::<Vec<_>>()
    });
    let pairs = zmp.iter().flatten().zip(by_law.iter().flatten());
    let ways_differ = pairs.map(|(one, other)| (one - other).norm()).fold(0.0, f64::max);

    let best = scenario.lean.map(|lean| {
        let both: Vec<Motion> = half_steps.iter().flat_map(|half_step| half_step.at_speed(speed)).collect();
        let best = PaperLean::best(&tree, sole, lean.at, &both);
        BestLean { lean: best, margin: best.extents(&tree, sole, &both).margin }
    });
    let com = |motion: &Motion| Kinematics::fixed_base(&tree, &motion.angles).com(&tree).xy();
    Ok(Figure {
        scenario: scenario.clone(),
        com: motions.each_ref().map(|motions| motions.iter().map(com).collect()),
        extents_of: zmp.each_ref().map(|path| ZmpExtents::of_path(path.iter().copied(), sole)),
        extents: ZmpExtents::of_path(zmp.iter().flatten().copied(), sole),
        half_steps,
        zmp,
        best,
        ways_differ,
    })
}
