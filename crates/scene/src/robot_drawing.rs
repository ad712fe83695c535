//! The robot as the page draws it: its joints, the links that they carry, and its soles.

use model::{Joint, LegReach, Mechanism, Side};
use serde::Serialize;

use crate::rounded::rounded;

/// What the page needs to know of a robot to draw it in any posture. Lengths in m, angles in rad.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotDrawing {
    name: String,
    /// (kg)
    mass: f64,
    /// How large it is, as a multiple of the paper's robot.
    scale: f64,
    /// The joints in the paper's order.
    joints: Vec<DrawnJoint>,
    sole: DrawnSole,
    /// Indices of the joints whose links are the right and the left foot.
    feet: [usize; 2],
    /// Index of the joint whose link is the trunk.
    trunk: usize,
    /// Index of the joint whose link is the pelvis.
    pelvis: usize,
    /// Where the sole's origin is in the foot's frame: of the right and of the left foot.
    sole_in_foot: [[f64; 3]; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct DrawnJoint {
    name: &'static str,
    /// Name of the link that it carries; none between joints that meet in one point.
    link: Option<&'static str>,
    /// Index of the joint that carries its parent link; none for the ground.
    parent: Option<usize>,
    axis: [f64; 3],
    /// Position in the frame of the parent link.
    origin: [f64; 3],
    /// Centre of mass of its link, in the link's frame.
    com: [f64; 3],
    /// Whether the robot has it: a motor drives it.
    driven: bool,
    /// Smallest and largest angle.
    range: Option<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct DrawnSole {
    behind: f64,
    ahead: f64,
    inside: f64,
    outside: f64,
    ankle_height: f64,
}

impl RobotDrawing {
    /// The drawing of a robot.
    pub fn new(mechanism: &Mechanism) -> Self {
        let joints = Joint::ALL.map(|joint| {
            let link = &mechanism.links[joint];
            DrawnJoint {
                name: joint.name(),
                link: joint.link_name(),
                parent: link.parent.map(Joint::index),
                axis: rounded(link.axis.into_inner().into()),
                origin: rounded(link.origin.into()),
                com: rounded(link.body.com.into()),
                driven: mechanism.has(joint),
                range: link.limits.map(|limits| rounded([limits.angle_min, limits.angle_max])),
            }
        });
        let model::Sole { behind, ahead, inside, outside, ankle_height } = mechanism.sole;
        Self {
            name: mechanism.name.clone(),
            mass: mechanism.mass(),
            scale: LegReach::of(mechanism).scale(),
            joints: joints.to_vec(),
            sole: DrawnSole { behind, ahead, inside, outside, ankle_height },
            feet: Side::BOTH.map(|side| mechanism.foot(side).index()),
            trunk: Mechanism::TRUNK.index(),
            pelvis: mechanism.pelvis().index(),
            sole_in_foot: Side::BOTH.map(|side| rounded(mechanism.sole_in_foot(side).into())),
        }
    }
}
