//! Goal: both committed mechanism files load and hold the body of de Leva's tables (DESIGN §2).
//! Method: total mass, standing height and pelvis against numbers added up by hand; both axis readings side by side.

use config::Config;
use model::{Joint, Mechanism, Mirror, PerJoint, Side};
use nalgebra::Vector3;

fn committed(file: &str) -> Mechanism {
    let path = format!("{}/../../config/{file}", env!("CARGO_MANIFEST_DIR"));
    Mechanism::load(&path).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Positions of all joints in the world when the robot stands straight (m).
fn standing(mechanism: &Mechanism) -> PerJoint<Vector3<f64>> {
    let mut positions = PerJoint([Vector3::zeros(); Joint::COUNT]);
    for (joint, link) in mechanism.links.iter() {
        positions[joint] = link.parent.map_or(Vector3::zeros(), |parent| positions[parent]) + link.origin;
    }
    positions
}

#[test]
fn the_committed_robot_weighs_73_kg() {
    for file in ["mechanism.toml", "mechanism_other_reading.toml"] {
        assert!((committed(file).mass() - 73.031).abs() < 1e-12, "{file}");
    }
}

#[test]
fn the_robot_at_zero_angles_stands_upright_on_two_level_soles() {
    let mechanism = committed("mechanism.toml");
    let joints = standing(&mechanism);
    // 0.07 ankle + 0.434 shank + 0.422 thigh, then 0.1457 to the waist and 0.36 to the shoulders
    let near = |joint: Joint, place: [f64; 3]| {
        assert!((joints[joint] - Vector3::from(place)).norm() < 1e-12, "{}: {}", joint.name(), joints[joint]);
    };
    near(Joint::RightHipRoll, [0.0, 0.0, 0.926]);
    near(Joint::LeftHipRoll, [0.0, 0.19, 0.926]);
    near(Joint::WaistRoll, [0.0, 0.095, 1.0717]);
    near(Joint::RightShoulder, [0.0, -0.085, 1.4317]);
    near(Joint::LeftShoulder, [0.0, 0.275, 1.4317]);
    near(Joint::LeftAnkleRoll, [0.0, 0.19, 0.07]);
    let left_sole = joints[Joint::LeftAnkleRoll] + mechanism.sole_in_foot(Side::Left);
    assert!(left_sole.z.abs() < 1e-12, "the left sole is on the floor: {left_sole}");
}

#[test]
fn the_centre_of_mass_at_zero_angles_is_between_the_feet() {
    let mechanism = committed("mechanism.toml");
    let joints = standing(&mechanism);
    let moment: Vector3<f64> =
        mechanism.links.iter().map(|(joint, link)| link.body.mass * (joints[joint] + link.body.com)).sum();
    let com = moment / mechanism.mass();
    assert!((com.y - 0.095).abs() < 1e-12, "in the plane of symmetry: {com}");
    assert!((com.x - 2.0 * 0.997 * 0.044 / 73.031).abs() < 1e-12, "only the feet are ahead of the ankles: {com}");
    assert!((0.95..1.05).contains(&com.z), "at about 57 % of a man's 1.74 m: {com}");
}

#[test]
fn the_other_reading_of_the_paper_differs_in_the_axes_of_ankles_and_waist_only() {
    use Joint::*;
    let (agreed, other) = (committed("mechanism.toml"), committed("mechanism_other_reading.toml"));
    assert_ne!(agreed.fingerprint, other.fingerprint);
    let pairs =
        [(RightAnkleRoll, RightAnklePitch), (LeftAnkleRoll, LeftAnklePitch), (WaistRoll, WaistPitch)].into_iter();
    let swapped =
        |joint: Joint| pairs.clone().find_map(|(a, b)| (joint == a).then_some(b).or((joint == b).then_some(a)));
    for joint in Joint::ALL {
        let (here, there) = (&agreed.links[joint], &other.links[joint]);
        assert_eq!(
            (here.parent, here.origin, here.body, here.motor),
            (there.parent, there.origin, there.body, there.motor)
        );
        // Axis and range go together: a pitching ankle has a pitching ankle's range in either file.
        let same = &agreed.links[swapped(joint).unwrap_or(joint)];
        assert_eq!((there.axis, there.limits), (same.axis, same.limits), "{}", joint.name());
    }
}

#[test]
fn the_signs_of_the_mirror_are_those_of_the_papers_support_change() {
    // DESIGN §4.5: pitch exchanges with −, roll and yaw with +; the waist's pitch stays, its roll changes sign.
    use Joint::*;
    let mechanism = committed("mechanism.toml");
    let mirror = Mirror::new(&mechanism).expect("the committed robot is symmetric");
    for joint in [RightAnklePitch, RightKnee, RightHipPitch, LeftHipPitch, LeftKnee, LeftAnklePitch, WaistRoll] {
        assert_eq!(mirror.sign(joint), -1.0, "{}", joint.name());
    }
    for joint in [RightAnkleRoll, RightHipYaw, RightHipRoll, LeftHipRoll, LeftHipYaw, LeftAnkleRoll, WaistPitch] {
        assert_eq!(mirror.sign(joint), 1.0, "{}", joint.name());
    }
    for joint in [RightShoulder, RightElbow, LeftShoulder, LeftElbow] {
        assert_eq!(mirror.sign(joint), 1.0, "{}", joint.name());
    }
}

#[test]
fn knees_bend_backward_on_both_sides() {
    // The right shank carries the thigh, the left thigh carries the shank: in both, a bent knee is ahead of the line
    // from hip to ankle.
    let mechanism = committed("mechanism.toml");
    for (knee, next) in [(Joint::RightKnee, Joint::RightHipPitch), (Joint::LeftKnee, Joint::LeftAnklePitch)] {
        let limits = mechanism.links[knee].limits.expect("powered");
        let most = if limits.angle_max > -limits.angle_min { limits.angle_max } else { limits.angle_min };
        let end = mechanism.links[knee].rotation(most) * mechanism.links[next].origin;
        assert!(end.x < -0.3, "{}: the other end of the segment swings behind the knee, {end}", knee.name());
    }
}
