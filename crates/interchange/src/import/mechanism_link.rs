//! The mechanism's links, and the bodies of the URDF that each stands for.

use model::Side;

use crate::import::biped::Biped;
use crate::import::body::LumpedBody;
use crate::import::body_graph::BodyGraph;
use crate::import::parts::Parts;
use crate::import::role::JointRole;

/// A link of the mechanism.
#[derive(Clone, Debug)]
pub(super) struct MechanismLink {
    /// The name of the joint that carries it.
    pub name: String,
    /// The body of the URDF that it stands for, where held joints do not turn.
    pub lump: usize,
    /// That body as the mechanism has it.
    pub body: LumpedBody,
    /// The part of the URDF's body that its joint carries by itself, without held ones.
    pub root: LumpedBody,
}

/// The links, the right foot first; `lumps` are the bodies between joints with roles.
pub(super) fn links(parts: &Parts, lumps: &BodyGraph, biped: &Biped) -> Vec<MechanismLink> {
    let mut links = Vec::new();
    let mut add = |name: String, of: usize, body: LumpedBody| {
        links.push(MechanismLink { name, lump: lumps.body_of[of], body, root: LumpedBody::default() });
    };
    let (legs, waist) = (parts.legs, parts.waist);
    let [right, left] = parts.sides.map(|leg| legs.bodies[leg]);
    let role = |side: Side, place: usize| JointRole::Leg(side, parts.roles[place]).name();
    add("foot_pitch".to_string(), right[5], biped.legs[0][5].body);
    for place in 1..6 {
        add(role(Side::Right, place), right[place - 1], biped.legs[0][place - 1].body);
    }
    // Without a waist the pelvis is the trunk.
    if !waist.joints.is_empty() {
        add(role(Side::Right, 0), legs.pelvis, biped.pelvis);
    }
    for (place, (body, segment)) in left.into_iter().zip(&biped.legs[1]).enumerate() {
        add(role(Side::Left, place), body, segment.body);
    }
    let middle = waist.roles.and_then(|roles| waist.joints.iter().find(|(joint, _)| roles.contains(joint)));
    if let Some((_, body)) = middle {
        add(JointRole::WaistPitch.name(), *body, biped.middle);
    }
    let trunk = waist.joints.last().map_or(legs.pelvis, |(_, trunk)| *trunk);
    add(JointRole::WaistRoll.name(), trunk, biped.trunk);
    for (joints, segments) in parts.arm_joints().iter().zip(&biped.arms) {
        for ((role, (_, body)), segment) in joints.iter().zip(segments) {
            add(role.name(), *body, segment.body);
        }
    }
    links
}
