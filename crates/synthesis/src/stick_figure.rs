//! The robot as a stick figure, for pictures.

use dynamics::Kinematics;
use model::{Joint, Mechanism, Side};
use nalgebra::{Point3, Vector3};

/// The points of the robot in one posture (m), in the frame of the kinematics from which it is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickFigure {
    /// The right leg, then the left one.
    pub legs: [StickLeg; 2],
    /// Intersection of the trunk joints' axes.
    pub waist: Vector3<f64>,
    /// Middle between the shoulders.
    pub neck: Vector3<f64>,
    /// Top of the head.
    pub head: Vector3<f64>,
    /// The right arm, then the left one.
    pub arms: [StickArm; 2],
}

/// The points of a leg (m).
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct StickLeg {
    pub hip: Vector3<f64>,
    pub knee: Vector3<f64>,
    pub ankle: Vector3<f64>,
    /// Middle of the sole's rear edge.
    pub heel: Vector3<f64>,
    /// Middle of the sole's front edge.
    pub toe: Vector3<f64>,
}

/// The points of an arm (m).
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct StickArm {
    pub shoulder: Vector3<f64>,
    pub elbow: Vector3<f64>,
    pub hand: Vector3<f64>,
}

/// Length of forearm and hand per distance of their centre of mass from the elbow (-) (de Leva 1996).
const HAND_BY_COM: f64 = 1.0 / 0.677;
/// Height of the head's top above the waist per height of the centre of mass of trunk and head (-).
const HEAD_BY_COM: f64 = 2.2;

impl StickFigure {
    /// The figure in the posture of `kinematics`.
    pub fn new(mechanism: &Mechanism, kinematics: &Kinematics) -> Self {
        let origin = |joint: Joint| kinematics.origin[joint];
        let along_com = |link: Joint, factor: f64| {
            origin(link) + kinematics.rotation[link] * mechanism.links[link].body.com * factor
        };
        let leg = |side: Side, [hip, knee, ankle]: [Joint; 3]| {
            let sole_to_world = kinematics.sole_to_world(mechanism, side);
            let on_sole = |x: f64| (sole_to_world * Point3::new(x, 0.0, 0.0)).coords;
            StickLeg {
                hip: origin(hip),
                knee: origin(knee),
                ankle: origin(ankle),
                heel: on_sole(-mechanism.sole.behind),
                toe: on_sole(mechanism.sole.ahead),
            }
        };
        let arm = |shoulder: Joint, elbow: Joint| {
            let is_straight = !mechanism.has(elbow);
            StickArm {
                shoulder: origin(shoulder),
                elbow: if is_straight { along_com(shoulder, 1.0) } else { origin(elbow) },
                hand: along_com(if is_straight { shoulder } else { elbow }, HAND_BY_COM),
            }
        };

        use Joint::*;
        let arms = [arm(RightShoulder, RightElbow), arm(LeftShoulder, LeftElbow)];
        Self {
            legs: [
                leg(Side::Right, [RightHipPitch, RightKnee, RightAnklePitch]),
                leg(Side::Left, [LeftHipPitch, LeftKnee, LeftAnklePitch]),
            ],
            waist: origin(WaistRoll),
            neck: (arms[0].shoulder + arms[1].shoulder) / 2.0,
            head: along_com(WaistRoll, HEAD_BY_COM),
            arms,
        }
    }
}
