//! Which links of a mechanism are bodies of their own in MuJoCo.
//!
//! A link without mass between two joints is none: its joints go to the body that follows. A link without mass that
//! carries several is one, and if nothing that it carries is welded to it, it borrows a trace of mass. A joint that the
//! robot does not have is a weld, and what is neither moved nor weighs anything is left out.

use model::{Body, Joint, Mechanism, PerJoint};
use nalgebra::Vector3;

/// Mass (kg) and moments of inertia (kg·m²) of a moving link that has none: MuJoCo refuses such a body.
const TRACE: (f64, f64) = (1e-6, 1e-9);

/// The bodies of a mechanism.
pub(crate) struct MjcfBodies<'m> {
    mechanism: &'m Mechanism,
    is_body: PerJoint<bool>,
    /// The bodies' masses: the mechanism's, but for what is borrowed.
    masses: PerJoint<Body>,
}

impl<'m> MjcfBodies<'m> {
    pub(crate) fn of(mechanism: &'m Mechanism) -> Self {
        let weighs = |joint: Joint| mechanism.links[joint].body.mass > 0.0;
        // Parents come before their children.
        let mut is_needed = PerJoint::from_fn(|joint| weighs(joint) || mechanism.has(joint));
        let mut branches = PerJoint::from_fn(|_| 0);
        for &joint in mechanism.order.all().iter().rev() {
            if let Some(parent) = mechanism.links[joint].parent.filter(|_| is_needed[joint]) {
                is_needed[parent] = true;
                branches[parent] += 1;
            }
        }
        let is_body = PerJoint::from_fn(|joint| {
            joint == Mechanism::RIGHT_FOOT
                || joint > Mechanism::RIGHT_FOOT && is_needed[joint] && (weighs(joint) || branches[joint] != 1)
        });
        let masses = PerJoint::from_fn(|joint| mechanism.links[joint].body);
        let mut bodies = Self { mechanism, is_body, masses };
        bodies.lend();
        bodies
    }

    /// Gives massless bodies a trace of the mass of the heaviest body that they carry.
    fn lend(&mut self) {
        for &link in self.mechanism.order.all().iter().rev() {
            if !self.is_body[link] || self.holds_mass(link) {
                continue;
            }
            let mass = |joint: &Joint| self.masses[*joint].mass;
            let heaviest = self.carried_by(link).max_by(|one, other| mass(one).total_cmp(&mass(other)));
            if let Some(lender) = heaviest {
                self.masses[lender].mass -= TRACE.0;
            }
            self.masses[link] = Body { mass: TRACE.0, inertia: Vector3::repeat(TRACE.1), ..Body::NONE };
        }
    }

    /// Whether a body, or one that is welded to it, has mass.
    fn holds_mass(&self, link: Joint) -> bool {
        let is_welded = |body: &Joint| self.hinges_of(*body).next().is_none();
        self.masses[link].mass > 0.0 || self.carried_by(link).filter(is_welded).any(|body| self.holds_mass(body))
    }

    /// The mass of a body.
    pub(crate) fn mass_of(&self, link: Joint) -> Body {
        self.masses[link]
    }

    /// The bodies that are mounted on a body.
    pub(crate) fn carried_by(&self, link: Joint) -> impl Iterator<Item = Joint> {
        let hangs_on = move |joint: &Joint| {
            self.is_body[*joint] && self.mechanism.links[self.joints_of(*joint)[0]].parent == Some(link)
        };
        Joint::ALL.into_iter().filter(move |joint| *joint != Mechanism::RIGHT_FOOT).filter(hangs_on)
    }

    /// The joints between a body and the one that carries it, the lowest first; also those that the robot lacks.
    fn joints_of(&self, link: Joint) -> Vec<Joint> {
        let mut joints = vec![link];
        while let Some(parent) = self.mechanism.links[joints[0]].parent.filter(|parent| !self.is_body[*parent]) {
            joints.insert(0, parent);
        }
        joints
    }

    /// The joints that move a body against the one that carries it, the lowest first, each with its place in the
    /// body's frame (m).
    pub(crate) fn hinges_of(&self, link: Joint) -> impl Iterator<Item = (Joint, Vector3<f64>)> {
        let joints = self.joints_of(link);
        let above = |index: usize| joints[index + 1..].iter().map(|joint| self.mechanism.links[*joint].origin);
        let hinges = joints.iter().enumerate().map(|(index, joint)| (*joint, -above(index).sum::<Vector3<f64>>()));
        hinges.filter(|(joint, _)| self.mechanism.has(*joint)).collect::<Vec<_>>().into_iter()
    }

    /// Origin of a body's frame in the frame of the body that carries it (m): at zero angles all frames are parallel,
    /// and origins add up along the massless links.
    pub(crate) fn place_of(&self, link: Joint) -> Vector3<f64> {
        self.joints_of(link).iter().map(|joint| self.mechanism.links[*joint].origin).sum()
    }
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    fn mechanism(file: &str) -> Mechanism {
        Mechanism::load(format!("{}/../../config/{file}", env!("CARGO_MANIFEST_DIR")))
            .unwrap_or_else(|errors| panic!("{errors}"))
    }

    /// The pelvis of OP3 weighs nothing, and its trunk is welded to it.
    #[test]
    fn what_is_welded_to_a_massless_pelvis_weighs_for_it() {
        let mechanism = mechanism("robots/op3/mechanism.toml");
        let bodies = MjcfBodies::of(&mechanism);
        assert_eq!(bodies.mass_of(mechanism.pelvis()).mass, 0.0);
        assert_eq!(bodies.hinges_of(Mechanism::TRUNK).count(), 0);
        assert!(bodies.carried_by(mechanism.pelvis()).any(|body| body == Mechanism::TRUNK));
    }

    #[test]
    fn massless_pelvis_with_a_waist_borrows_a_trace_of_the_trunk() {
        let mut mechanism = mechanism("mechanism.toml");
        let pelvis = mechanism.pelvis();
        mechanism.links[pelvis].body = Body::NONE;
        let bodies = MjcfBodies::of(&mechanism);
        assert_eq!(bodies.mass_of(pelvis).mass, TRACE.0);
        let trunk = mechanism.links[Mechanism::TRUNK].body.mass;
        assert_eq!(bodies.mass_of(Mechanism::TRUNK).mass, trunk - TRACE.0);
    }
}
