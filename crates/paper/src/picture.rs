//! Picture of a figure of the paper: soles to scale, and the ZMP under the support foot, over full steps.

use charts::chart::{Chart, Map, Pen, Point, maps};
use charts::colours::{COM, LEFT, PLANNED, RIGHT, ZMP};
use charts::sole_outline::{draw_arrow_head, draw_sole, sole_outline};
use gait::{DeflectionPhase, Robot, WalkError};
use interface::Command;
use model::{Mechanism, Side};
use nalgebra::{Isometry2, Isometry3, Point2, Vector2, Vector3};

use super::{Figure, Reading, SteadyHalfStep, summary};

/// Scale of the picture (px/m).
const SCALE: f64 = 900.0;
/// Number of half-steps drawn for a straight walk, and for one that turns.
const STRAIGHT: usize = 3;
const TURNING: usize = 5;

/// Draws the footprints over full steps with the ZMP path of each half-step; for extended steps also the nominal
/// footprints, dashed.
///
/// # Errors
/// The mechanism cannot turn or extend its steps.
pub fn paper_figure(figure: &Figure, robot: &Robot, reading: Reading) -> Result<String, WalkError> {
    let (scenario, mechanism) = (&figure.scenario, &robot.mechanism);
    let turns = figure.half_steps[0].phase != DeflectionPhase::Straight;
    let count = if turns { TURNING } else { STRAIGHT };
    let mut chart = Chart::new("x [m]", "y [m]");

    if scenario.request.extension != 0.0 {
        let as_nominal = Command { extension: 0.0, ..scenario.request };
        let nominal = SteadyHalfStep::steady(robot, &as_nominal, reading)?;
        for (side, foot) in footprints(&nominal, count) {
            let corners = sole_outline(mechanism, side, &in_space(&foot));
            chart.line(corners.into_iter().chain([corners[0]]), Pen::dashed(PLANNED, 0.8));
        }
        chart.key_line("nominal steps", Pen::dashed(PLANNED, 0.8));
    }
    let prints = footprints(&figure.half_steps, count);
    for (side, foot) in &prints {
        draw_sole(&mut chart, mechanism, *side, &in_space(foot));
    }

    // The footprint before the first support foot is where the swing foot comes from.
    let (com, zmp) = (Pen::solid(COM, 0.8), Pen::solid(ZMP, 1.3));
    for (index, (side, foot)) in prints[1..=count].iter().enumerate() {
        let place = |point: &Vector2<f64>| -> Point {
            let y = if *side == Side::Left { -point.y } else { point.y };
            let place = foot * Point2::new(point.x, y);
            [place.x, place.y]
        };
        chart.line(figure.com[index % 2].iter().map(place), com);
        let path: Vec<Point> = figure.zmp[index % 2].iter().map(place).collect();
        draw_zmp(&mut chart, mechanism, &path, zmp);
    }
    chart.key_area("right sole", RIGHT);
    chart.key_area("left sole", LEFT);
    chart.key_line("ZMP", zmp);
    chart.key_line("centre of mass", com);
    let title = format!("Figure {}: {}", scenario.figure, summary(figure));
    Ok(maps(&title, vec![Map { chart, scale: SCALE }]))
}

/// The footprints of `count` half-steps with their sides, in world coordinates: where the first swing foot starts, then
/// the support feet, then the last landing. The first support foot is at the world's origin.
fn footprints(half_steps: &[SteadyHalfStep; 2], count: usize) -> Vec<(Side, Isometry2<f64>)> {
    let swing = |half_step: &SteadyHalfStep| match half_step.support {
        Side::Right => half_step.swing,
        Side::Left => half_step.swing.mirrored(),
    };
    let first = &half_steps[0];
    let mut foot = Isometry2::identity();
    let mut prints = vec![(first.support.other(), swing(first).leaves), (first.support, foot)];
    for half_step in half_steps.iter().cycle().take(count) {
        foot *= swing(half_step).lands;
        prints.push((half_step.support.other(), foot));
    }
    prints
}

/// Draws the path with a dot at its start and, unless it stays in one spot, an arrow head at its end.
fn draw_zmp(chart: &mut Chart, mechanism: &Mechanism, path: &[Point], pen: Pen) {
    chart.line(path.iter().copied(), pen);
    let size = mechanism.sole.half_size().y / 2.5;
    let (Some(&start), Some(&tip)) = (path.first(), path.last()) else { return };
    let dot = |corner: u32| {
        let angle = f64::from(corner) * std::f64::consts::FRAC_PI_4;
        [start[0] + 0.2 * size * angle.cos(), start[1] + 0.2 * size * angle.sin()]
    };
    chart.polygon(&std::array::from_fn::<_, 8, _>(|corner| dot(corner as u32)), pen, 1.0);
    let far = |point: &&Point| (tip[0] - point[0]).hypot(tip[1] - point[1]) > 0.5 * size;
    if let Some(before) = path.iter().rev().find(far) {
        draw_arrow_head(chart, tip, [tip[0] - before[0], tip[1] - before[1]], size, pen.colour);
    }
}

/// A pose on the floor as a pose in space.
fn in_space(pose: &Isometry2<f64>) -> Isometry3<f64> {
    let at = pose.translation.vector;
    Isometry3::new(Vector3::new(at.x, at.y, 0.0), Vector3::z() * pose.rotation.angle())
}
