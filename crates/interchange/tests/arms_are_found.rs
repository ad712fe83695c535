//! Shoulders and elbows are found by the tree and the axes, whatever they are called. Arms that stick out to the side
//! at the URDF's zero are held so that they hang. Arms that cannot swing alike on both sides are held, and it is said
//! why.

mod support;

use std::fmt::Write;

use config::Config;
use interchange::import::{Imported, NamedText, import};
use model::{Joint, Mechanism};

use support::as_number;
use support::robots::{Allowed, is_symmetric, same_robot};
use support::walker::{in_joint, walker};

#[test]
fn shoulders_and_elbows_are_found_by_their_axes() {
    let imported = import_arms(&HANGING, "");
    roles_are(&imported, &["a right", "d right", "a left", "d left"]);
    // a little to the side, clear of the legs
    assert_eq!([held(&imported, "b right"), held(&imported, "b left")], [-15.0, 15.0]);
    told(&imported, "right arm: shoulder a right, elbow d right; it hangs with b right at -15°");
    let mut narrow = HANGING;
    narrow[1].range = [-0.1, 1.6];
    assert_eq!(held(&import_arms(&narrow, ""), "b right"), 0.0);
}

/// The shoulder turns about y and the arm points aside: what bends the forearm forward is the joint about z, as in the
/// Booster T1.
#[test]
fn arms_that_stick_out_to_the_side_hang() {
    let imported = import_arms(&STICKING_OUT, "");
    roles_are(&imported, &["a right", "d right", "a left", "d left"]);
    assert_eq!([held(&imported, "b right"), held(&imported, "b left")], [75.0, -75.0]);
    assert_eq!([held(&imported, "c right"), held(&imported, "c left")], [0.0, 0.0]);
    let mechanism = Mechanism::from_toml(&imported.text, "mechanism.toml").unwrap_or_else(|error| panic!("{error}"));
    let forearm = mechanism.links[Joint::RightElbow].body.com;
    assert!(forearm.z < -0.04 && forearm.y < 0.0 && forearm.y > -0.03, "{forearm}");
    assert!(mechanism.links[Joint::RightElbow].axis.y > 0.9);
    told(&imported, "hangs with b right at 75°");
}

/// An elbow about x bends to the side while the arm hangs: the upper arm is turned, as in QingLong.
#[test]
fn elbows_that_would_bend_to_the_side_bend_forward() {
    let mut arm = STICKING_OUT;
    arm[2].axis = [0.0, 1.0, 0.0];
    arm[3] = ArmJoint { axis: [-1.0, 0.0, 0.0], range: [0.0, 2.5], ..arm[3] };
    let imported = import_arms(&arm, "");
    roles_are(&imported, &["a right", "d right", "a left", "d left"]);
    assert_eq!(held(&imported, "c right").abs(), 90.0);
    let mechanism = Mechanism::from_toml(&imported.text, "mechanism.toml").unwrap_or_else(|error| panic!("{error}"));
    let (link, elbow) = (&mechanism.links[Joint::RightElbow], mechanism.links[Joint::RightElbow].limits.unwrap());
    assert!(link.axis.y > 0.9);
    // against a rotation about y
    assert!(elbow.angle_min < -2.0 && elbow.angle_max < 0.01, "{elbow:?}");
}

#[test]
fn shoulder_that_cannot_reach_the_ground_with_its_arm_is_held() {
    let mut arm = STICKING_OUT;
    arm[1].range = [-0.3, 0.3];
    are_held(&import_arms(&arm, ""), "right arm: it sticks out to the side");
    // but a map may hold it in another posture
    let map = "[[held]]\nurdf = \"b right\"\nat_deg = 90\n[[held]]\nurdf = \"b left\"\nat_deg = -90\n";
    roles_are(&import_arms(&STICKING_OUT, map), &["a right", "d right", "a left", "d left"]);
}

#[test]
fn arms_without_a_joint_that_swings_them_are_held() {
    let mut arm = HANGING;
    arm[0].axis = [0.0, 0.0, 1.0];
    are_held(&import_arms(&arm, ""), "right arm: no joint near the trunk swings it forward and backward");
}

#[test]
fn one_arm_alone_is_held() {
    let urdf = with_arms(&HANGING);
    let one = urdf.replace("<joint name=\"a left\" type=\"revolute\">", "<joint name=\"a left\" type=\"fixed\">");
    let one = ["b", "c", "d"].iter().fold(one, |urdf, joint| {
        let revolute = format!("<joint name=\"{joint} left\" type=\"revolute\">");
        urdf.replace(&revolute, &revolute.replace("revolute", "fixed"))
    });
    are_held(&read(&one, ""), "there is no left arm");
}

