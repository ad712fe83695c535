//! What does not change while the robot walks: its body, its nominal, the gains that follow from both.

use dynamics::{Kinematics, Leg, LegSolver, Tree};
use gait::NominalTable;
use model::{Link, Mechanism, Mirror, Side};
use nalgebra::Point3;

use crate::preview::{CartTable, KNOT, NominalSway};

/// Knots over which the feet are looked ahead: 1.8 s, e^(−6) of the pendulum.
pub(super) const KNOTS_AHEAD: usize = 180;
/// Knots over which the whole body is: 1 s, e^(−3).
pub(super) const KNOTS_FORESEEN: usize = 100;
/// What a jerk costs against a ZMP error [m²/(m/s³)²].
const JERK_WEIGHT: f64 = 1e-8;

/// The robot as the preview needs it.
#[derive(Clone, Debug)]
pub struct Biped {
    /// Joints, links, soles.
    pub mechanism: Mechanism,
    /// The same as a tree.
    pub tree: Tree,
    /// Its legs.
    pub legs: LegSolver,
    /// Its symmetry.
    pub mirror: Mirror,
    /// What its pendulum leaves out of the nominal half-step.
    pub sway: NominalSway,
    /// By how much the centre of mass shifts with the pelvis while both feet stay [-].
    pub com_per_pelvis: f64,
    /// Plans the pendulum over the feet.
    pub pendulum: CartTable,
    /// Plans the pendulum's correction for the whole body.
    pub correction: CartTable,
}

impl Biped {
    /// A robot that walks by `table`.
    pub fn new(mechanism: &Mechanism, mirror: &Mirror, table: &NominalTable) -> Self {
        let tree = Tree::new(mechanism);
        let sway = NominalSway::new(&tree, table);
        let gains = |knots| CartTable::new(sway.height_over_gravity, KNOT, knots, JERK_WEIGHT);
        Self {
            pendulum: gains(KNOTS_AHEAD),
            correction: gains(KNOTS_FORESEEN),
            mechanism: mechanism.clone(),
            mirror: *mirror,
            legs: LegSolver::new(mechanism),
            com_per_pelvis: com_per_pelvis(mechanism, &tree, table),
            tree,
            sway,
        }
    }
}

/// Legs shear between pelvis and ground: a link shifts as high as it is, from the pelvis on all shift alike.
fn com_per_pelvis(mechanism: &Mechanism, tree: &Tree, table: &NominalTable) -> f64 {
    let kinematics = Kinematics::standing(tree, &table.at(0.0).angles);
    let pelvis = kinematics.origin[Leg(Side::Right).end()].z;
    let shifted = mechanism.links.iter().map(|(link, Link { body, .. })| {
        let com = kinematics.link_to_world(link) * Point3::from(body.com);
        body.mass * (com.z / pelvis).min(1.0)
    });
    shifted.sum::<f64>() / tree.mass
}
