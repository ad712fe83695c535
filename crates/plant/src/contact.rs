//! The soles on the ground: a spring and damper under each corner, and bristles for dry friction.
//!
//! * Normal: `F_n = k·depth − d·v_z`, never pulling.
//! * Tangential: a bristle with spring and damper, held until it would exceed `μ·F_n`; then it slides along and keeps
//!   the deflection that the cone allows (Cundall and Strack 1979). Unlike a friction that needs speed it lets a loaded
//!   sole stand still. Only slip bends a bristle: what its damper adds may hit the cone, but bends nothing.
//!
//! All forces are those at the *end* of the integration step, linearised: see [`LinkLoad::added_inertia`].

use config::Table;
use dynamics::LinkLoad;
use model::{Joint, Mechanism, Side, Sole, Wrench};
use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector2, Vector3, Vector6};

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
    /// Force of the ground on the foot at the end of the last step, about the right sole's origin in world axes.
    load: LinkLoad,
}

/// One corner of a sole.
#[derive(Clone, Copy, Debug, Default)]
struct Corner {
    /// Position of the corner in the foot link's frame (m).
    in_link: Vector3<f64>,
    /// Deflection of the friction bristle in the ground plane, world axes (m).
    bristle: Vector3<f64>,
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
            friction: table.number("friction").between(0.0, 10.0),
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
        Self {
            link,
            corners: mechanism
                .sole
                .corners(side)
                .map(|corner| Corner { in_link: corner + offset, ..Corner::default() }),
            load: LinkLoad { link, wrench: Wrench::ZERO, added_inertia: Matrix6::zeros() },
        }
    }

    /// The force of the ground on the foot at the end of the coming step, linear in the foot's acceleration over the
    /// step.
    ///
    /// * `base` – position of the right sole's origin in the world (m)
    /// * `floor` – height of the floor at a place in the world (m)
    /// * `step` – length of the integration step (s)
    pub fn forces_at_step_end(
        &mut self,
        foot: &FootMotion,
        base: &Vector3<f64>,
        floor: impl Fn(Vector2<f64>) -> f64,
        parameters: &ContactParameters,
        step: f64,
    ) -> &LinkLoad {
        let angular = foot.velocity.fixed_rows::<3>(0).into_owned();
        let linear = foot.velocity.fixed_rows::<3>(3).into_owned();
        self.load = LinkLoad { link: self.link, wrench: Wrench::ZERO, added_inertia: Matrix6::zeros() };

        for corner in &mut self.corners {
            let arm = foot.origin + foot.rotation * corner.in_link;
            let velocity = linear + angular.cross(&arm);
            let place = base + arm;
            let depth = floor(place.xy()) - place.z;
            let depth_at_end = depth - step * velocity.z;
            let normal = parameters.stiffness * depth_at_end - parameters.damping * velocity.z;
            if depth_at_end <= 0.0 || normal <= 0.0 {
                corner.bristle = Vector3::zeros();
                continue;
            }
            // A corner that touches down within the step is on the ground for the rest of it only.
            let share = if depth < 0.0 { depth_at_end / (depth_at_end - depth) } else { 1.0 };

            let slip = Vector3::new(velocity.x, velocity.y, 0.0);
            let bent = corner.bristle + slip * (share * step);
            let held = -(bent * parameters.stiffness_tangential + slip * parameters.damping_tangential);
            let limit = parameters.friction * normal;
            let sticks = held.norm_squared() <= limit * limit;
            let tangential = if sticks { held } else { held * (limit / held.norm()) };
            corner.bristle = bent.cap_magnitude(limit / parameters.stiffness_tangential);

            let force = Vector3::new(tangential.x, tangential.y, normal) * share;
            self.load.wrench = self.load.wrench + Wrench::at_point(force, arm);

            let implicit = |stiffness: f64, damping: f64| share * (step * damping + step * step * stiffness);
            let yielding_normal = implicit(parameters.stiffness, parameters.damping);
            let yielding_tangential =
                if sticks { implicit(parameters.stiffness_tangential, parameters.damping_tangential) } else { 0.0 };
            self.load.added_inertia +=
                point_inertia(arm, Vector3::new(yielding_tangential, yielding_tangential, yielding_normal));
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

/// Spatial inertia of a point at `arm` from the right sole's origin (m), with a different mass along each world axis
/// (kg).
pub(crate) fn point_inertia(arm: Vector3<f64>, mass: Vector3<f64>) -> Matrix6<f64> {
    let mut jacobian = Matrix3x6::zeros();
    jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&-arm.cross_matrix());
    jacobian.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
    let mut weighted = jacobian;
    for (mut row, mass) in weighted.row_iter_mut().zip(mass.iter()) {
        row *= *mass;
    }
    jacobian.tr_mul(&weighted)
}
