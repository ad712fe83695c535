//! The feet of a half-step: where one stands, and where the other one leaves and lands.

use nalgebra::{Vector2, Vector3};

use crate::footprint::{Footprint, SolePose, rotation_about_z};

/// The feet of a half-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feet {
    /// The support foot, in the walk frame.
    pub footprint: Footprint,
    /// The other foot before it swings, in support coordinates.
    pub lift_off: SolePose,
    /// The other foot after it has swung, in support coordinates.
    pub landing: SolePose,
}

impl Feet {
    /// A point between both soles before the swing foot leaves, in support coordinates (m).
    ///
    /// * `share` – of the support sole: 1 is a point of it
    /// * `aside` – how far to the left of the support ankle the point of the support sole is (m); that of the other
    ///   sole is its mirror image
    pub(crate) fn between(&self, share: f64, aside: f64) -> Vector2<f64> {
        let (own, rest) = (Vector2::new(0.0, aside), 1.0 - share);
        // While walking, no angle need be computed.
        if rest <= 0.0 {
            return own;
        }
        let of_other = rotation_about_z(self.lift_off.yaw) * Vector3::new(0.0, -aside, 0.0);
        (self.lift_off.position + of_other).xy() * rest + own * share
    }
}
