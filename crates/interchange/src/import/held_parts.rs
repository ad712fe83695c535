//! The joints that are held, as small trees of links between and beyond the joints that have a role.

use nalgebra::{Unit, Vector3};

use crate::import::body::LumpedBody;
use crate::import::mechanism_link::MechanismLink;

/// A joint that is held.
#[derive(Clone, Debug)]
pub(super) struct HeldPart {
    /// Index among the URDF's joints.
    pub urdf: usize,
    /// The angle at which it is held (rad).
    pub angle: f64,
    /// The mechanism's link on which it is, by the name of its joint.
    pub mount: String,
    /// The held joint that carries it, by its index; `None` for the mount.
    pub below: Option<usize>,
    /// A point on the axis (m), and the axis about which the link beyond turns, in the URDF's sign.
    pub place: Vector3<f64>,
    pub axis: Unit<Vector3<f64>>,
    /// The link beyond it up to the next joints; massless where the mechanism has a link of its own there.
    pub body: LumpedBody,
    /// Index of the mechanism's link that contains this body.
    pub lumped_into: usize,
    /// Largest torque (N·m).
    pub effort: f64,
    /// Whether it is welded to what carries it, because it cannot be a joint of its own.
    pub is_welded: bool,
}

/// All joints that are held, each after the one that carries it.
#[derive(Clone, Debug, Default)]
pub(super) struct HeldParts {
    pub parts: Vec<HeldPart>,
    /// The mechanism's links, by which bodies are lumped.
    pub links: Vec<MechanismLink>,
    /// Joints of the mechanism that held ones carry: name, and index of the part.
    pub carried: Vec<(String, usize)>,
}

impl HeldParts {
    /// The held joint that carries a joint of the mechanism; `None` if its parent does.
    pub(super) fn carrier(&self, joint: &str) -> Option<&HeldPart> {
        let (_, part) = self.carried.iter().find(|(name, _)| name == joint)?;
        self.unwelded(Some(*part))
    }

    /// The held joint that carries another one; `None` if the mount does.
    pub(super) fn below(&self, part: &HeldPart) -> Option<&HeldPart> {
        self.unwelded(part.below)
    }

    /// The first that is not welded, on the way to the mount.
    fn unwelded(&self, from: Option<usize>) -> Option<&HeldPart> {
        let part = &self.parts[from?];
        if part.is_welded { self.unwelded(part.below) } else { Some(part) }
    }

    /// Welds a part and those that carry it.
    pub(super) fn weld(&mut self, mut from: Option<usize>) {
        while let Some(index) = from {
            self.parts[index].is_welded = true;
            from = self.parts[index].below;
        }
    }

    /// Whether a part that is not welded, or a joint of the mechanism, hangs on a part.
    pub(super) fn carries(&self, index: usize) -> bool {
        self.carried.iter().any(|(_, part)| *part == index)
            || (index + 1..self.parts.len()).any(|other| {
                let part = &self.parts[other];
                part.below == Some(index) && (!part.is_welded || self.carries(other))
            })
    }
}
