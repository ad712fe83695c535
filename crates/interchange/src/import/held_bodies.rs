//! The bodies of held links: together with what is left of each of the mechanism's links, they are that link.

use model::HeldLink;

use crate::import::body::LumpedBody;
use crate::import::held_parts::{HeldPart, HeldParts};
use crate::import::possible_moments::{has_possible_moments, repair_body};
use crate::import::urdf_robot::UrdfRobot;

/// Makes the bodies add up to the mechanism's links, which are the mean of both sides; welds what cannot be a link of
/// its own, and tells which; `leg` is the length of the leg (m).
pub(super) fn settle(held: &mut HeldParts, robot: &UrdfRobot, leg: f64, lines: &mut Vec<String>) {
    for part in &mut held.parts {
        if part.body.mass < LumpedBody::MASS_MIN {
            part.body = LumpedBody::default();
        }
        repair_body(&mut part.body, leg);
    }
    let mut welded = Vec::new();
    for index in 0..held.links.len() {
        adjust(held, index, leg);
        if !is_possible(held, index) {
            for part in held.parts.iter_mut().filter(|part| part.lumped_into == index && !part.is_welded) {
                part.is_welded = true;
                welded.push(robot.joints[part.urdf].name.as_str());
            }
        }
    }
    // What moves nothing but itself needs no joint.
    for index in (0..held.parts.len()).rev() {
        held.parts[index].is_welded |= held.parts[index].body.mass == 0.0 && !held.carries(index);
    }
    let free = (0..held.parts.len()).filter(|index| !held.parts[*index].is_welded);
    let too_many: Vec<usize> = free.skip(HeldLink::COUNT_MAX).collect();
    for index in too_many {
        held.parts[index].is_welded = true;
        welded.push(robot.joints[held.parts[index].urdf].name.as_str());
    }
    if !welded.is_empty() {
        lines.push(format!(
            "the built-in plant welds some held joints, because links are no bodies without each other or there are \
             more than {}: {}",
            HeldLink::COUNT_MAX,
            welded.join(", ")
        ));
    }
}

/// Gives the heaviest body of a link what the mechanism's has more or less than the URDF's.
fn adjust(held: &mut HeldParts, link: usize, leg: f64) {
    let mut root = held.links[link].root;
    repair_body(&mut root, leg);
    let own = (0..held.parts.len()).filter(|index| held.parts[*index].lumped_into == link);
    let mass = |index: &usize| held.parts[*index].body.mass;
    let Some(heaviest) = own.clone().max_by(|one, other| mass(one).total_cmp(&mass(other))) else { return };
    if mass(&heaviest) <= root.mass {
        return;
    }
    let others = own.filter(|index| *index != heaviest).map(|index| held.parts[index].body);
    let of_mechanism = held.links[link].body.without(&root);
    held.parts[heaviest].body = others.fold(of_mechanism, |rest, other| rest.without(&other));
}

/// Whether a link's bodies are bodies, what is left of the mechanism's included.
fn is_possible(held: &HeldParts, link: usize) -> bool {
    let own = || held.parts.iter().filter(|part| part.lumped_into == link && part.body.mass != 0.0);
    let of_mechanism = held.links[link].body;
    let rest = own().fold(of_mechanism, |rest, HeldPart { body, .. }| rest.without(body));
    let is_body = |body: &LumpedBody| body.mass >= LumpedBody::MASS_MIN && has_possible_moments(&body.inertia);
    own().all(|part| is_body(&part.body)) && (rest.mass.abs() < LumpedBody::MASS_MIN || is_body(&rest))
}
