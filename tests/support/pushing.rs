//! Pushes at a chosen place of the half-step, told from the robot itself.

use interface::{GaitChange, Intent};
use model::Side;
use nalgebra::{Vector2, Vector3};

use crate::walking::Walking;

/// How long a push lasts (s).
pub const PUSH_DURATION: f64 = 0.1;
/// How long a robot must walk on to have survived (s).
pub const WALKS_ON: f64 = 6.0;

/// Whither the trunk is pushed, seen from the support foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The way the support foot points.
    Forward,
    /// Ahead and towards the swinging foot.
    ForwardToSwing,
    /// Towards the swinging foot.
    ToSwing,
    /// Back and towards the swinging foot.
    BackToSwing,
    /// Against the way the support foot points.
    Back,
    /// Back and outward over the support foot.
    BackToSupport,
    /// Outward over the support foot.
    ToSupport,
    /// Ahead and outward over the support foot.
    ForwardToSupport,
}

impl Direction {
    /// All eight, each 45° from the one before.
    pub const ALL: [Direction; 8] = [
        Direction::Forward,
        Direction::ForwardToSwing,
        Direction::ToSwing,
        Direction::BackToSwing,
        Direction::Back,
        Direction::BackToSupport,
        Direction::ToSupport,
        Direction::ForwardToSupport,
    ];

    /// The impulse that the robot must survive at every phase of the nominal half-step (N·s).
    pub fn demanded(self) -> f64 {
        match self {
            Direction::Forward => 34.0,
            Direction::ForwardToSwing => 15.0,
            Direction::ToSwing => 11.0,
            Direction::BackToSwing => 15.0,
            Direction::Back => 30.0,
            Direction::BackToSupport => 20.0,
            Direction::ToSupport => 15.0,
            Direction::ForwardToSupport => 20.0,
        }
    }

    /// A unit vector: ahead, and towards the swinging foot.
    pub fn ahead_and_to_swing(self) -> Vector2<f64> {
        let diagonal = std::f64::consts::FRAC_1_SQRT_2;
        let [ahead, to_swing] = match self {
            Direction::Forward => [1.0, 0.0],
            Direction::ForwardToSwing => [diagonal, diagonal],
            Direction::ToSwing => [0.0, 1.0],
            Direction::BackToSwing => [-diagonal, diagonal],
            Direction::Back => [-1.0, 0.0],
            Direction::BackToSupport => [-diagonal, -diagonal],
            Direction::ToSupport => [0.0, -1.0],
            Direction::ForwardToSupport => [diagonal, -diagonal],
        };
        Vector2::new(ahead, to_swing)
    }

    /// In world axes, for a robot that bears on `support`.
    pub fn in_world(self, walking: &Walking, support: Side) -> Vector3<f64> {
        in_world(walking, support, self.ahead_and_to_swing())
    }
}

/// A unit vector in world axes, for a robot that bears on `support`.
///
/// * `angle` – from ahead towards the swinging foot (rad)
pub fn at_angle(walking: &Walking, support: Side, angle: f64) -> Vector3<f64> {
    in_world(walking, support, Vector2::new(angle.cos(), angle.sin()))
}

/// A vector ahead and towards the swinging foot in world axes.
fn in_world(walking: &Walking, support: Side, along: Vector2<f64>) -> Vector3<f64> {
    let ahead = walking.plant.truth().soles[support.index()].rotation * Vector3::x();
    let ahead = Vector3::new(ahead.x, ahead.y, 0.0).normalize();
    let left = Vector3::z().cross(&ahead);
    let to_swing = if support == Side::Right { left } else { -left };
    ahead * along.x + to_swing * along.y
}

/// Steps in place at a progress of a half-step, long after their beginning; `None` if the robot falls before.
pub fn step_in_place_to(seed: u64, half_step: u64, progress: f64) -> Option<Walking> {
    let mut walking = Walking::begin(seed);
    walking.ask(GaitChange::NONE, Some(Intent::InPlace));
    walk_on_to(walking, half_step, progress)
}

/// A robot that stands.
pub fn stand(seed: u64) -> Walking {
    let mut walking = Walking::stand(seed);
    walking.walk(1.0);
    walking
}

/// The walk by `request` at a progress of a half-step, long after its beginning; `None` if it falls before.
pub fn walk_to(seed: u64, request: GaitChange, half_step: u64, progress: f64) -> Option<Walking> {
    walk_on_by(Walking::begin(seed), request, half_step, progress)
}

/// The same of a walk that has just begun, whichever robot's it is.
pub fn walk_on_by(mut walking: Walking, request: GaitChange, half_step: u64, progress: f64) -> Option<Walking> {
    walking.ask(request, Some(Intent::Walk));
    walk_on_to(walking, half_step, progress)
}

fn walk_on_to(mut walking: Walking, half_step: u64, progress: f64) -> Option<Walking> {
    let report = walking.tick(None);
    // The slowest half-step takes about as many seconds as its inverse speed.
    let patience = 2.0 * half_step as f64 / report.command.speed;
    let there = |half_step_now: u64, progress_now: f64| {
        half_step_now > half_step || (half_step_now == half_step && progress_now >= progress)
    };
    walking
        .walk_until(patience, |report| there(report.report.half_step.index, report.report.half_step.progress))
        .ok()?;
    Some(walking)
}

/// Whether a copy of `walking`, pushed now by an impulse of so many N·s, still does what it did [`WALKS_ON`] seconds
/// later.
pub fn survives(walking: &Walking, direction: Direction, impulse: f64) -> bool {
    let along = direction.ahead_and_to_swing();
    survives_at(walking, along.y.atan2(along.x), impulse)
}

/// The same of a push at an angle from ahead towards the swinging foot (rad).
pub fn survives_at(walking: &Walking, angle: f64, impulse: f64) -> bool {
    let mut pushed = walking.clone();
    let report = pushed.tick(None).report;
    let (mode, support) = (report.mode, report.half_step.support);
    let push = at_angle(&pushed, support, angle) * impulse;
    pushed.plant.push(push, PUSH_DURATION);
    let fallen = pushed.walk(WALKS_ON).has_fallen();
    !fallen && pushed.tick(None).report.mode == mode
}
