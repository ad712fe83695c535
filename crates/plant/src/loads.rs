//! The external loads of an integration step, at most one for each link.

use dynamics::{ArticulatedBody, LinkLoad};
use model::{Joint, Mechanism, Wrench};
use nalgebra::{Matrix6, Vector3};

/// External loads, one for each loaded link; never full, since there are as many places as links.
#[derive(Default)]
pub(crate) struct Loads(heapless::Vec<LinkLoad, { Joint::COUNT }>);

impl Loads {
    /// Adds a load to those on its link.
    pub(crate) fn add(&mut self, load: LinkLoad) {
        if let Some(present) = self.0.iter_mut().find(|present| present.link == load.link) {
            present.wrench = present.wrench + load.wrench;
            present.added_inertia += load.added_inertia;
        } else {
            // There are as many places as links.
            let _ = self.0.push(load);
        }
    }

    /// Adds a force (N) in world axes at a link's centre of mass.
    pub(crate) fn add_force(
        &mut self,
        force: Vector3<f64>,
        link: Joint,
        mechanism: &Mechanism,
        body: &ArticulatedBody,
    ) {
        let com = body.kinematics.origin[link] + body.kinematics.rotation[link] * mechanism.links[link].body.com;
        self.add(LinkLoad { link, wrench: Wrench::at_point(force, com), added_inertia: Matrix6::zeros() });
    }

    /// All loads.
    pub(crate) fn as_slice(&self) -> &[LinkLoad] {
        &self.0
    }
}
