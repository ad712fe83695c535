//! What does not change while the robot walks: its body, its nominal, the gains that follow from both.

use dynamics::{LegSolver, Tree};
use gait::NominalTable;
use model::{Mechanism, Mirror};

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
            tree,
            sway,
        }
    }
}
