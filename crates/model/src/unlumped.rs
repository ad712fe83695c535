//! The mechanism with the links of held joints by themselves: what the robot is, beside what its controller takes it
//! for.

use nalgebra::{Matrix3, Vector3};

use crate::{Body, HeldLink, Joint, Mechanism, PerJoint, Servo};

/// A body that weighs less (kg) is none: what rounding leaves where all of a link is held.
const MASS_MIN: f64 = 1e-6;

/// A mechanism whose held joints have links by themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct UnlumpedMechanism {
    /// The mechanism; its links are without the bodies of held ones.
    pub mechanism: Mechanism,
    /// The held joints that have a link, those on the same mount after each other, mounts in the mechanism's order and
    /// each after the one that carries it.
    pub held: Vec<HeldLink>,
}

impl Mechanism {
    /// The same robot, with the links of held joints by themselves.
    pub fn unlumped(&self) -> UnlumpedMechanism {
        let all = self.source.as_ref().map_or(&[][..], |source| &source.held);
        let mut places: Vec<usize> = (0..all.len()).filter(|place| all[*place].link.is_some()).collect();
        places.sort_by_key(|place| all[*place].link.as_ref().map(|link| self.order.place(link.mount)));
        let renumbered = |place: usize| places.iter().position(|other| *other == place);
        let links = places.iter().filter_map(|place| all[*place].link.clone());
        let held: Vec<HeldLink> =
            links.map(|link| HeldLink { below: link.below.and_then(renumbered), ..link }).collect();

        let mut mechanism = self.clone();
        let at = PerJoint::from_fn(|joint| self.place(joint));
        let places = held_places(&held, &at);
        for joint in Joint::ALL {
            let own = held.iter().zip(&places).filter(|(link, _)| link.lumped_into == joint && link.body.mass > 0.0);
            let parts: Vec<(Body, Vector3<f64>)> = own.map(|(link, place)| (link.body, place - at[joint])).collect();
            if !parts.is_empty() {
                mechanism.links[joint].body = without(&self.links[joint].body, &parts);
            }
        }
        UnlumpedMechanism { mechanism, held }
    }

    /// Where a joint is when the robot stands straight, from O (m).
    fn place(&self, joint: Joint) -> Vector3<f64> {
        let mut place = Vector3::zeros();
        let mut next = Some(joint);
        // A file that is being refused may have a ring of parents.
        for _ in 0..Joint::COUNT {
            let Some(joint) = next else { break };
            place += self.links[joint].origin;
            next = self.links[joint].parent;
        }
        place
    }
}

impl UnlumpedMechanism {
    /// The servo of a held joint's drive: that of legs and waist if it bears the robot, between feet and trunk, else
    /// that of the arms.
    pub fn servo_of(&self, held: usize) -> &Servo {
        let servos = &self.mechanism.servos;
        if self.bears(held) { &servos.legs_and_waist } else { &servos.arms }
    }

    fn bears(&self, held: usize) -> bool {
        self.held[held].carries.iter().any(|joint| !joint.is_in_arm())
            || (held + 1..self.held.len()).any(|other| self.held[other].below == Some(held) && self.bears(other))
    }
}

/// Where held joints are when the robot stands straight, from O (m); `at` is where the others are.
fn held_places(held: &[HeldLink], at: &PerJoint<Vector3<f64>>) -> Vec<Vector3<f64>> {
    let mut places: Vec<Vector3<f64>> = Vec::with_capacity(held.len());
    for link in held {
        let carrier = link.below.map_or(at[link.mount], |below| places[below]);
        places.push(carrier + link.origin);
    }
    places
}

/// A body without parts of it, each with the origin of its frame (m).
fn without(body: &Body, parts: &[(Body, Vector3<f64>)]) -> Body {
    let mut rest = Moments::of(body, &Vector3::zeros());
    for (part, origin) in parts {
        let Moments { mass, first, second } = Moments::of(part, origin);
        rest = Moments { mass: rest.mass - mass, first: rest.first - first, second: rest.second - second };
    }
    if rest.mass.abs() < MASS_MIN {
        return Body::NONE;
    }
    let com = rest.first / rest.mass;
    Body::with_matrix(rest.mass, com, &(rest.second - steiner(rest.mass, &com)))
}

/// Mass (kg), and first (kg·m) and second moment (kg·m²) about the origin.
struct Moments {
    mass: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    fn of(body: &Body, origin: &Vector3<f64>) -> Self {
        let com = origin + body.com;
        Self { mass: body.mass, first: body.mass * com, second: body.inertia_matrix() + steiner(body.mass, &com) }
    }
}

/// Inertia of a point mass about the origin (kg·m²).
fn steiner(mass: f64, at: &Vector3<f64>) -> Matrix3<f64> {
    mass * (Matrix3::from_diagonal_element(at.norm_squared()) - at * at.transpose())
}
