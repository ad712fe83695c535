//! A biped in its straight posture: joints as points and axes, links as masses, all in one frame.

use model::{Joint, PerJoint};
use nalgebra::{Isometry3, Matrix3, Unit, Vector3};
use urdf_rs::Inertial;

use crate::import::file_errors::FileErrors;
use crate::import::joint_map::Idealise;
use crate::import::link_poses::isometry;

/// A biped in its straight posture, in the frame of the URDF's root link.
#[derive(Clone, Debug)]
pub(super) struct StraightBiped {
    /// The mechanism's powered joints; the two unpowered ones are unused.
    pub hinges: PerJoint<Hinge>,
    /// Mass and inertia of the link that each joint carries.
    pub bodies: PerJoint<LumpedBody>,
    /// Differences from the URDF, one text each, for users.
    pub changes: Vec<String>,
}

/// A powered joint as a point and an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hinge {
    /// The joint whose link this one is mounted on.
    pub parent: Joint,
    /// A point on the axis (m).
    pub place: Vector3<f64>,
    /// Axis about which the carried link turns against the parent's.
    pub axis: Unit<Vector3<f64>>,
    /// Smallest and largest angle (rad).
    pub range: [f64; 2],
    /// Largest rate (rad/s).
    pub rate_max: f64,
}

/// Mass and inertia of rigidly connected links of the URDF.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LumpedBody {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub com: Vector3<f64>,
    /// Inertia about the centre of mass (kg·m²).
    pub inertia: Matrix3<f64>,
}

impl Default for Hinge {
    fn default() -> Self {
        Self {
            parent: Joint::FootRoll,
            place: Vector3::zeros(),
            axis: Vector3::x_axis(),
            range: [0.0; 2],
            rate_max: 0.0,
        }
    }
}

impl LumpedBody {
    /// Mass and inertia of a link of the URDF.
    pub(super) fn of_link(inertial: &Inertial, link_to_root: &Isometry3<f64>) -> Self {
        let pose = link_to_root * isometry(&inertial.origin);
        let urdf_rs::Inertia { ixx, ixy, ixz, iyy, iyz, izz } = inertial.inertia.clone();
        let inertia = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
        let turn = pose.rotation.to_rotation_matrix();
        Self { mass: inertial.mass.value, com: pose.translation.vector, inertia: turn * inertia * turn.transpose() }
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

    /// The greatest product of inertia as a share of the greatest moment.
    pub(super) fn products_share(&self) -> f64 {
        let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|place| self.inertia[place].abs());
        let greatest = self.inertia.diagonal().max();
        if greatest > 0.0 { xy.max(xz).max(yz) / greatest } else { 0.0 }
    }
}

impl StraightBiped {
    /// Drops the products of inertia, which a mechanism does not have, as far as the map allows it.
    pub(super) fn check_inertias(&self, idealise: &Idealise, errors: &mut FileErrors, changes: &mut Vec<String>) {
        /// Rounding of a URDF's decimals.
        const ROUNDING: f64 = 1e-6;
        for (joint, body) in self.bodies.iter() {
            let share = body.products_share();
            let name = carried(joint);
            if share > idealise.products_of_inertia_max.max(ROUNDING) {
                errors.note(format!(
                    "{name}: its greatest product of inertia is {share:.4} of its greatest moment; a mechanism's links \
                     have none: allow to leave it out with idealise.products_of_inertia_max_share = {}",
                    up(share, 1e3)
                ));
            } else if share > ROUNDING {
                changes
                    .push(format!("{name}: products of inertia left out, at most {share:.4} of its greatest moment"));
            }
        }
    }
}

/// Name of the link that a joint carries, for messages.
pub(super) fn carried(joint: Joint) -> String {
    joint.link_name().map_or_else(|| format!("the link on {}", joint.name()), str::to_owned)
}

/// A number rounded up to a few decimals.
pub(super) fn up(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).ceil() / per_unit
}
