//! Finds out which joints of an arm swing and bend it, and how its other joints are held so that it hangs.

use model::Side;
use nalgebra::Vector3;

use crate::import::arm_chain::ArmChain;
use crate::import::body_graph::BodyGraph;
use crate::import::import_map::ImportMap;
use crate::import::posture::Poses;
use crate::import::role::JointRole;
use crate::import::urdf_robot::{JointKind, UrdfRobot};

/// Least cosine between the axis of shoulder or elbow and y.
const ALONG: f64 = 0.8;
/// The same for a joint that the map names, as for legs.
const ALONG_TOLD: f64 = 0.5;
/// How far from the first joint of its chain a joint is one of the shoulder, in leg lengths.
const NEAR: f64 = 0.2;
/// How far from the shoulder an elbow is at least, in leg lengths.
const ELBOW_AWAY: f64 = 0.15;
/// An arm that hangs sticks out to the side by no more (rad).
const ASIDE_MAX: f64 = 0.52;
/// How far to the side an arm is held if a joint permits it (rad): the trunk sways, and the hands must clear the legs.
const ASIDE: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Least part of an arm's or forearm's reach that lies across the axis that moves it.
const ACROSS: f64 = 0.5;

/// An arm whose shoulder swings it.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    /// The joint that swings it forward and backward, and the body behind it.
    pub shoulder: (usize, usize),
    /// The joint that bends the forearm forward, and the body behind it.
    pub elbow: Option<(usize, usize)>,
    /// Joints that must be held at another angle than others, so that the arm hangs and its elbow bends forward (rad).
    pub held: Vec<(usize, f64)>,
}

/// An elbow by its place in the chain.
struct Elbow {
    place: usize,
    /// The joint before it that must be turned for it to bend forward, with its angle (rad).
    turned: Option<(usize, f64)>,
}

/// What an arm is sought in.
#[derive(Clone, Copy)]
pub(super) struct ArmSearch<'s> {
    pub robot: &'s UrdfRobot,
    pub map: &'s ImportMap,
    pub graph: &'s BodyGraph,
    /// Poses of the standing robot with each joint at an angle (rad).
    pub poses: &'s dyn Fn(&[f64]) -> Poses,
    /// Length of the leg (m).
    pub leg: f64,
}

