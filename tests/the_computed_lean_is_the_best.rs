//! Goal: the computed lean is the least that maximises the least margin of the half-step, and a table of leans gives nearly
//! as much between its knots without any dynamics.
//!
//! Method: against all leans of a grid around it, and against the paper's own degrees; the table against what is computed
//! afresh between its knots.

use balance::{LeanAt, LeanTable, PaperLean};
use dynamics::Tree;
use gait::Command;
use halfstep::configuration::Robot;
use halfstep::paper::{HalfStep, reproduce};
use halfstep_tests::paper::{reading, robot, scenario};
use model::Motion;
use nalgebra::Vector2;

/// Both half-steps of a steady walk, as they are played.
fn motions(robot: &Robot, command: &Command) -> Vec<Motion> {
    let half_steps = HalfStep::steady(robot, command, reading()).unwrap();
    half_steps.iter().flat_map(|half_step| half_step.at_speed(command.speed)).collect()
}

#[test]
fn no_lean_nearby_is_better_and_none_as_good_is_less() {
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
fn it_is_never_worse_than_the_papers() {
    let robot = robot();
    for number in (13..=22).chain(28..=37).chain([7, 41, 43, 47, 49]) {
        let figure = reproduce(&robot, reading(), &scenario(number)).unwrap();
        let best = figure.best.expect("the figure leans");
        assert!(best.margin >= figure.extents.margin, "figure {number}: {best:?}");
        assert!(best.margin > 0.0, "figure {number}: {best:?}");
    }
}

#[test]
fn a_table_serves_between_its_knots() {
    let robot = robot();
    let (tree, sole) = (Tree::new(&robot.mechanism), &robot.mechanism.sole);
    let command = |speed, turn: f64, extension: f64| Command { turn, speed, extension };
    let compute = |speed, turn, extension| {
        PaperLean::best(&tree, sole, LeanAt::Ankle, &motions(&robot, &command(speed, turn, extension))).angles
    };
    let turns = [0.0_f64, 10.0, 20.0].map(f64::to_radians);
    let extensions = [0.0_f64, 5.0].map(f64::to_radians);
    let speeds = [0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4];
    let table = LeanTable::compute(LeanAt::Ankle, &speeds, &turns, &extensions, compute).unwrap();
    for (speed, turn, extension) in
        [(0.65, 0.0, 0.0), (0.95, 5.0, 0.0), (1.15, 0.0, 2.5), (1.25, 5.0, 2.5), (1.35, 15.0, 0.0)]
    {
        let command = command(speed, f64::to_radians(turn), f64::to_radians(extension));
        let motions = motions(&robot, &command);
        let interpolated = table.lean(command.speed, command.turn, command.extension);
        let computed = PaperLean { angles: compute(command.speed, command.turn, command.extension), ..interpolated };
        let [interpolated, computed] = [interpolated, computed].map(|lean| lean.extents(&tree, sole, &motions).margin);
        assert!(interpolated > computed - 4e-3, "{command:?}: {interpolated} m between knots, {computed} m computed");
    }
}
