//! The constants of the generator: the robot, its nominal half-step, and the gains that follow from both.

use dynamics::{Kinematics, LegSolver, Tree};
use gait::{NominalTable, Walk};
use model::{GRAVITY, LegReach, Link, Mechanism, Mirror, Side};
use nalgebra::{Point3, Vector2};

use crate::knot::KNOT;
use crate::lipm_residual::LipmResidual;
use crate::modified_half_step::ModifiedHalfStep;
use crate::preview_controller::PreviewController;
use crate::proportions::PatternProportions;
use crate::walk_velocity::VelocityMap;
use crate::weight_shift::WeightShift;

/// Knots of the ZMP reference: 1.8 s, after which e^(−6) is left of the influence of a reference.
pub(crate) const KNOTS_PREVIEWED: usize = 180;
/// Knots over which the dynamics filter looks ahead: 1 s, after which e^(−3) is left of an influence.
pub(crate) const KNOTS_FILTERED: usize = 100;
/// Cost of a jerk against a ZMP error for the paper's robot (m²/(m/s³)²); smaller tracks closer and moves the body more
/// suddenly.
const JERK_WEIGHT: f64 = 1e-8;

/// What does not change while the robot walks.
#[derive(Clone, Debug)]
pub(crate) struct PatternModel {
    /// Joints, links and soles.
    pub mechanism: Mechanism,
    /// The mechanism as a tree, for kinematics and dynamics.
    pub tree: Tree,
    /// Inverse kinematics of the legs.
    pub legs: LegSolver,
    /// The left–right symmetry.
    pub mirror: Mirror,
    /// Hips and ankles as points.
    pub reach: LegReach,
    /// Lengths and times that suit the size of the robot.
    pub proportions: PatternProportions,
    /// The part of the nominal half-step's ZMP that the cart-table model leaves out.
    pub lipm_residual: LipmResidual,
    /// The relation of velocity and gait parameters.
    pub velocity: VelocityMap,
    /// Displacement of the centre of mass per displacement of the pelvis while both feet stay (-).
    pub com_per_pelvis: f64,
    /// How far aside of a hip a foot is at most in a nominal step (m).
    pub nominal_reach: f64,
    /// The weight shift with which it starts from a stand.
    pub weight_shift: WeightShift,
    /// Plans the centre of mass over the feet.
    pub com_controller: PreviewController,
    /// Plans its correction for the dynamics of the whole body.
    pub correction_controller: PreviewController,
}

impl PatternModel {
    /// The model of a robot that walks by `table`.
    pub(crate) fn new(mechanism: &Mechanism, mirror: &Mirror, table: &NominalTable) -> Self {
        let tree = Tree::new(mechanism);
        let lipm_residual = LipmResidual::new(&tree, table);
        let reach = LegReach::of(mechanism);
        // A jerk is a length per cubed time, and times grow as the root of lengths.
        let weight = JERK_WEIGHT * reach.scale().powi(3);
        let proportions = PatternProportions::of(mechanism);
        let landed = Kinematics::fixed_base(&tree, &table.at(1.0).angles).sole_to_world(mechanism, Side::Left);
        let controller = |knots| PreviewController::new(lipm_residual.height_over_gravity, KNOT, knots, weight);
        Self {
            com_controller: controller(KNOTS_PREVIEWED),
            correction_controller: controller(KNOTS_FILTERED),
            mechanism: mechanism.clone(),
            mirror: *mirror,
            legs: LegSolver::new(mechanism),
            reach,
            nominal_reach: landed.translation.x.abs() / 2.0 + proportions.hip_offset_max,
            proportions,
            velocity: VelocityMap::new(mechanism, table),
            weight_shift: WeightShift::AT_LEISURE,
            com_per_pelvis: com_per_pelvis(mechanism, &tree, table),
            tree,
            lipm_residual,
        }
    }

    /// The modified half-step of a walk at a progress.
    pub(crate) fn modified(&self, walk: &Walk, progress: f64) -> ModifiedHalfStep {
        ModifiedHalfStep::new(&self.mechanism, &self.tree, &self.reach, walk, progress)
    }

    /// How far the centre of mass moves uphill, so that it stays above the soles along the vertical (m).
    ///
    /// * `vertical` – lean of the vertical over the floor (-)
    pub(crate) fn uphill(&self, vertical: Vector2<f64>) -> Vector2<f64> {
        vertical * (self.lipm_residual.height_over_gravity * GRAVITY)
    }

    /// How much lower the hips are on a slope (m): as they move uphill, the leg downhill gets longer.
    ///
    /// * `vertical` – lean of the vertical over the floor (-)
    pub(crate) fn lowered_on_slope(&self, vertical: Vector2<f64>) -> f64 {
        let leg = self.proportions.planned_leg_length_max;
        let height = |reach: f64| (leg * leg - reach * reach).max(0.0).sqrt();
        height(self.nominal_reach) - height(self.nominal_reach + self.uphill(vertical).norm())
    }
}

/// The legs shear between pelvis and ground: a link moves in proportion to its height, from the pelvis on all move
/// alike.
fn com_per_pelvis(mechanism: &Mechanism, tree: &Tree, table: &NominalTable) -> f64 {
    let kinematics = Kinematics::fixed_base(tree, &table.at(0.0).angles);
    let pelvis = kinematics.origin[tree.pelvis()].z;
    let moved = mechanism.links.iter().map(|(link, Link { body, .. })| {
        let com = kinematics.link_to_world(link) * Point3::from(body.com);
        body.mass * (com.z / pelvis).min(1.0)
    });
    moved.sum::<f64>() / tree.mass
}