impl ArmSearch<'_> {
    /// The arm in a chain of joints, or why there is none.
    ///
    /// * `angles` – of each joint of the URDF if no arm is found (rad)
    /// * `other` – the arm on the other side if that is known: the same angles are tried, so that both are alike
    pub(super) fn arm(&self, side: Side, chain: &ArmChain, angles: &[f64], other: Option<&Arm>) -> Result<Arm, String> {
        if chain.iter().all(|(joint, _)| self.is_held_by_map(*joint)) {
            return Err("the map holds all of its joints".to_string());
        }
        let mut angles = angles.to_vec();
        let shoulder = self.shoulder(side, chain, &(self.poses)(&angles))?;
        let mut held: Vec<(usize, f64)> = Vec::new();
        let steps = |place: usize, or: &[f64]| match other {
            Some(other) => other.held.get(place).map_or(Vec::new(), |(_, angle)| vec![*angle, -angle]),
            None => or.to_vec(),
        };
        let whole_degrees: Vec<f64> = (-180..=180).map(|degrees| f64::from(degrees).to_radians()).collect();
        if let Some((joint, angle)) = self.hang(side, chain, shoulder, &angles, &steps(0, &whole_degrees))? {
            angles[joint] = angle;
            held.push((joint, angle));
        }
        let quarter = std::f64::consts::FRAC_PI_2;
        let elbow = self.elbow(side, chain, shoulder, &angles, &steps(held.len(), &[quarter, -quarter]));
        let elbow = elbow?.map(|Elbow { place, turned }| {
            held.extend(turned);
            chain[place]
        });
        Ok(Arm { shoulder: chain[shoulder], elbow, held })
    }

    /// Place of the shoulder in the chain.
    fn shoulder(&self, side: Side, chain: &ArmChain, poses: &Poses) -> Result<usize, String> {
        let pitch = |place: usize| poses.joints[chain[place].0].1.y.abs();
        if let Some(told) = self.map.joint(JointRole::Shoulder(side)).urdf {
            let place = chain.iter().position(|(joint, _)| *joint == told).ok_or("is no joint of that arm")?;
            return if pitch(place) >= ALONG_TOLD { Ok(place) } else { Err("does not turn about y (left)".into()) };
        }
        let near = |place: &usize| self.distance(chain, 0, *place, poses) <= NEAR * self.leg;
        let found = (0..chain.len()).filter(near).find(|place| self.is_free(chain[*place].0) && pitch(*place) >= ALONG);
        found.ok_or_else(|| "no joint near the trunk swings it forward and backward, about y (left)".to_string())
    }

    /// The joint near the shoulder and its angle (rad) with which an arm hangs, a little to the side; of those tried if
    /// it sticks out. `None` if it hangs already and nothing moves it to the side, or none are tried.
    fn hang(
        &self,
        side: Side,
        chain: &ArmChain,
        shoulder: usize,
        angles: &[f64],
        tried: &[f64],
    ) -> Result<Option<(usize, f64)>, String> {
        let poses = (self.poses)(angles);
        let near: Vec<usize> = (shoulder..chain.len())
            .filter(|place| self.distance(chain, shoulder, *place, &poses) <= NEAR * self.leg)
            .collect();
        let hangs = |place: usize, poses: &Poses| {
            self.reach(chain, place, poses).is_some_and(|reach| aside(side, &reach).abs() <= ASIDE_MAX)
        };
        let of_shoulder = near.iter().copied().filter(|place| *place != shoulder && self.is_free(chain[*place].0));
        if near.iter().any(|place| hangs(*place, &poses)) {
            let rolls = |place: &usize| poses.joints[chain[*place].0].1.x.abs() >= ALONG;
            let outward = of_shoulder.clone().find(rolls).map(|place| {
                let out = if side == Side::Right { -ASIDE } else { ASIDE };
                let joint = chain[place].0;
                (joint, angles[joint] + out * self.sense(chain[place], poses.joints[joint].1.x))
            });
            return Ok(outward.filter(|(joint, angle)| !tried.is_empty() && self.is_in_range(*joint, *angle)));
        }
        let mut best: Option<(f64, usize, f64)> = None;
        for place in of_shoulder {
            let joint = chain[place].0;
            for &angle in tried.iter().filter(|angle| self.is_in_range(joint, **angle)) {
                let poses = (self.poses)(&with(angles, joint, angle));
                let Some(reach) = self.reach(chain, place, &poses).filter(|_| hangs(place, &poses)) else { continue };
                // Of an arm down and one up, down.
                let off = (aside(side, &reach) - ASIDE).abs() + 0.1 * reach.normalize().z;
                if best.is_none_or(|(least, ..)| off < least) {
                    best = Some((off, joint, angle));
                }
            }
        }
        let found = best.map(|(_, joint, angle)| Some((joint, angle)));
        found.ok_or_else(|| {
            "it sticks out to the side at the URDF's zero, and no joint beyond its shoulder lets it hang; if another \
             posture does, give it with [[held]] in the map"
                .to_string()
        })
    }

    /// The elbow, a joint before it turned by one of the angles tried (rad) if need be; `None` for an arm that does not
    /// bend forward.
    fn elbow(
        &self,
        side: Side,
        chain: &ArmChain,
        shoulder: usize,
        angles: &[f64],
        tried: &[f64],
    ) -> Result<Option<Elbow>, String> {
        let poses = (self.poses)(angles);
        if !self.moves(chain, shoulder, &poses) {
            return Err("its shoulder turns it about itself".to_string());
        }
        let pitch = |place: usize, poses: &Poses| poses.joints[chain[place].0].1.y;
        if let Some(told) = self.map.joint(JointRole::Elbow(side)).urdf {
            let place = chain.iter().position(|(joint, _)| *joint == told).filter(|place| *place > shoulder);
            let place = place.ok_or("is no joint of that arm beyond its shoulder")?;
            let is_pitch = pitch(place, &poses).abs() >= ALONG_TOLD;
            return if is_pitch {
                Ok(Some(Elbow { place, turned: None }))
            } else {
                Err("does not turn about y (left)".into())
            };
        }
        for place in shoulder + 1..chain.len() {
            let is_away = self.distance(chain, shoulder, place, &poses) >= ELBOW_AWAY * self.leg;
            if !is_away || !self.is_free(chain[place].0) || !self.moves(chain, place, &poses) {
                continue;
            }
            if pitch(place, &poses).abs() >= ALONG {
                return Ok(Some(Elbow { place, turned: None }));
            }
            // An elbow that bends to the side bends forward if the upper arm is turned about itself.
            let upper_arm = poses.joints[chain[place].0].0 - poses.joints[chain[shoulder].0].0;
            let twists = |before: &usize| {
                let axis = poses.joints[chain[*before].0].1;
                self.is_free(chain[*before].0) && axis.dot(&upper_arm).abs() >= ALONG * upper_arm.norm()
            };
            let turned =
                (shoulder + 1..place).filter(twists).flat_map(|before| tried.iter().map(move |a| (before, *a)));
            let bends = turned.filter_map(|(before, angle)| {
                let joint = chain[before].0;
                let poses = (self.poses)(&with(angles, joint, angle));
                let is_pitch = self.is_in_range(joint, angle) && pitch(place, &poses).abs() >= ALONG;
                // Forward is against a rotation about y.
                is_pitch.then(|| (-self.range_about_y(chain[place], &poses)[0], (joint, angle)))
            });
            if let Some((_, turned)) = bends.max_by(|(one, _), (other, _)| one.total_cmp(other)) {
                return Ok(Some(Elbow { place, turned: Some(turned) }));
            }
        }
        Ok(None)
    }

    /// The range of a joint with which the body behind it turns about y (rad).
    pub(super) fn range_about_y(&self, joint: (usize, usize), poses: &Poses) -> [f64; 2] {
        let [low, high] = self.range(joint.0);
        if self.sense(joint, poses.joints[joint.0].1.y) > 0.0 { [low, high] } else { [-high, -low] }
    }

    /// Whether the body behind a joint turns with a joint's angle (1) or against it (-1) about a direction along which
    /// the axis has a component.
    fn sense(&self, (joint, body): (usize, usize), component: f64) -> f64 {
        let carries_child = self.graph.body_of[self.robot.joints[joint].child] == body;
        if carries_child { component.signum() } else { -component.signum() }
    }

    /// Whether a joint moves what is behind it, and does not only turn it about itself.
    fn moves(&self, chain: &ArmChain, place: usize, poses: &Poses) -> bool {
        let axis = poses.joints[chain[place].0].1;
        self.reach(chain, place, poses).is_some_and(|reach| axis.cross(&reach).norm() >= ACROSS * reach.norm())
    }

    /// The way from a joint to the centre of mass of what is behind it (m); `None` if that weighs nothing.
    fn reach(&self, chain: &ArmChain, place: usize, poses: &Poses) -> Option<Vector3<f64>> {
        let (joint, body) = chain[place];
        let behind = self.graph.lump(self.robot, poses, &self.graph.beyond(body, &[joint]));
        (behind.mass > 0.0).then(|| behind.com - poses.joints[joint].0)
    }

    fn distance(&self, chain: &ArmChain, one: usize, other: usize, poses: &Poses) -> f64 {
        (poses.joints[chain[one].0].0 - poses.joints[chain[other].0].0).norm()
    }

    /// Whether a joint may have a role or another angle: the map does not hold it, and it follows none.
    fn is_free(&self, joint: usize) -> bool {
        self.robot.joints[joint].mimic.is_none() && !self.is_held_by_map(joint)
    }

    fn is_held_by_map(&self, joint: usize) -> bool {
        self.map.held.iter().any(|(held, _)| *held == joint)
    }

    fn range(&self, joint: usize) -> [f64; 2] {
        let joint = &self.robot.joints[joint];
        match joint.kind {
            JointKind::Revolute => [joint.limit.lower, joint.limit.upper],
            _ => [-std::f64::consts::PI, std::f64::consts::PI],
        }
    }

    fn is_in_range(&self, joint: usize, angle: f64) -> bool {
        let [low, high] = self.range(joint);
        (low..=high).contains(&angle)
    }
}

/// How far a direction points outward from the robot's plane of symmetry (rad).
fn aside(side: Side, direction: &Vector3<f64>) -> f64 {
    let outward = if side == Side::Right { -direction.y } else { direction.y };
    libm::atan2(outward, libm::hypot(direction.x, direction.z))
}

/// The angles with one of them changed.
fn with(angles: &[f64], joint: usize, angle: f64) -> Vec<f64> {
    let mut angles = angles.to_vec();
    angles[joint] = angle;
    angles
}
