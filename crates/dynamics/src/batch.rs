//! Several motions at once: the ground wrench, and with it the zero-moment point, of eight motions in the lanes of
//! vector registers. For comparing candidates and for looking ahead.
//!
//! The recursion is that of [`NewtonEuler`](crate::NewtonEuler), without torques. The arithmetic is the same on every
//! processor, so the bits are, too; only the width of the registers is chosen at run time.

use model::{Body, GRAVITY, Joint, Motion, PerJoint, Wrench};
use nalgebra::Vector3;

use crate::Tree;
use crate::joint_axis::JointAxis;
use crate::lanes::{LANES, Lanes, Vectors};
use crate::sin_cos::sin_cos;

/// Pose and motion of a link in each lane, at the link's origin in world axes.
#[derive(Clone, Copy, Debug)]
struct LinkLanes {
    /// Columns of the rotation from link to world axes.
    columns: [Vectors; 3],
    origin: Vectors,
    rate: Vectors,
    angular_acceleration: Vectors,
    /// Acceleration of the link's origin, minus that of free fall.
    acceleration: Vectors,
}

/// Inverse dynamics of eight motions: their ground wrenches.
#[derive(Clone, Debug)]
pub struct Batch {
    angles: PerJoint<Lanes>,
    rates: PerJoint<Lanes>,
    accelerations: PerJoint<Lanes>,
    /// In the order of the tree.
    links: [LinkLanes; Joint::COUNT],
    force: Vectors,
    moment: Vectors,
}

impl Default for Batch {
    fn default() -> Self {
        let zero = PerJoint([Lanes::ZERO; Joint::COUNT]);
        Self {
            angles: zero,
            rates: zero,
            accelerations: zero,
            links: [LinkLanes::GROUND; Joint::COUNT],
            force: Vectors::ZERO,
            moment: Vectors::ZERO,
        }
    }
}

impl Batch {
    /// Puts a motion, in support coordinates, into a lane below [`LANES`].
    #[inline]
    pub fn set(&mut self, lane: usize, motion: &Motion) {
        for index in 0..Joint::COUNT {
            self.angles.0[index].0[lane] = motion.angles.0[index];
            self.rates.0[index].0[lane] = motion.rates.0[index];
            self.accelerations.0[index].0[lane] = motion.accelerations.0[index];
        }
    }

