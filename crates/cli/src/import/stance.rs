//! Our biped standing straight: joints as points and axes, bodies as masses, all in one frame.

use model::{Joint, PerJoint};
use nalgebra::{Isometry3, Matrix3, Unit, Vector3};
use urdf_rs::Inertial;

use crate::import::FileErrors;
use crate::import::joint_map::Idealise;
use crate::import::posture::isometry;

/// The biped, not yet told from its right foot.
#[derive(Clone, Debug)]
pub struct Stance {
    /// Our powered joints; the two unpowered ones are not read.
    pub hinges: PerJoint<Hinge>,
    /// The link that each joint carries, lumped.
    pub parts: PerJoint<Part>,
    /// What is other than in the URDF, for people.
    pub changes: Vec<String>,
}

/// A joint.
#[derive(Clone, Copy, Debug)]
pub struct Hinge {
    /// The joint whose link this one is mounted on.
    pub parent: Joint,
    /// A point of its axis [m].
    pub place: Vector3<f64>,
    /// About which what it carries turns against what it is mounted on.
    pub axis: Unit<Vector3<f64>>,
    /// Smallest and largest angle [rad].
    pub range: [f64; 2],
    /// Largest rate [rad/s].
    pub rate_max: f64,
}

/// Mass and its distribution.
#[derive(Clone, Copy, Debug, Default)]
pub struct Part {
    /// [kg]
    pub mass: f64,
    /// Centre of mass [m].
    pub com: Vector3<f64>,
    /// About the centre of mass [kg·m²].
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

impl Part {
    /// A link of the URDF.
    pub fn of_link(inertial: &Inertial, link_to_root: &Isometry3<f64>) -> Self {
        let pose = link_to_root * isometry(&inertial.origin);
        let urdf_rs::Inertia { ixx, ixy, ixz, iyy, iyz, izz } = inertial.inertia.clone();
        let inertia = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
        let turn = pose.rotation.to_rotation_matrix();
        Self { mass: inertial.mass.value, com: pose.translation.vector, inertia: turn * inertia * turn.transpose() }
    }

    /// Both as one rigid body (Steiner).
    pub fn with(&self, other: &Part) -> Part {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Part { inertia: self.inertia + other.inertia, ..*self };
        }
        let com = (self.mass * self.com + other.mass * other.com) / mass;
        let about = |part: &Part| {
            let arm = part.com - com;
            part.inertia + part.mass * (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose())
        };
        Part { mass, com, inertia: about(self) + about(other) }
    }

    /// The greatest product of inertia as a share of the greatest moment.
    pub fn products_share(&self) -> f64 {
        let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|place| self.inertia[place].abs());
        let greatest = self.inertia.diagonal().max();
        if greatest > 0.0 { xy.max(xz).max(yz) / greatest } else { 0.0 }
    }
}

impl Stance {
    /// A mechanism's links have their principal axes along x, y, z: products of inertia are left out, if that is allowed.
    pub(super) fn check_inertias(&self, idealise: &Idealise, errors: &mut FileErrors, changes: &mut Vec<String>) {
        /// Rounding of a URDF's decimals.
        const ROUNDING: f64 = 1e-6;
        for (joint, part) in self.parts.iter() {
            let share = part.products_share();
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

/// The link that a joint carries, for people.
pub fn carried(joint: Joint) -> String {
    joint.link_name().map_or_else(|| format!("the link on {}", joint.name()), str::to_owned)
}

/// A number rounded up to a person's decimals.
pub fn up(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).ceil() / per_unit
}
