//! Finds the links of the joints that are held.

use model::Side;

use crate::import::biped::Biped;
use crate::import::body::LumpedBody;
use crate::import::body_graph::BodyGraph;
use crate::import::drive::{Scale, held_effort};
use crate::import::held_bodies;
use crate::import::held_parts::{HeldPart, HeldParts};
use crate::import::mechanism_link::{MechanismLink, links};
use crate::import::parts::Parts;
use crate::import::role::JointRole;

impl Parts<'_> {
    /// Finds the links of the joints that are held, with their angles (rad), and tells which remain welded.
    pub(super) fn held(
        &self,
        held: &[(usize, f64)],
        biped: &Biped,
        scale: Scale,
        lines: &mut Vec<String>,
    ) -> HeldParts {
        let turning = self.turning();
        let lumps = BodyGraph::new(self.robot, |joint| turning.contains(&joint));
        let is_held = |joint: usize| held.iter().find(|(own, _)| *own == joint);
        let fine = BodyGraph::new(self.robot, |joint| turning.contains(&joint) || is_held(joint).is_some());
        let mut found = HeldParts { links: links(self, &lumps, biped), ..HeldParts::default() };
        let link_of = |links: &[MechanismLink], body: usize| {
            links.iter().position(|link| link.lump == lumps.body_of[body]).unwrap_or_default()
        };

        // From the right foot outward.
        let ankle = &self.robot.joints[self.legs.joints[self.sides[0]][5]];
        let ends = [ankle.parent, ankle.child].map(|link| fine.body_of[link]);
        let foot = ends.into_iter().find(|end| lumps.body_of[*end] == found.links[0].lump).unwrap_or_default();
        let lump = |body: usize| fine.lump(self.robot, self.poses, &[body]);
        found.links[0].root = lump(foot);
        let other_hip = JointRole::Leg(Side::Left, self.roles[0]).name();
        let to_trunk = if self.waist.roles.is_none() { self.waist.joints.last() } else { None };
        let mut open = vec![(foot, None, 0, None)];
        while let Some((body, by, mount, carrier)) = open.pop() {
            for &(joint, next) in fine.neighbours[body].iter().filter(|(joint, _)| Some(*joint) != by) {
                let mut link = link_of(&found.links, next);
                let mut on = None;
                if let Some((_, angle)) = is_held(joint) {
                    let is_to_trunk = to_trunk.is_some_and(|(last, _)| *last == joint);
                    let (place, told) = self.poses.joints[joint];
                    let axis = if fine.body_of[self.robot.joints[joint].child] == next { told } else { -told };
                    found.parts.push(HeldPart {
                        urdf: joint,
                        angle: *angle,
                        mount: found.links[mount].name.clone(),
                        below: carrier,
                        place,
                        axis,
                        body: if is_to_trunk { LumpedBody::default() } else { lump(next) },
                        lumped_into: link,
                        effort: held_effort(&self.robot.joints[joint], scale),
                        is_welded: false,
                    });
                    on = Some(found.parts.len() - 1);
                    if is_to_trunk {
                        // The trunk is a link of the mechanism, on a waist that does not move.
                        found.carried.push((JointRole::WaistPitch.name(), found.parts.len() - 1));
                        found.links[link].root = lump(next);
                        on = None;
                    } else {
                        link = mount;
                    }
                } else {
                    let name = found.links[link].name.clone();
                    if self.waist.joints.is_empty() && name == other_hip {
                        // The left leg hangs on a pelvis that is massless, and is the trunk.
                        found.weld(carrier);
                    }
                    found.carried.extend(carrier.map(|carrier| (name, carrier)));
                    found.links[link].root = lump(next);
                }
                open.push((next, Some(joint), link, on));
            }
        }
        held_bodies::settle(&mut found, self.robot, scale.leg, lines);
        found
    }
}
