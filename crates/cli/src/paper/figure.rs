//! A figure reproduced: where its ZMP goes, and whether the paper saw the same.

use balance::{GroundSplit, LeanAt, PaperLean, ZmpExtents, zmp_by_newton_euler, zmp_by_speed_law};
use dynamics::{Kinematics, NewtonEuler, Tree};
use gait::WalkError;
use model::Motion;
use nalgebra::Vector2;

use super::{HalfStep, Reading, Scenario};
use crate::configuration::Robot;

/// A figure of the paper, reproduced.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What the paper did.
    pub scenario: Scenario,
    /// The two half-steps of the steady walk; alike when it goes straight on.
    pub half_steps: [HalfStep; 2],
    /// Path of the ZMP in each half-step, in support coordinates [m].
    pub zmp: [Vec<Vector2<f64>>; 2],
    /// Path of the centre of mass in each half-step, in support coordinates [m].
    pub com: [Vec<Vector2<f64>>; 2],
    /// What the ZMP covers in each half-step.
    pub extents_of: [ZmpExtents; 2],
    /// What the ZMP covers in both.
    pub extents: ZmpExtents,
    /// For a figure that leans, the lean that serves best at the same two joints.
    pub best: Option<BestLean>,
    /// Greatest distance of the ZMP by the `c²` law from the ZMP by Newton–Euler [m].
    pub ways_differ: f64,
}

/// The least lean that maximises the least margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestLean {
    /// The lean.
    pub lean: PaperLean,
    /// Its least margin [m].
    pub margin: f64,
}

impl Figure {
    /// Whether every ZMP point of the steady half-steps is inside the sole.
    pub fn is_inside(&self) -> bool {
        self.extents.is_inside()
    }

    /// Whether the paper says the same; `None` when it says nothing.
    pub fn agrees(&self) -> Option<bool> {
        self.scenario.paper_verdict.agrees(self.is_inside())
    }
}

/// Walks a scenario and sees where its ZMP goes.
///
/// # Errors
/// When the mechanism cannot turn or extend its steps.
pub fn reproduce(robot: &Robot, reading: Reading, scenario: &Scenario) -> Result<Figure, WalkError> {
    let (tree, sole) = (Tree::new(&robot.mechanism), &robot.mechanism.sole);
    let speed = scenario.request.speed;
    let half_steps = HalfStep::steady(robot, &scenario.request, reading)?;
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
    let com = |motion: &Motion| Kinematics::standing(&tree, &motion.angles).com(&tree).xy();
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
