//! The upper body as one rigid body: legs can then move under it without recomputing its joints.

use model::{Joint, JointOrder, JointVector};
use nalgebra::{Isometry3, Vector3};

use crate::{Kinematics, Tree};

/// Number of links from the right sole over the pelvis to the left sole; the upper body comes after them.
const LEGS: usize = JointOrder::UP_TO_LEFT_FOOT;

/// Waist, trunk and arms as one rigid body, at fixed joint angles.
#[derive(Clone, Copy, Debug)]
pub struct UpperBody {
    /// Mass of the upper body (kg).
    pub mass: f64,
    /// Mass times centre of mass, in the pelvis link's frame (kg·m).
    pub moment: Vector3<f64>,
}

impl UpperBody {
    /// The upper body at these angles; those of the legs are not read.
    pub fn new(tree: &Tree, angles: &JointVector) -> Self {
        let mut kinematics = Kinematics::default();
        kinematics.place(tree.pelvis(), &Isometry3::identity());
        kinematics.chain(tree, angles, LEGS..Joint::COUNT);
        let (mass, moment) = kinematics.mass_and_moment(tree, tree.order.all()[LEGS..].iter().copied());
        Self { mass, moment }
    }
}

impl Kinematics {
    /// As [`Kinematics::compute_fixed_base`], without the links of the upper body, whose poses stay as they were.
    #[inline]
    pub fn compute_legs(&mut self, tree: &Tree, angles: &JointVector) {
        self.chain(tree, angles, 0..LEGS);
    }

    /// Centre of mass of the robot (m): legs as computed by [`Kinematics::compute_legs`], with an upper body on them.
    #[inline]
    pub fn com_with(&self, tree: &Tree, upper: &UpperBody) -> Vector3<f64> {
        let (_, legs) = self.mass_and_moment(tree, tree.order.all()[..LEGS].iter().copied());
        let pelvis = tree.pelvis();
        let carried = self.origin[pelvis] * upper.mass + self.rotation[pelvis] * upper.moment;
        (legs + carried) / tree.mass
    }

    /// Mass of some links (kg), and mass times their centre of mass (kg·m).
    #[inline(always)]
    fn mass_and_moment(&self, tree: &Tree, links: impl Iterator<Item = Joint>) -> (f64, Vector3<f64>) {
        links.fold((0.0, Vector3::zeros()), |(mass, moment), link| match &tree.nodes[link].body {
            Some(body) => {
                let com = self.origin[link] + self.rotation[link] * body.com;
                (mass + body.mass, moment + com * body.mass)
            }
            None => (mass, moment),
        })
    }
}