#[test]
fn arms_that_are_no_mirror_images_are_held() {
    let oblique = in_joint(&with_arms(&HANGING), "a left", "xyz=\"0 1 0\"", "xyz=\"0 0.97 0.243\"");
    are_held(&read(&oblique, ""), "the shoulders a right and a left are no mirror images: their axes differ by 14.06°");
    let stiff = in_joint(&with_arms(&HANGING), "d left", "type=\"revolute\"", "type=\"fixed\"");
    are_held(&read(&stiff, ""), "only one has an elbow, d right");
    let apart = in_joint(&with_arms(&HANGING), "a left", "lower=\"-3\"", "lower=\"0.995\"");
    are_held(&read(&apart, ""), "the shoulders a right and a left share no range");
    let unlimited = in_joint(&with_arms(&HANGING), "d left", "<limit", "<no_limit");
    are_held(&read(&unlimited, ""), "joint d left as left_elbow: must have <limit");
}

#[test]
fn a_map_chooses_other_joints_and_limits() {
    let map = "[joint.right_elbow]\nurdf = \"e right\"\n[joint.left_elbow]\nurdf = \"e left\"\n\
               [joint.right_shoulder]\neffort_n_m = 7\n[joint.left_shoulder]\neffort_n_m = 7\n";
    let mut arm = HANGING.to_vec();
    arm.push(ArmJoint { name: "e", at: [0.0, 0.0, -0.1], axis: [0.0, 1.0, 0.0], range: [-1.0, 0.5] });
    let imported = import_arms(&arm, map);
    roles_are(&imported, &["a right", "e right", "a left", "e left"]);
    assert_eq!(held(&imported, "d right"), 0.0);
    let file: toml::Table = imported.text.parse().unwrap();
    assert_eq!(as_number(&file["joint"]["right_shoulder"]["effort_n_m"]), 7.0);

    let error = refused(&arm, "[joint.right_shoulder]\nurdf = \"b right\"\n");
    assert!(error.contains("joint b right as right_shoulder: right arm: does not turn about y"), "{error}");
    let error = refused(&arm, "[joint.right_shoulder]\nurdf = \"a left\"\n");
    assert!(error.contains("joint a left as right_shoulder: right arm: is no joint of that arm"), "{error}");
}

#[test]
fn a_map_declines_arms() {
    let all = ["a", "b", "c", "d"].map(|joint| format!("[[held]]\nurdf = \"{joint} left\"\n")).concat();
    are_held(&import_arms(&HANGING, &all), "left arm: the map holds all of its joints");
    let shoulder = "[[held]]\nurdf = \"a right\"\n";
    are_held(&import_arms(&HANGING, shoulder), "right arm: no joint near the trunk");
    // an elbow that is held leaves the shoulder
    let elbows = "[[held]]\nurdf = \"d right\"\nat_deg = -20\n[[held]]\nurdf = \"d left\"\nat_deg = -20\n";
    roles_are(&import_arms(&HANGING, elbows), &["a right", "a left"]);
}

#[test]
fn printed_maps_import_to_the_same_text() {
    for arm in [HANGING, STICKING_OUT] {
        let imported = import_arms(&arm, "");
        assert_eq!(read(&with_arms(&arm), &imported.map).text, imported.text);
    }
}

/// A joint of the right arm, with the link that it carries.
#[derive(Clone, Copy)]
struct ArmJoint {
    name: &'static str,
    /// Place in the link before (m).
    at: [f64; 3],
    axis: [f64; 3],
    /// Smallest and largest angle (rad).
    range: [f64; 2],
}

/// An arm that hangs: pitch, roll and yaw at the shoulder, an elbow.
const HANGING: [ArmJoint; 4] = [
    ArmJoint { name: "a", at: [0.0, -0.15, 0.3], axis: [0.0, 1.0, 0.0], range: [-3.0, 1.0] },
    ArmJoint { name: "b", at: [0.0, -0.02, 0.0], axis: [1.0, 0.0, 0.0], range: [-1.6, 1.6] },
    ArmJoint { name: "c", at: [0.0, 0.0, -0.05], axis: [0.0, 0.0, 1.0], range: [-1.6, 1.6] },
    ArmJoint { name: "d", at: [0.0, 0.0, -0.1], axis: [0.0, 1.0, 0.0], range: [-2.0, 0.1] },
];

