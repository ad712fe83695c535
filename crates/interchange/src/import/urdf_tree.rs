//! Checks that links and joints are one tree.

use crate::import::file_errors::FileErrors;
use crate::import::urdf_robot::{UrdfLink, UrdfTreeJoint};

/// Most names that a message lists.
const NAMES_MAX: usize = 12;

/// Index of the root link; notes joints in a ring, links with two parents, and several roots.
pub(super) fn root(links: &[UrdfLink], joints: &[UrdfTreeJoint], errors: &mut FileErrors) -> Option<usize> {
    let mut parent_joint: Vec<Option<usize>> = vec![None; links.len()];
    for (index, joint) in joints.iter().enumerate() {
        let child = &links[joint.child].name;
        if joint.parent == joint.child {
            let text = "must connect two links: it leads from a link to itself";
            errors.note_at(joint.line, format!("joint {}: {text}, {child}", joint.name));
        } else if let Some(other) = parent_joint[joint.child] {
            let other: &UrdfTreeJoint = &joints[other];
            errors.note_at(
                joint.line,
                format!(
                    "joint {}: its child {child} is the child of joint {} (line {}) already: a URDF is a tree, and \
                     cannot close a loop",
                    joint.name, other.name, other.line
                ),
            );
        } else {
            parent_joint[joint.child] = Some(index);
        }
    }
    if !errors.is_empty() {
        return None;
    }

    let roots: Vec<usize> = (0..links.len()).filter(|link| parent_joint[*link].is_none()).collect();
    let mut reached = vec![false; links.len()];
    roots.iter().for_each(|root| reached[*root] = true);
    // Links may be in any order: each pass reaches at least one more.
    for _ in 0..links.len() {
        let mut more = false;
        for joint in joints {
            if reached[joint.parent] {
                more |= !std::mem::replace(&mut reached[joint.child], true);
            }
        }
        if !more {
            break;
        }
    }
    let ring: Vec<&UrdfLink> = links.iter().zip(&reached).filter(|(_, reached)| !**reached).map(|(l, _)| l).collect();
    if let Some(first) = ring.first() {
        let names = listed(ring.iter().map(|link| link.name.as_str()));
        errors.note_at(
            first.line,
            format!("the links {names} hang together in a ring: no root link leads to them; a URDF is a tree"),
        );
    }
    if roots.len() > 1 {
        let names = listed(roots.iter().map(|root| links[*root].name.as_str()));
        errors.note_at(
            links[roots[1]].line,
            format!("the links {names} are no joint's child: a robot is one tree, with one root link"),
        );
    }
    roots.first().copied().filter(|_| errors.is_empty())
}

/// Names in a row, shortened if there are many.
pub(super) fn listed<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<&str> = names.collect();
    let more = names.len().saturating_sub(NAMES_MAX);
    let shown = names.iter().take(NAMES_MAX).copied().collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{shown} and {more} more") } else { shown }
}
