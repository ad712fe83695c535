//! The soles on the ground: a spring and damper under each corner, and bristles for dry friction.
//!
//! * Normal: `F_n = k·depth − d·v_n`, never pulling, along the normal of the ground.
//! * Tangential: a bristle with spring and damper, held until it would exceed `μ·F_n`; then it slides along and keeps
//!   the deflection that the cone allows (Cundall and Strack 1979). Unlike a friction that needs speed it lets a loaded
//!   sole stand still. Only slip bends a bristle: what its damper adds may hit the cone, but bends nothing.
//!
//! All forces are those at the *end* of the integration step, linearised: see [`LinkLoad::added_inertia`].
//!
//! On ground with steps, ramps or a height field, points between the corners bear where it rises over what the corners
//! stand on, and a corner that has gone into a step from the side is pushed out again.

use config::Table;
use dynamics::LinkLoad;
use model::{Joint, Mechanism, Side, Sole, Wrench};
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector3, Vector6};

use crate::sole_point::SolePoint;
use crate::{Ground, Surface};

/// The contact of sole and ground, per corner of the sole; table `[contact]` of `config/plant.toml`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactParameters {
    /// Normal stiffness (N/m). Tipping stiffness follows: four corners 4 cm off the middle must be far stiffer than the
    /// robot's own fall (m·g·h ≈ 700 N·m/rad).
    pub stiffness: f64,
    /// Normal damping (N·s/m).
    pub damping: f64,
    /// Stiffness of the friction bristle (N/m).
    pub stiffness_tangential: f64,
    /// Damping of the friction bristle (N·s/m).
    pub damping_tangential: f64,
    /// Friction coefficient `μ` (-).
    pub friction: f64,
}

/// Both soles on the ground.
#[derive(Clone, Debug)]
pub struct GroundContact {
    /// The right sole, then the left one.
    pub feet: [FootContact; 2],
}

/// One sole on the ground.
#[derive(Clone, Debug)]
pub struct FootContact {
    /// The joint whose link is the foot.
    link: Joint,
    corners: [Corner; Sole::CORNERS],
    between: [PointBetween; SolePoint::COUNT],
    /// Force of the ground on the foot at the end of the last step, about the right sole's origin in world axes.
    load: LinkLoad,
}

/// One corner of a sole.
#[derive(Clone, Copy, Debug, Default)]
struct Corner {
    /// Position of the corner in the foot link's frame (m).
    in_link: Vector3<f64>,
    /// The bristle on the floor.
    floor: Bristle,
    /// The bristle on the side of a step.
    wall: Bristle,
}

/// A point of a sole between the corners.
#[derive(Clone, Copy, Debug)]
struct PointBetween {
    /// Position of the point in the foot link's frame (m).
    in_link: Vector3<f64>,
    /// How much of each corner's height a plane through the corners has here (-).
    shares: [f64; Sole::CORNERS],
    floor: Bristle,
}

/// The bristle of dry friction at a point: its deflection along the surface, in world axes (m).
#[derive(Clone, Copy, Debug, Default)]
struct Bristle(Vector3<f64>);

/// A point of a sole over an integration step.
#[derive(Clone, Copy)]
struct MovingPoint {
    /// Position from the right sole's origin, in world axes (m).
    arm: Vector3<f64>,
    /// Velocity in world axes (m/s).
    velocity: Vector3<f64>,
    /// Length of the integration step (s).
    step: f64,
}

/// Pose and velocity of a foot link, about the right sole's origin in world axes.
#[derive(Clone, Copy, Debug)]
pub struct FootMotion {
    /// Orientation of the link, a rotation matrix (-): maps link coordinates to world axes.
    pub rotation: Matrix3<f64>,
    /// Position of the link's origin relative to the right sole's origin, in world axes (m).
    pub origin: Vector3<f64>,
    /// Spatial velocity of the link: angular (rad/s), then linear at the right sole's origin (m/s).
    pub velocity: Vector6<f64>,
}

impl ContactParameters {
    /// Reads the table `[contact]`.
    pub(crate) fn read(table: &Table) -> Self {
        Self {
            stiffness: table.number("stiffness_n_per_m").between(1e3, 1e8),
            damping: table.number("damping_n_s_per_m").between(0.0, 1e6),
            stiffness_tangential: table.number("stiffness_tangential_n_per_m").between(1e3, 1e8),
            damping_tangential: table.number("damping_tangential_n_s_per_m").between(0.0, 1e6),
            friction: table.number("friction").between(0.01, 10.0),
        }
    }

    /// With springs and dampers of a share of the strength.
    fn scaled(&self, share: f64) -> Self {
        Self {
            stiffness: self.stiffness * share,
            damping: self.damping * share,
            stiffness_tangential: self.stiffness_tangential * share,
            damping_tangential: self.damping_tangential * share,
            friction: self.friction,
        }
    }
}

impl GroundContact {
    /// Both soles of a mechanism, their bristles undeflected.
    pub fn new(mechanism: &Mechanism) -> Self {
        Self { feet: Side::BOTH.map(|side| FootContact::new(mechanism, side)) }
    }
}