/// An arm that points to the right, otherwise the same.
const STICKING_OUT: [ArmJoint; 4] = [
    HANGING[0],
    HANGING[1],
    ArmJoint { name: "c", at: [0.0, -0.05, 0.0], axis: [0.0, 1.0, 0.0], range: [-1.6, 1.6] },
    ArmJoint { name: "d", at: [0.0, -0.1, 0.0], axis: [0.0, 0.0, 1.0], range: [-0.1, 2.0] },
];

/// The walker with these joints instead of its shoulders, and their mirror image on the left.
fn with_arms(arm: &[ArmJoint]) -> String {
    let mut more = String::new();
    for (side, sign) in [("right", 1.0), ("left", -1.0)] {
        let mut parent = "torso".to_string();
        for (place, ArmJoint { name, at, axis, range }) in arm.iter().enumerate() {
            let next = arm.get(place + 1).map_or(arm[arm.len() - 1].at, |next| next.at);
            // A mirrored rotation about x or z has the other sign.
            let [low, high] = if axis[1] == 0.0 && sign < 0.0 { [-range[1], -range[0]] } else { *range };
            let link = format!("{name}{name} {side}");
            let _ = write!(
                more,
                "<link name=\"{link}\"><inertial><origin xyz=\"{} {} {}\"/><mass value=\"0.4\"/><inertia ixx=\"0.001\" \
                 iyy=\"0.001\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n<joint name=\"{name} \
                 {side}\" type=\"revolute\"><origin xyz=\"{} {} {}\"/><parent link=\"{parent}\"/><child \
                 link=\"{link}\"/><axis xyz=\"{} {} {}\"/><limit lower=\"{low}\" upper=\"{high}\" effort=\"20\" \
                 velocity=\"9\"/></joint>\n",
                next[0] / 2.0,
                sign * next[1] / 2.0,
                next[2] / 2.0,
                at[0],
                sign * at[1],
                at[2],
                axis[0],
                axis[1],
                axis[2],
            );
            parent = link;
        }
    }
    let bare = ["right", "left"].iter().fold(walker(), |urdf, side| {
        in_joint(&urdf, &format!("{side}_shoulder"), "type=\"revolute\"", "type=\"fixed\"")
    });
    bare.replace("</robot>", &format!("{more}</robot>"))
}

fn read(urdf: &str, map: &str) -> Imported {
    let urdf = NamedText { text: urdf, file: "robot.urdf" };
    let imported = import(urdf, Some(NamedText { text: map, file: "map.toml" }));
    let imported = imported.unwrap_or_else(|error| panic!("{error}"));
    Mechanism::from_toml(&imported.text, "mechanism.toml").unwrap_or_else(|errors| panic!("{errors}"));
    imported
}

/// What the walker with such arms becomes; it is the robot that its URDF describes.
fn import_arms(arm: &[ArmJoint], map: &str) -> Imported {
    let imported = read(&with_arms(arm), map);
    same_robot(&with_arms(arm), &imported, 0.0, Allowed { place: 1e-9, arms: 1e-9, com: 1e-9 });
    is_symmetric(&imported);
    imported
}

fn refused(arm: &[ArmJoint], map: &str) -> String {
    let urdf = with_arms(arm);
    let urdf = NamedText { text: &urdf, file: "robot.urdf" };
    import(urdf, Some(NamedText { text: map, file: "map.toml" })).expect_err("arms that the map has wrong").0
}

fn roles_are(imported: &Imported, names: &[&str]) {
    let of_arms = imported.roles.iter().filter(|(role, _)| role.is_in_arm()).map(|(_, name)| name.as_str());
    assert_eq!(of_arms.collect::<Vec<_>>(), names, "{:?}", imported.lines);
}

fn are_held(imported: &Imported, why: &str) {
    roles_are(imported, &[]);
    told(imported, &format!("arms: held; {why}"));
}

fn told(imported: &Imported, words: &str) {
    assert!(imported.lines.iter().any(|line| line.contains(words)), "{words}: {:?}", imported.lines);
}

/// The angle at which a joint is held (°).
fn held(imported: &Imported, joint: &str) -> f64 {
    let file: toml::Table = imported.text.parse().unwrap();
    let held = file["held"].as_array().unwrap().iter();
    let mut angles = held.filter(|held| held["urdf"].as_str() == Some(joint)).map(|held| as_number(&held["at_deg"]));
    angles.next().unwrap_or_else(|| panic!("{joint} is not held"))
}