    /// Computes the ground wrenches that the motions need with the right sole held at O.
    pub fn compute(&mut self, tree: &Tree) {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") {
                // SAFETY: the processor supports it.
                return unsafe { self.compute_with_avx512(tree) };
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the processor supports it.
                return unsafe { self.compute_with_avx2(tree) };
            }
        }
        self.compute_portably(tree);
    }

    /// Wrench of the ground on the robot, about O in support axes, for the motion in a lane.
    pub fn ground(&self, lane: usize) -> Wrench {
        Wrench { force: self.force.lane(lane), moment: self.moment.lane(lane) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f")]
    fn compute_with_avx512(&mut self, tree: &Tree) {
        self.compute_portably(tree);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn compute_with_avx2(&mut self, tree: &Tree) {
        self.compute_portably(tree);
    }

    #[inline(always)]
    fn compute_portably(&mut self, tree: &Tree) {
        let (mut force, mut moment) = (Vectors::ZERO, Vectors::ZERO);
        // Where in the order each joint's link is.
        let mut places = PerJoint([0; Joint::COUNT]);
        for (place, &joint) in tree.order.all().iter().enumerate() {
            places[joint] = place;
            let node = &tree.nodes[joint];
            let (placed, rest) = self.links.split_at_mut(place);
            let parent = node.parent.map_or(&LinkLanes::GROUND, |parent| &placed[places[parent]]);
            let link = &mut rest[0];

            let axis = link.rotate_from(parent, node.axis, self.angles[joint]);
            let spin = axis * self.rates[joint];
            link.rate = parent.rate + spin;
            link.angular_acceleration =
                parent.angular_acceleration + axis * self.accelerations[joint] + parent.rate.cross(&spin);
            (link.origin, link.acceleration) = (parent.origin, parent.acceleration);
            if let Some(origin) = node.origin {
                let arm = parent.across(&origin);
                link.origin = link.origin + arm;
                link.acceleration = link.acceleration + parent.swept(&arm);
            }
            if let Some(body) = &node.body {
                let arm = link.across(&body.com);
                let push = (link.acceleration + link.swept(&arm)).times(body.mass);
                force = force + push;
                moment = moment + (link.origin + arm).cross(&push) + link.spun(body);
            }
        }
        (self.force, self.moment) = (force, moment);
    }
}

impl LinkLanes {
    const GROUND: LinkLanes = LinkLanes {
        columns: [
            Vectors { x: Lanes([1.0; LANES]), ..Vectors::ZERO },
            Vectors { y: Lanes([1.0; LANES]), ..Vectors::ZERO },
            Vectors { z: Lanes([1.0; LANES]), ..Vectors::ZERO },
        ],
        origin: Vectors::ZERO,
        rate: Vectors::ZERO,
        angular_acceleration: Vectors::ZERO,
        acceleration: Vectors { z: Lanes([GRAVITY; LANES]), ..Vectors::ZERO },
    };

    /// Computes the rotation from that of the parent, and returns the joint's axis.
    #[inline(always)]
    fn rotate_from(&mut self, parent: &LinkLanes, joint_axis: JointAxis, angle: Lanes) -> Vectors {
        let [x, y, z] = parent.columns;
        let (mut sine, mut cosine) = (Lanes::ZERO, Lanes::ZERO);
        for lane in 0..LANES {
            (sine.0[lane], cosine.0[lane]) = sin_cos(angle.0[lane]);
        }
        let axis;
        (self.columns, axis) = match joint_axis {
            JointAxis::X => ([x, y * cosine + z * sine, z * cosine - y * sine], x),
            JointAxis::Y => ([x * cosine - z * sine, y, x * sine + z * cosine], y),
            JointAxis::Z => ([x * cosine + y * sine, y * cosine - x * sine, z], z),
            JointAxis::About(axis) => {
                let along = parent.across(&axis);
                (
                    [
                        x.about(&along, axis.x, sine, cosine),
                        y.about(&along, axis.y, sine, cosine),
                        z.about(&along, axis.z, sine, cosine),
                    ],
                    along,
                )
            }
        };
        axis
    }

    /// A vector in link coordinates, transformed to world axes. Most have one or two components that are not zero.
    #[inline(always)]
    fn across(&self, vector: &Vector3<f64>) -> Vectors {
        let mut sum = Vectors::ZERO;
        for (column, component) in self.columns.iter().zip(vector.iter()) {
            if *component != 0.0 {
                sum = sum + column.times(*component);
            }
        }
        sum
    }

    /// Acceleration of a point of the link at `arm` from its origin, relative to that of the origin.
    #[inline(always)]
    fn swept(&self, arm: &Vectors) -> Vectors {
        self.angular_acceleration.cross(arm) + self.rate.cross(&self.rate.cross(arm))
    }

    /// Rate of change of the angular momentum about the centre of mass, from principal moments of inertia.
    #[inline(always)]
    fn spun(&self, body: &Body) -> Vectors {
        let inertia = &body.inertia;
        let [x, y, z] = &match &body.principal_axes {
            None => self.columns,
            Some(axes) => [0, 1, 2].map(|column| self.across(&axes.matrix().column(column).into_owned())),
        };
        let rate = [x.dot(&self.rate), y.dot(&self.rate), z.dot(&self.rate)];
        let turning = &self.angular_acceleration;
        *x * (x.dot(turning).times(inertia.x) + rate[1] * rate[2].times(inertia.z - inertia.y))
            + *y * (y.dot(turning).times(inertia.y) + rate[2] * rate[0].times(inertia.x - inertia.z))
            + *z * (z.dot(turning).times(inertia.z) + rate[0] * rate[1].times(inertia.y - inertia.x))
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::{JointVector, Mechanism};

    use super::*;
    use crate::NewtonEuler;

    fn motion(seed: f64) -> Motion {
        let spread = |size: f64, phase: f64| -> JointVector {
            PerJoint::from_fn(|joint| size * (f64::from(joint.number()) * 0.7 + seed * 1.3 + phase).sin())
        };
        Motion { angles: spread(0.6, 0.0), rates: spread(2.0, 1.0), accelerations: spread(10.0, 2.0) }
    }

    fn mechanisms() -> [Mechanism; 2] {
        ["mechanism.toml", "mechanism_other_reading.toml"].map(|name| {
            Mechanism::load(format!("{}/../../config/{name}", env!("CARGO_MANIFEST_DIR"))).expect("it loads")
        })
    }

    /// The scalar recursion is the oracle.
    #[test]
    fn every_lane_of_a_batch_agrees_with_newton_euler() {
        for mechanism in mechanisms() {
            let tree = Tree::new(&mechanism);
            let mut batch = Batch::default();
            for lane in 0..LANES {
                batch.set(lane, &motion(lane as f64));
            }
            batch.compute(&tree);
            for lane in 0..LANES {
                let scalar = NewtonEuler::default().ground_wrench(&tree, &motion(lane as f64));
                let off = batch.ground(lane) - scalar;
                assert!(off.force.amax() < 1e-10 && off.moment.amax() < 1e-10, "lane {lane}: {off:?}");
            }
        }
    }

    /// Narrow and wide registers compute the same bits.
    #[test]
    fn the_bits_of_a_batch_do_not_depend_on_the_register_width() {
        let tree = Tree::new(&mechanisms()[0]);
        let mut wide = Batch::default();
        for lane in 0..LANES {
            wide.set(lane, &motion(lane as f64));
        }
        let mut narrow = wide.clone();
        wide.compute(&tree);
        narrow.compute_portably(&tree);
        for lane in 0..LANES {
            assert_eq!(wide.ground(lane), narrow.ground(lane));
        }
    }
}
