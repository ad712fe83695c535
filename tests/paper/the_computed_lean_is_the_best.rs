//! Goal: the computed lean is the least that maximises the least margin of the half-step, and changes smoothly with the
//! command: the mean lean of neighbouring commands keeps nearly as much margin between them.
//!
//! Method: against all leans of a grid around it, and against the paper's own degrees; the mean against what is
//! computed afresh.

use dynamics::Tree;
use gait::Robot;
use halfstep_tests::paper::{reading, robot, scenario};
use interface::Command;
use model::Motion;
use nalgebra::Vector2;
use paper::{LeanAt, PaperLean, SteadyHalfStep, reproduce};

/// Both half-steps of a steady walk, as they are played.
fn motions(robot: &Robot, command: &Command) -> Vec<Motion> {
    let half_steps = SteadyHalfStep::steady(robot, command, reading()).unwrap();
    half_steps.iter().flat_map(|half_step| half_step.at_speed(command.speed)).collect()
}

#[test]
fn no_lean_nearby_is_better_than_the_computed_lean_or_as_good_and_smaller() {
    let robot = robot();
    let (tree, sole) = (Tree::new(&robot.mechanism), &robot.mechanism.sole);
    for (number, at) in
        [(7, LeanAt::Ankle), (16, LeanAt::Ankle), (29, LeanAt::Ankle), (20, LeanAt::Trunk), (22, LeanAt::Trunk)]
    {
        let motions = motions(&robot, &scenario(number).request);
        let best = PaperLean::best(&tree, sole, at, &motions);
        let margin = best.extents(&tree, sole, &motions).margin;
        for step in [0.02_f64, 0.5, 2.0].map(f64::to_radians) {
            for (first, second) in (-4..=4).flat_map(|first| (-4..=4).map(move |second| (first, second))) {
                let change = Vector2::new(f64::from(first), f64::from(second)) * step;
                let other = PaperLean { angles: best.angles + change, ..best };
                let others = other.extents(&tree, sole, &motions).margin;
                assert!(
                    others < margin + 5e-5,
                    "figure {number}: {other:?} has {others} m, the best {best:?} {margin} m"
                );
                let less = other.angles.norm() < best.angles.norm() - 0.5_f64.to_radians();
                assert!(!less || others < margin - 1e-6, "figure {number}: {other:?} is less and as good as {best:?}");
            }
        }
    }
}

#[test]
fn the_computed_lean_is_never_worse_than_the_papers() {
    let robot = robot();
    for number in (13..=22).chain(28..=37).chain([7, 41, 43, 47, 49]) {
        let figure = reproduce(&robot, reading(), &scenario(number)).unwrap();
        let best = figure.best.expect("the figure leans");
        assert!(best.margin >= figure.extents.margin, "figure {number}: {best:?}");
        assert!(best.margin > 0.0, "figure {number}: {best:?}");
    }
}

/// Commands 0.1, 10° and 5° apart, and the middle between them.
#[test]
fn mean_lean_of_neighbouring_commands_keeps_the_margin_between_them() {
    let robot = robot();
    let (tree, sole) = (Tree::new(&robot.mechanism), &robot.mechanism.sole);
    let command = |speed, turn: f64, extension: f64| Command {
        turn: turn.to_radians(),
        speed,
        extension: extension.to_radians(),
        sidestep: 0.0,
    };
    let compute = |command: &Command| PaperLean::best(&tree, sole, LeanAt::Ankle, &motions(&robot, command));
    for (speeds, turns, extensions) in [
        ([0.6, 0.7], vec![0.0], vec![0.0]),
        ([0.9, 1.0], vec![0.0, 10.0], vec![0.0]),
        ([1.1, 1.2], vec![0.0], vec![0.0, 5.0]),
        ([1.2, 1.3], vec![0.0, 10.0], vec![0.0, 5.0]),
        ([1.3, 1.4], vec![10.0, 20.0], vec![0.0]),
    ] {
        let mut corners = Vec::new();
        for &speed in &speeds {
            for &turn in &turns {
                corners.extend(extensions.iter().map(|&extension| compute(&command(speed, turn, extension)).angles));
            }
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let between = command(mean(&speeds), mean(&turns), mean(&extensions));
        let computed = compute(&between);
        let interpolated =
            PaperLean { angles: corners.iter().sum::<Vector2<f64>>() / corners.len() as f64, ..computed };
        let motions = motions(&robot, &between);
        let [interpolated, computed] = [interpolated, computed].map(|lean| lean.extents(&tree, sole, &motions).margin);
        assert!(interpolated > computed - 4e-3, "{between:?}: {interpolated} m by the mean, {computed} m computed");
    }
}
