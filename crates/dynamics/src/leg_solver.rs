//! Leg inverse kinematics for every mechanism: in closed form where the leg has the usual structure, else by iteration.

use model::{JointVector, Mechanism, Side};
use nalgebra::Isometry3;

use crate::inverse_kinematics::Unreachable;
use crate::leg_chain::LegChain;
use crate::leg_geometry::LegGeometry;

/// Finds the six angles of a leg between pelvis and foot. Created once per mechanism, read-only.
#[derive(Clone, Copy, Debug)]
pub struct LegSolver {
    /// The right and the left leg; `None` if one of them has another structure.
    closed_forms: Option<[LegGeometry; 2]>,
    /// The right and the left leg, of any structure.
    chains: [LegChain; 2],
}

impl LegSolver {
    /// A solver for the legs of a mechanism.
    pub fn new(mechanism: &Mechanism) -> Self {
        let [right, left] = Side::BOTH.map(|side| LegGeometry::new(mechanism, side));
        Self {
            closed_forms: right.zip(left).map(|(right, left)| [right, left]),
            chains: Side::BOTH.map(|side| LegChain::new(mechanism, side)),
        }
    }

    /// Whether the legs are solved in closed form. For tests; the solution is the same by iteration.
    ///
    /// That needs hip axes that meet in one point, ankle axes that meet in one point, ankle roll (x) below ankle pitch
    /// (y), knee and hip pitch (y) below hip yaw (z) below hip roll (x), and a straight leg along z.
    pub fn is_closed_form(&self) -> bool {
        self.closed_forms.is_some()
    }

    /// Writes into `angles` the six angles of a leg that connect the pelvis link ([`Mechanism::pelvis`]) to the foot
    /// link ([`Mechanism::foot`]); both poses map link to support coordinates. No other angle is read.
    ///
    /// In closed form the knee bends backward, the hip is above the foot, the hip yaws by less than 90°, and the leg's
    /// own angles are not read. By iteration they are the first guess.
    ///
    /// # Errors
    /// [`Unreachable`], with the distance that is missing, if the leg is too short or cannot fold so far. The angles
    /// are then the closest: the pelvis has the desired orientation, the stretched (folded) leg points at its hip. If a
    /// pose has components that are not finite, the residual is infinite.
    #[inline]
    pub fn solve(
        &self,
        leg: Side,
        pelvis_to_support: &Isometry3<f64>,
        foot_to_support: &Isometry3<f64>,
        angles: &mut JointVector,
    ) -> Result<(), Unreachable> {
        if let Some(closed_forms) = &self.closed_forms {
            return closed_forms[leg.index()].solve(pelvis_to_support, foot_to_support, angles);
        }
        let [right, left] = &self.chains;
        match leg {
            Side::Right => right.solve(foot_to_support, pelvis_to_support, angles),
            Side::Left => left.solve(pelvis_to_support, foot_to_support, angles),
        }
    }
}
