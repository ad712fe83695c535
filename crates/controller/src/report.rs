//! What a tick gives: the setpoint, and what there is to say about it.

use balance::CentreOfMass;
use balance::preview::Strain;
use gait::{Admission, HalfStep};
use model::{Joint, JointVector, Mechanism};
use nalgebra::Vector2;

use crate::{Faults, Intent, Mode, Outranked};

/// What the drives are to reach at the end of the period, in physical joints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// [rad]
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Torques that the motion is expected to need [N·m].
    pub feed_forward: JointVector,
}

/// One tick, told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TickReport {
    /// What goes to the drives.
    pub setpoint: Setpoint,
    /// What the controller is doing.
    pub mode: Mode,
    /// Which half-step, on which foot, how far.
    pub half_step: HalfStep,
    /// What is in force.
    pub command: gait::Command,
    /// The speed factor of this instant.
    pub speed: f64,
    /// Measured ZMP in support coordinates [m], if the ground said where; `None`, too, in the tick of a swap, when it is
    /// known only as seen from the other foot.
    pub zmp_in_support: Option<Vector2<f64>>,
    /// What the asked motion needs the ZMP to be, in support coordinates [m].
    pub zmp_planned: Vector2<f64>,
    /// Signed distance of the measured ZMP to the edge of what bears [m].
    pub margin: f64,
    /// Feedback angles at the bearing ankle, about x and y [rad].
    pub lean: Vector2<f64>,
    /// What the plan adds before any feedback; `None` when the plain sum of the modifications is not known: while nothing
    /// is planned, and for the last knot before a swap.
    pub added: Option<AddedAngles>,
    /// Of the asked motion, in support coordinates.
    pub com_planned: CentreOfMass,
    /// As sensed, in support coordinates; `None` as for the ZMP.
    pub com_sensed: Option<CentreOfMass>,
    /// What is wrong.
    pub faults: Faults,
    /// The answer to the tick's request, if it had one.
    pub answer: Option<Answer>,
}

/// What the plan adds to the plain sum of the modifications: rotations of the body over a joint, about x and y of support
/// coordinates [rad].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AddedAngles {
    /// Of the whole body over the bearing ankle.
    pub ankle: Vector2<f64>,
    /// Of the trunk over the pelvis.
    pub waist: Vector2<f64>,
}

impl AddedAngles {
    /// What leads from one posture to the other; both in support coordinates, angles small.
    pub fn between(mechanism: &Mechanism, plain: &JointVector, planned: &JointVector) -> Self {
        let turned = |joints: [Joint; 2]| {
            let turn = |joint| mechanism.links[joint].axis.xy() * (planned[joint] - plain[joint]);
            joints.map(turn).iter().sum()
        };
        Self {
            ankle: turned([Joint::RightAnkleRoll, Joint::RightAnklePitch]),
            waist: turned([Joint::WaistPitch, Joint::WaistRoll]),
        }
    }
}

/// The answer to a request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// What became of turn, speed and extension, and when it takes effect.
    pub admission: Admission,
    /// The limit that would be broken by what was asked, where less was granted for it.
    pub strain: Option<Strain>,
    /// Least margin foreseen for the coming half-steps [m].
    pub predicted_margin: Option<f64>,
    /// What is intended from now on.
    pub intent: Intent,
    /// Why nothing was granted at all, apart from the values themselves.
    pub refusal: Option<Refusal>,
}

/// Why a request as a whole was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The robot has fallen: put it on its feet and ask for a reset.
    Fallen,
    /// A fault is latched: ask for a reset.
    Faulted,
    /// What went wrong still is: a reset is of no use yet.
    NotWell,
    /// The plain sum of modifications has been stopped; it cannot begin again from a stand.
    Standing,
    /// A source that goes before the one that asked is in command.
    Outranked(Outranked),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn added_angles_are_told_about_axes_whichever_joint_has_them() {
        // In the other reading of the paper joint 3 pitches and joint 4 rolls.
        for (file, roll, pitch) in [
            ("mechanism.toml", Joint::RightAnkleRoll, Joint::RightAnklePitch),
            ("mechanism_other_reading.toml", Joint::RightAnklePitch, Joint::RightAnkleRoll),
        ] {
            let mechanism = Mechanism::load(format!("{}/../../config/{file}", env!("CARGO_MANIFEST_DIR"))).unwrap();
            let plain = JointVector::from_fn(|joint| 0.1 * f64::from(joint.number()));
            let mut planned = plain;
            planned[roll] += 0.25;
            planned[pitch] -= 0.5;
            planned[Joint::RightKnee] += 1.0;
            let added = AddedAngles::between(&mechanism, &plain, &planned);
            assert!((added.ankle - Vector2::new(0.25, -0.5)).norm() < 1e-12, "{file}: {added:?}");
            assert_eq!(added.waist, Vector2::zeros(), "{file}");
        }
    }
}