impl FootContact {
    fn new(mechanism: &Mechanism, side: Side) -> Self {
        let link = mechanism.foot(side);
        let offset = mechanism.sole_in_foot(side);
        let between = SolePoint::all(&mechanism.sole, side).map(|point| PointBetween {
            in_link: point.in_sole + offset,
            shares: point.shares,
            floor: Bristle::default(),
        });
        Self {
            link,
            corners: mechanism
                .sole
                .corners(side)
                .map(|corner| Corner { in_link: corner + offset, ..Corner::default() }),
            between,
            load: LinkLoad { link, wrench: Wrench::ZERO, added_inertia: Matrix6::zeros() },
        }
    }

    /// The force of the ground on the foot at the end of the coming step, linear in the foot's acceleration over the
    /// step.
    ///
    /// * `base` – position of the right sole's origin in the world (m)
    /// * `ground` – what the soles stand on
    /// * `step` – length of the integration step (s)
    pub fn forces_at_step_end(
        &mut self,
        foot: &FootMotion,
        base: &Vector3<f64>,
        ground: &Ground,
        parameters: &ContactParameters,
        step: f64,
    ) -> &LinkLoad {
        let angular = foot.velocity.fixed_rows::<3>(0).into_owned();
        let linear = foot.velocity.fixed_rows::<3>(3).into_owned();
        self.load = LinkLoad { link: self.link, wrench: Wrench::ZERO, added_inertia: Matrix6::zeros() };

        let moving = |in_link: &Vector3<f64>| {
            let arm = foot.origin + foot.rotation * in_link;
            MovingPoint { arm, velocity: linear + angular.cross(&arm), step }
        };
        for corner in &mut self.corners {
            let point = moving(&corner.in_link);
            let touch = ground.touch(&(base + point.arm));
            corner.floor.press(&touch.floor, &point, parameters, &mut self.load);
            match touch.wall {
                Some(wall) => corner.wall.press(&wall, &point, parameters, &mut self.load),
                None => corner.wall = Bristle::default(),
            }
        }
        if ground.has_relief() {
            let heights = self.corners.map(|corner| ground.height((base + moving(&corner.in_link).arm).xy()));
            for between in &mut self.between {
                let point = moving(&between.in_link);
                let place = base + point.arm;
                let under_corners: f64 = std::iter::zip(heights, between.shares).map(|(h, share)| h * share).sum();
                let share = SolePoint::bearing_share(ground.height(place.xy()) - under_corners);
                if share > 0.0 {
                    let floor = ground.touch(&place).floor;
                    between.floor.press(&floor, &point, &parameters.scaled(share), &mut self.load);
                } else {
                    between.floor = Bristle::default();
                }
            }
        }
        &self.load
    }

    /// The force of the ground on the foot over the step, once the foot's spatial acceleration is known: about the
    /// right sole's origin, in world axes.
    pub fn resolve(&self, acceleration: &Vector6<f64>) -> Wrench {
        let yielded = self.load.added_inertia * acceleration;
        self.load.wrench
            - Wrench { moment: yielded.fixed_rows::<3>(0).into_owned(), force: yielded.fixed_rows::<3>(3).into_owned() }
    }
}

impl Bristle {
    /// Adds the force of a surface on a point to a load.
    fn press(&mut self, surface: &Surface, point: &MovingPoint, parameters: &ContactParameters, load: &mut LinkLoad) {
        let (MovingPoint { arm, velocity, step }, Surface { depth, normal: up, friction }) = (*point, *surface);
        let rising = velocity.dot(&up);
        let depth_at_end = depth - step * rising;
        let normal = parameters.stiffness * depth_at_end - parameters.damping * rising;
        if depth_at_end <= 0.0 || normal <= 0.0 {
            self.0 = Vector3::zeros();
            return;
        }
        // A point that touches down within the step is on the ground for the rest of it only.
        let share = if depth < 0.0 { depth_at_end / (depth_at_end - depth) } else { 1.0 };

        let slip = velocity - up * rising;
        // Along the surface, also if that was another one before.
        let bent = self.0 - up * self.0.dot(&up) + slip * (share * step);
        let held = -(bent * parameters.stiffness_tangential + slip * parameters.damping_tangential);
        let limit = friction * normal;
        let sticks = held.norm_squared() <= limit * limit;
        let tangential = if sticks { held } else { held * (limit / held.norm()) };
        self.0 = bent.cap_magnitude(limit / parameters.stiffness_tangential);

        let force = (tangential + up * normal) * share;
        load.wrench = load.wrench + Wrench::at_point(force, arm);

        let implicit = |stiffness: f64, damping: f64| share * (step * damping + step * step * stiffness);
        let yielding_normal = implicit(parameters.stiffness, parameters.damping);
        let yielding_tangential =
            if sticks { implicit(parameters.stiffness_tangential, parameters.damping_tangential) } else { 0.0 };
        let onto_normal = up * up.transpose();
        let onto_surface = Matrix3::identity() - onto_normal;
        load.added_inertia += point_inertia(arm, onto_surface * yielding_tangential + onto_normal * yielding_normal);
    }
}

/// Spatial inertia of a point at `arm` from the right sole's origin (m), with a mass that may depend on the direction:
/// a symmetric matrix in world axes (kg).
pub(crate) fn point_inertia(arm: Vector3<f64>, mass: Matrix3<f64>) -> Matrix6<f64> {
    let mut jacobian = Matrix3x6::zeros();
    jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&-arm.cross_matrix());
    jacobian.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
    jacobian.tr_mul(&(mass * jacobian))
}
