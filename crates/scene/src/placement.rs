//! Where the measured robot is in the walk frame: odometry tells the place of the support sole and its heading, the
//! inertial measurement unit the tilt of everything, and the encoders the posture.

use dynamics::{Kinematics, Tree};
use interface::{Measurement, Report};
use model::{Joint, Mechanism, Side};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

/// How far below a joint its link reaches (m), for a robot of the paper's size: so high above the floor a joint of a
/// robot that has fallen is drawn.
const BODY_RADIUS: f64 = 0.07;

/// The pose of the right sole in the walk frame. The lowest point of the robot is on the floor: nothing measures its
/// height.
pub(crate) fn right_sole_in_walk(
    mechanism: &Mechanism,
    tree: &Tree,
    scale: f64,
    report: &Report,
    measurement: &Measurement,
) -> Isometry3<f64> {
    // First as seen from the right sole.
    let mut kinematics = Kinematics::default();
    kinematics.compute_floating_base(tree, &Isometry3::identity(), &measurement.angles);
    let support = kinematics.sole_to_world(mechanism, report.half_step.support);
    let trunk = kinematics.link_to_world(Mechanism::TRUNK).rotation;

    let sole = &report.odometry.support_sole;
    let measured = UnitQuaternion::try_new(measurement.orientation, 0.5);
    let support_to_level =
        measured.map_or(UnitQuaternion::identity(), |level| level * trunk.inverse() * support.rotation);
    // The measured orientation says nothing about the heading in the walk frame.
    let ahead = support_to_level * Vector3::x();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), sole.heading - ahead.y.atan2(ahead.x));
    let support_in_walk = Isometry3::from_parts(Translation3::new(sole.x, sole.y, 0.0), turn * support_to_level);

    let right = support_in_walk * support.inverse();
    Translation3::new(0.0, 0.0, -lowest(mechanism, &kinematics, &right, BODY_RADIUS * scale)) * right
}

/// Height of the lowest point of soles and bodies (m).
fn lowest(mechanism: &Mechanism, kinematics: &Kinematics, right_sole: &Isometry3<f64>, radius: f64) -> f64 {
    let corners = Side::BOTH.into_iter().flat_map(|side| {
        let sole = right_sole * kinematics.sole_to_world(mechanism, side);
        mechanism.sole.corners(side).map(|corner| (sole * Point3::from(corner)).z)
    });
    let joints = Joint::ALL.into_iter().filter(|&joint| !is_at_foot(mechanism, joint));
    let bodies = joints.map(|joint| (right_sole * Point3::from(kinematics.origin[joint])).z - radius);
    corners.chain(bodies).fold(f64::INFINITY, f64::min)
}

/// Whether a joint is on the ground or at an ankle, which may be nearer to the floor than a body is thick.
fn is_at_foot(mechanism: &Mechanism, joint: Joint) -> bool {
    let at_ankle = |side: Side| {
        let leg = mechanism.leg(side);
        let place = leg.iter().position(|&of_leg| of_leg == joint);
        place.is_some_and(|place| [place, 5 - place][side.index()] < 2)
    };
    !joint.is_powered() || Side::BOTH.into_iter().any(at_ankle)
}

#[cfg(test)]
mod tests {
    use interface::{Odometry, WalkPose};
    use model::JointVector;

    use super::*;
    use crate::tests::{measured, mechanism, reported};

    fn placed(side: Side, tilt: f64, yaw: f64) -> (Isometry3<f64>, WalkPose) {
        let (mechanism, tree) = (mechanism(), Tree::new(&mechanism()));
        let angles = JointVector::from_fn(|joint| 0.02 * f64::from(joint.number()));
        let mut kinematics = Kinematics::default();
        kinematics.compute_floating_base(&tree, &Isometry3::identity(), &angles);
        let support = kinematics.sole_to_world(&mechanism, side);
        let trunk = kinematics.link_to_world(Mechanism::TRUNK).rotation;
        // What the unit measures of a support sole that is tilted, with a heading of its own.
        let turned =
            UnitQuaternion::from_euler_angles(0.0, 0.0, yaw) * UnitQuaternion::from_euler_angles(0.0, tilt, 0.0);
        let orientation = (turned * support.rotation.inverse() * trunk).into_inner();
        let sole = WalkPose { x: 1.0, y: -2.0, heading: 0.7 };
        let mut report = reported();
        report.half_step.support = side;
        report.odometry = Odometry { support_sole: sole, ..report.odometry };
        let measurement = Measurement { angles, orientation, ..measured() };
        let right = right_sole_in_walk(&mechanism, &tree, 1.0, &report, &measurement);
        (right * support, sole)
    }

    #[test]
    fn support_sole_is_where_odometry_has_it_whatever_the_measured_heading() {
        for side in Side::BOTH {
            for yaw in [0.0, 1.0, -3.0] {
                let (support, sole) = placed(side, 0.0, yaw);
                let ahead = support.rotation * Vector3::x();
                assert!((ahead.y.atan2(ahead.x) - sole.heading).abs() < 1e-12 && ahead.z.abs() < 1e-12, "{ahead}");
                let place = support.translation.vector.xy();
                assert!((place - nalgebra::Vector2::new(sole.x, sole.y)).norm() < 1e-12, "{place}");
            }
        }
    }

    #[test]
    fn a_robot_that_lies_is_drawn_on_the_floor() {
        let (support, _) = placed(Side::Right, 1.5, 0.3);
        let ahead = support.rotation * Vector3::x();
        assert!((ahead.z + 1.5_f64.sin()).abs() < 1e-12, "it is tilted as measured: {ahead}");
        assert!(support.translation.z > 0.0, "the trunk would be in the floor");
    }
}
