//! Mass and inertia of rigidly connected links.

use nalgebra::{Isometry3, Matrix3, Vector3};

/// Mass and inertia, in a frame that the context tells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LumpedBody {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub com: Vector3<f64>,
    /// Inertia about the centre of mass, along the frame's axes (kg·m²).
    pub inertia: Matrix3<f64>,
}

impl LumpedBody {
    /// Bodies that weigh less are none (kg).
    pub(super) const MASS_MIN: f64 = 1e-6;

    /// The same body in another frame; `to` maps coordinates to it.
    pub(super) fn moved(&self, to: &Isometry3<f64>) -> LumpedBody {
        let turn = to.rotation.to_rotation_matrix();
        let com = (to * nalgebra::Point3::from(self.com)).coords;
        LumpedBody { mass: self.mass, com, inertia: turn * self.inertia * turn.transpose() }
    }

    /// Combines two bodies into one rigid body (Steiner).
    pub(super) fn with(&self, other: &LumpedBody) -> LumpedBody {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return LumpedBody { inertia: self.inertia + other.inertia, ..*self };
        }
        let com = (self.mass * self.com + other.mass * other.com) / mass;
        let about = |body: &LumpedBody| {
            let arm = body.com - com;
            body.inertia + body.mass * (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose())
        };
        LumpedBody { mass, com, inertia: about(self) + about(other) }
    }

    /// What remains of a rigid body without a part of it.
    pub(super) fn without(&self, part: &LumpedBody) -> LumpedBody {
        self.with(&LumpedBody { mass: -part.mass, com: part.com, inertia: -part.inertia })
    }

    /// The mirror image in the plane y = 0.
    pub(super) fn mirrored(&self) -> LumpedBody {
        let flip = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
        LumpedBody { mass: self.mass, com: flip * self.com, inertia: flip * self.inertia * flip }
    }

    /// The mean of two bodies, number by number.
    pub(super) fn mean(&self, other: &LumpedBody) -> LumpedBody {
        LumpedBody {
            mass: (self.mass + other.mass) / 2.0,
            com: (self.com + other.com) / 2.0,
            inertia: (self.inertia + other.inertia) / 2.0,
        }
    }
}
