//! Stick figures on a plane: right limbs dark, left limbs light.

use std::f64::consts::TAU;

use dynamics::Kinematics;
use model::{LegReach, Mechanism, Side};
use nalgebra::{Point3, Vector3};
use synthesis::StickFigure;

use super::chart::{Chart, Pen, Point};

const RIGHT_LIMBS: Pen = Pen::solid("#00456E", 1.5);
const LEFT_LIMBS: Pen = Pen::solid("#F0A060", 1.3);
const BODY: Pen = Pen::solid("#444444", 1.3);
/// Radius of the head of the paper's robot (m); others have it in proportion.
const HEAD_RADIUS: f64 = 0.09;

/// Draws the robot as `onto` projects its points; its right limbs come last, over the others.
pub(super) fn draw_stick_figure(
    chart: &mut Chart,
    mechanism: &Mechanism,
    kinematics: &Kinematics,
    onto: impl Fn(&Vector3<f64>) -> Point,
) {
    let figure = StickFigure::new(mechanism, kinematics);
    let draw_side = |chart: &mut Chart, side: Side, pen: Pen| {
        let (leg, arm) = (&figure.legs[side.index()], &figure.arms[side.index()]);
        let sole_to_world = kinematics.sole_to_world(mechanism, side);
        let sole = mechanism.sole.corners(side).map(|corner| onto(&(sole_to_world * Point3::from(corner)).coords));
        chart.line([leg.hip, leg.knee, leg.ankle].map(|point| onto(&point)), pen);
        chart.line([leg.heel, leg.ankle, leg.toe].map(|point| onto(&point)), pen);
        chart.line(sole.into_iter().chain([sole[0]]), pen);
        chart.line([arm.shoulder, arm.elbow, arm.hand].map(|point| onto(&point)), pen);
    };

    draw_side(chart, Side::Left, LEFT_LIMBS);
    let [right, left] = [0, 1].map(|side| figure.legs[side].hip);
    chart.line([right, figure.waist, left, right].map(|point| onto(&point)), BODY);
    chart.line([0, 1].map(|side| onto(&figure.arms[side].shoulder)), BODY);
    let down = (figure.neck - figure.head).normalize();
    let radius = HEAD_RADIUS * LegReach::of(mechanism).scale();
    let chin = figure.head + 2.0 * radius * down;
    chart.line([figure.waist, figure.neck, chin].map(|point| onto(&point)), BODY);
    chart.line(circle(onto(&(figure.head + radius * down)), radius), BODY);
    draw_side(chart, Side::Right, RIGHT_LIMBS);
}

/// Points of a closed circle.
pub(super) fn circle([x, y]: Point, radius: f64) -> impl Iterator<Item = Point> {
    (0..=24).map(move |corner| {
        let angle = TAU * f64::from(corner) / 24.0;
        [x + radius * angle.cos(), y + radius * angle.sin()]
    })
}

/// Adds the colours of the limbs to the legend.
pub(super) fn key_sticks(chart: &mut Chart) {
    chart.key_line("right limbs", RIGHT_LIMBS);
    chart.key_line("left limbs", LEFT_LIMBS);
    chart.key_line("trunk", BODY);
}
