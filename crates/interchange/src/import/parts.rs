//! Puts a biped together from its URDF and the roles that were found in it.

use model::Side;
use nalgebra::{Unit, Vector3};

use crate::import::arm::Arm;
use crate::import::biped::{Biped, Hinge, Segment};
use crate::import::body::LumpedBody;
use crate::import::body_graph::BodyGraph;
use crate::import::drive::{self, DriveNotes, JointDrive, Scale};
use crate::import::file_errors::FileErrors;
use crate::import::import_map::ImportMap;
use crate::import::leg_pair::LegPair;
use crate::import::posture::Poses;
use crate::import::role::{JointRole, LegRole};
use crate::import::urdf_robot::UrdfRobot;
use crate::import::waist::Waist;
use crate::side_name::side_name;

/// Least distance from hip to ankle as a share of thigh and shank: a straight leg's is 1.
const STRETCHED: f64 = 0.93;
/// Least cosine between the way from hip to ankle and straight down.
const UPRIGHT: f64 = 0.9;
/// Least length of thigh and shank, as a share of the leg's.
const SEGMENT: f64 = 0.1;

/// What the biped is made of: the URDF, and the roles that were found in it.
pub(super) struct Parts<'p> {
    pub robot: &'p UrdfRobot,
    pub map: &'p ImportMap,
    pub legs: &'p LegPair,
    /// Index of right and left leg in `legs`.
    pub sides: [usize; 2],
    pub roles: [LegRole; 6],
    pub waist: &'p Waist,
    /// Right and left arm; `None` if arms are held.
    pub arms: Option<&'p [Arm; 2]>,
    /// Poses of the standing robot, joints without a role where they are held.
    pub poses: &'p Poses,
}

