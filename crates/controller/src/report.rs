//! What a tick returns, and how a report leaves the support coordinates of the controller.

use interface::{AddedAngles, Command, LatchedFault, Rejection, Reply, Report, Setpoint, StateEstimate};
use model::{ComState, Joint, JointVector, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

/// What a tick returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// What the drives are to reach at the end of the period.
    pub setpoint: Setpoint,
    /// The state of the controller.
    pub report: Report,
    /// Why the newest measurement was not used, if it was not.
    pub rejection: Option<Rejection>,
    /// The gait parameters in force; the report has the speed of the instant, which follows over a ramp.
    pub command: Command,
    /// The reply to a request that is decided: to the one submitted before this tick, else to an earlier one.
    pub reply: Option<Reply>,
    /// The refusal of the request that was under evaluation when the robot was stopped.
    pub superseded: Option<Reply>,
    /// The fault that is latched, if any.
    pub latched: Option<LatchedFault>,
}

/// Within the controller the support foot is always the right one. Mirrors a report back if it is the left one: points
/// and velocities change the sign of y, rotations that of x.
pub(crate) fn to_physical(report: Report) -> Report {
    if report.half_step.support == Side::Right {
        return report;
    }
    let point = |point: Vector2<f64>| Vector2::new(point.x, -point.y);
    let vector = |vector: Vector3<f64>| Vector3::new(vector.x, -vector.y, vector.z);
    let rotation = |rotation: Vector2<f64>| Vector2::new(-rotation.x, rotation.y);
    let com = |com: ComState| ComState { position: vector(com.position), velocity: vector(com.velocity) };
    let added = |AddedAngles { ankle, waist }| AddedAngles { ankle: rotation(ankle), waist: rotation(waist) };
    Report {
        zmp_in_support: report.zmp_in_support.map(point),
        zmp_planned: report.zmp_planned.map(point),
        lean: rotation(report.lean),
        added: report.added.map(added),
        com_planned: report.com_planned.map(com),
        com_measured: report.com_measured.map(com),
        estimate: StateEstimate {
            contact: [report.estimate.contact[1], report.estimate.contact[0]],
            external_force: point(report.estimate.external_force),
            com_offset: point(report.estimate.com_offset),
            ..report.estimate
        },
        ..report
    }
}

/// The rotations over ankle and waist that lead from one posture to another; both in support coordinates, angles small.
pub(crate) fn added_angles(mechanism: &Mechanism, plain: &JointVector, planned: &JointVector) -> AddedAngles {
    let rotation = |joints: [Joint; 2]| {
        let about = |joint| mechanism.links[joint].axis.xy() * (planned[joint] - plain[joint]);
        joints.map(about).iter().sum()
    };
    AddedAngles {
        ankle: rotation([Joint::RightAnkleRoll, Joint::RightAnklePitch]),
        waist: rotation([Joint::WaistPitch, Joint::WaistRoll]),
    }
}

#[cfg(test)]
mod tests {
    use config::Config;
    use interface::{Faults, HalfStep, Mode, Odometry};

    use super::*;

    #[test]
    fn added_angles_are_about_axes_whichever_joint_has_them() {
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
            let added = added_angles(&mechanism, &plain, &planned);
            assert!((added.ankle - Vector2::new(0.25, -0.5)).norm() < 1e-12, "{file}: {added:?}");
            assert_eq!(added.waist, Vector2::zeros(), "{file}");
        }
    }

    #[test]
    fn a_report_on_the_left_foot_is_the_mirror_image() {
        let on = |support| {
            let com = ComState { position: Vector3::new(0.1, 0.08, 0.9), velocity: Vector3::new(0.4, -0.2, 0.01) };
            to_physical(Report {
                mode: Mode::Walking,
                half_step: HalfStep::first(support),
                speed: 1.0,
                turn: 0.1,
                extension: 0.0,
                sidestep: 0.1,
                zmp_in_support: Some(Vector2::new(0.01, 0.02)),
                zmp_planned: Some(Vector2::new(0.03, 0.04)),
                margin: Some(0.02),
                lean: Vector2::new(0.1, 0.2),
                added: Some(AddedAngles { ankle: Vector2::new(0.3, 0.4), waist: Vector2::new(0.5, 0.6) }),
                com_planned: Some(com),
                com_measured: None,
                odometry: Odometry::default(),
                capturability: None,
                estimate: StateEstimate {
                    contact: [true, false],
                    external_force: Vector2::new(10.0, 20.0),
                    com_offset: Vector2::new(0.01, 0.02),
                    gyro_bias: Vector3::zeros(),
                },
                destination: None,
                faults: Faults::default(),
            })
        };
        let (right, left) = (on(Side::Right), on(Side::Left));
        assert_eq!(right.lean, Vector2::new(0.1, 0.2));
        assert_eq!(left.lean, Vector2::new(-0.1, 0.2));
        let added = AddedAngles { ankle: Vector2::new(-0.3, 0.4), waist: Vector2::new(-0.5, 0.6) };
        assert_eq!(left.added, Some(added));
        assert_eq!(left.zmp_in_support, Some(Vector2::new(0.01, -0.02)));
        assert_eq!(left.zmp_planned, Some(Vector2::new(0.03, -0.04)));
        let com = ComState { position: Vector3::new(0.1, -0.08, 0.9), velocity: Vector3::new(0.4, 0.2, 0.01) };
        assert_eq!((left.com_planned, left.com_measured), (Some(com), None));
        assert_eq!(
            (left.estimate.contact, right.estimate.contact),
            ([false, true], [true, false]),
            "the right foot is the first"
        );
        assert_eq!(left.estimate.external_force, Vector2::new(10.0, -20.0));
        assert_eq!(left.estimate.com_offset, Vector2::new(0.01, -0.02));
        assert_eq!(left.turn, right.turn, "a command is not mirrored");
    }
}