impl Parts<'_> {
    /// The role of each joint that has one.
    pub(super) fn roles(&self) -> Vec<(JointRole, usize)> {
        let mut roles = Vec::new();
        for (side, leg) in Side::BOTH.into_iter().zip(self.sides) {
            let own = self.roles.iter().zip(self.legs.joints[leg]);
            roles.extend(own.map(|(role, joint)| (JointRole::Leg(side, *role), joint)));
        }
        if let Some([pitch, roll]) = self.waist.roles {
            roles.extend([(JointRole::WaistPitch, pitch), (JointRole::WaistRoll, roll)]);
        }
        roles.extend(self.arm_joints().into_iter().flatten().map(|(role, (joint, _))| (role, joint)));
        roles.sort_by_key(|(role, _)| role.number());
        roles
    }

    /// The joints between the bodies of the biped: those with a role, and the first one of a waist without.
    pub(super) fn turning(&self) -> Vec<usize> {
        let mut turning: Vec<usize> = self.roles().iter().map(|(_, joint)| *joint).collect();
        if self.waist.roles.is_none() {
            turning.extend(self.waist.joints.first().map(|(joint, _)| *joint));
        }
        turning
    }

    /// The joints of right and left arm that have a role, from the trunk outward, each with the body behind it.
    pub(super) fn arm_joints(&self) -> [Vec<(JointRole, (usize, usize))>; 2] {
        let joints = |side: Side| {
            let arm = self.arms.map(|arms| &arms[side.index()]);
            let joints = arm.into_iter().flat_map(|arm| [Some(arm.shoulder), arm.elbow]).flatten();
            JointRole::of_arm(side).into_iter().zip(joints).collect()
        };
        Side::BOTH.map(joints)
    }

    /// Length of the stretched leg: thigh and shank between the pitch axes, the mean of both sides (m).
    pub(super) fn leg_length(&self) -> f64 {
        self.sides.iter().map(|leg| self.segments(*leg).iter().map(|segment| segment.norm()).sum::<f64>()).sum::<f64>()
            / 2.0
    }

    /// Thigh and shank of a leg, from axis to axis, seen from the side (m).
    fn segments(&self, leg: usize) -> [Vector3<f64>; 2] {
        let place = |role: LegRole| {
            let index = self.roles.iter().position(|own| *own == role).unwrap_or_default();
            let place = self.poses.joints[self.legs.joints[leg][index]].0;
            Vector3::new(place.x, 0.0, place.z)
        };
        let knee = place(LegRole::Knee);
        [knee - place(LegRole::HipPitch), place(LegRole::AnklePitch) - knee]
    }

    /// Notes legs that do not stand straight at zero.
    pub(super) fn check_straight(&self, errors: &mut FileErrors) {
        for (side, leg) in Side::BOTH.into_iter().zip(self.sides) {
            let [thigh, shank] = self.segments(leg);
            let line = self.robot.joints[self.legs.joints[leg][3]].line;
            let (whole, sum) = (thigh + shank, thigh.norm() + shank.norm());
            if thigh.norm().min(shank.norm()) < SEGMENT * sum {
                errors.note_at(
                    line,
                    format!(
                        "{} leg: its knee must have a thigh above and a shank below; they are {:.4} and {:.4} m long",
                        side_name(side),
                        thigh.norm(),
                        shank.norm()
                    ),
                );
            } else if whole.norm() < STRETCHED * sum {
                let bent = thigh.angle(&shank).to_degrees();
                errors.note_at(
                    line,
                    format!(
                        "{} leg: it is bent by {bent:.0}° at the URDF's zero; there the robot must stand straight",
                        side_name(side)
                    ),
                );
            } else if -whole.z < UPRIGHT * whole.norm() {
                errors.note_at(
                    line,
                    format!(
                        "{} leg: from hip to ankle it points along [{:.2}, {:.2}, {:.2}] at the URDF's zero; there the \
                     robot must stand upright, z up",
                        side_name(side),
                        whole.x / whole.norm(),
                        whole.y / whole.norm(),
                        whole.z / whole.norm()
                    ),
                );
            }
        }
    }

    /// Puts the biped together; notes joints whose limits make no sense, or that follow another joint.
    pub(super) fn biped(&self, scale: Scale, errors: &mut FileErrors, lines: &mut Vec<String>) -> Option<Biped> {
        let turning = self.turning();
        let graph = BodyGraph::new(self.robot, |joint| turning.contains(&joint));
        let lump = |body: usize| graph.lump(self.robot, self.poses, &[graph.body_of[body]]);
        let mut notes = DriveNotes::default();
        let mut hinge = |role: JointRole, urdf: usize, axis: usize, carried: usize| {
            let joint = &self.robot.joints[urdf];
            if let Some(mimic) = &joint.mimic {
                errors.note_at(
                    joint.line,
                    format!(
                        "joint {} as {}: <mimic joint = \"{}\">: a joint with a role must move by itself; this one \
                         follows another",
                        joint.name,
                        role.name(),
                        mimic.joint
                    ),
                );
                return None;
            }
            let drive = match drive::drive(joint, self.map.joint(role), &self.map.motors, scale, &mut notes) {
                Ok(drive) => drive,
                Err(what) => {
                    errors.note_at(joint.line, format!("joint {} as {}: {what}", joint.name, role.name()));
                    return None;
                }
            };
            let (place, told) = self.poses.joints[urdf];
            let turned = if told[axis] < 0.0 { -1.0 } else { 1.0 };
            let carries_child = graph.body_of[joint.child] == graph.body_of[carried];
            let sign = if carries_child { turned } else { -turned };
            let [low, high] = drive.range;
            let range = if sign < 0.0 { [-high, -low] } else { drive.range };
            Some(Hinge {
                urdf,
                place,
                axis: Unit::new_unchecked(told.into_inner() * turned),
                sign,
                drive: JointDrive { range, ..drive },
            })
        };

        // Each joint carries the body that follows it from the right foot on.
        let legs = [0, 1].map(|side| {
            let leg = self.sides[side];
            let below = self.legs.bodies[leg];
            let hinges: Vec<Option<Hinge>> = (0..6)
                .map(|place| {
                    let above = if place == 0 { self.legs.pelvis } else { below[place - 1] };
                    let carried = if side == 0 { above } else { below[place] };
                    let role = self.roles[place];
                    hinge(JointRole::Leg(Side::BOTH[side], role), self.legs.joints[leg][place], role.axis(), carried)
                })
                .collect();
            let hinges: Option<Vec<Hinge>> = hinges.into_iter().collect();
            let hinges: [Hinge; 6] = hinges?.try_into().ok()?;
            Some(std::array::from_fn(|place| Segment { hinge: hinges[place], body: lump(below[place]) }))
        });
        let arms = self.arm_joints().map(|arm| {
            let segment = |(role, (joint, body)): &(JointRole, (usize, usize))| {
                Some(Segment { hinge: hinge(*role, *joint, role.axis(), *body)?, body: lump(*body) })
            };
            arm.iter().map(segment).collect::<Option<Vec<Segment>>>()
        });
        let behind = |joint: usize| self.waist.joints.iter().find(|(own, _)| *own == joint).map(|(_, body)| *body);
        let waist = match self.waist.roles {
            None => Some(None),
            Some([pitch, roll]) => {
                let pitch = hinge(JointRole::WaistPitch, pitch, 1, behind(pitch)?);
                let roll = hinge(JointRole::WaistRoll, roll, 0, behind(roll)?);
                pitch.zip(roll).map(|(pitch, roll)| Some([pitch, roll]))
            }
        };
        lines.extend(notes.lines());
        let [right, left] = legs;
        let legs: [[Segment; 6]; 2] = [right?, left?];
        let [right_arm, left_arm] = arms;
        let arms = [right_arm?, left_arm?];

        let mut middle = LumpedBody::default();
        if let Some(roles) = self.waist.roles {
            let first = self.waist.joints.iter().find(|(joint, _)| roles.contains(joint))?;
            middle = lump(first.1);
            if first.0 == roles[1] {
                lines.push(
                    "the waist rolls below its pitch joint; a mechanism's waist pitches first: exact for one at a \
                     time, the trunk is turned by about their product if both are bent"
                        .to_string(),
                );
            }
        }
        let (pelvis, trunk) = match self.waist.joints.last() {
            Some((_, trunk)) => (lump(self.legs.pelvis), lump(*trunk)),
            None => (LumpedBody::default(), lump(self.legs.pelvis)),
        };
        let mount = match self.waist.joints.first() {
            Some((joint, _)) => self.poses.joints[*joint].0,
            None => (legs[0][0].hinge.place + legs[1][0].hinge.place) / 2.0,
        };
        Some(Biped { roles: self.roles, legs, pelvis, waist: waist?, mount, middle, trunk, arms })
    }
}
