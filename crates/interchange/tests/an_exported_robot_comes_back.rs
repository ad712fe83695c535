//! Import undoes export: our robot, written as URDF and read again, is the same robot, number for number, whichever
//! link the URDF is rooted at, whatever its links and joints are called, in whatever order and frames they stand. And
//! what is not our robot is refused by name.

use config::Config;
use interchange::import::{Imported, NamedText, import};
use interchange::urdf::urdf;
use model::{Joint, Mechanism};
use nalgebra::{Rotation3, Vector3};
use urdf_rs::{JointType, Pose, Robot, Vec3};

#[test]
fn exported_urdf_imports_to_the_same_mechanism() {
    let ours = mechanism();
    let imported = read(&urdf(&ours), &map(Joint::name)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(imported.mechanism, ours);
    assert!(imported.changes.is_empty(), "{:?}", imported.changes);
}

#[test]
fn urdf_rooted_at_the_pelvis_imports_to_the_same_mechanism() {
    let ours = mechanism();
    let imported = read(&at_pelvis(&ours), &map(Joint::name)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(imported.mechanism, ours);
}

#[test]
fn urdf_with_other_names_order_and_frames_imports_to_the_same_mechanism() {
    let ours = mechanism();
    let mut robot = at_pelvis(&ours);
    // a shank whose frame is turned any way, and a joint told from its other end
    turn_link(&mut robot, "left_knee", "left_ankle_pitch", [0.3, -0.2, 0.5]);
    let limit = &mut joint(&mut robot, "left_hip_yaw").limit;
    (limit.lower, limit.upper) = (-limit.upper, -limit.lower);
    joint(&mut robot, "left_hip_yaw").axis.xyz = Vec3([0.0, 0.0, -1.0]);
    // foreign names, the wrong way round
    for link in &mut robot.links {
        link.name = format!("Glied {}", link.name);
    }
    for joint in &mut robot.joints {
        joint.name = format!("J.{}", joint.name.to_uppercase());
        joint.parent.link = format!("Glied {}", joint.parent.link);
        joint.child.link = format!("Glied {}", joint.child.link);
    }
    robot.links.reverse();
    robot.joints.reverse();
    let map = map(|joint| Box::leak(format!("J.{}", joint.name().to_uppercase()).into_boxed_str()));
    let imported = read(&robot, &map).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(imported.mechanism, ours);
}

#[test]
fn fixed_link_of_a_urdf_is_combined_with_its_parent() {
    let ours = mechanism();
    let mut robot = urdf(&ours);
    // Half of the pelvis' mass as two parts ahead and behind leaves mass and centre, and adds m·r² about y and z.
    let split = |robot: &mut Robot, place: usize, offset: f64| {
        let pelvis = robot.links.iter().position(|link| link.name == "pelvis").unwrap();
        let mut part = robot.links[pelvis].clone();
        part.name = format!("part {place}");
        part.inertial.mass.value = 8.164 / 4.0;
        part.inertial.inertia = Default::default();
        let mut screwed = robot.joints[0].clone();
        screwed.name = format!("screws {place}");
        screwed.joint_type = JointType::Fixed;
        screwed.origin = Pose { xyz: Vec3([offset, 0.0, 0.0]), rpy: Vec3([0.0; 3]) };
        screwed.parent.link = "pelvis".into();
        screwed.child.link.clone_from(&part.name);
        robot.links[pelvis].inertial.mass.value -= part.inertial.mass.value;
        robot.links.push(part);
        robot.joints.push(screwed);
    };
    split(&mut robot, 1, 0.1);
    split(&mut robot, 2, -0.1);
    let imported = read(&robot, &map(Joint::name)).unwrap_or_else(|error| panic!("{error}")).mechanism;
    let (own, lumped) = (ours.links[Joint::RightHipRoll].body, imported.links[Joint::RightHipRoll].body);
    assert!((own.com - lumped.com).norm() < 1e-8 && (own.mass - lumped.mass).abs() < 1e-8);
    let more = 8.164 / 2.0 * 0.1 * 0.1;
    assert!((lumped.inertia - own.inertia - Vector3::new(0.0, more, more)).norm() < 1e-9, "{}", lumped.inertia);
}

#[test]
fn urdf_that_is_no_such_biped_is_refused_with_link_and_remedy() {
    let ours = mechanism();
    let good = urdf(&ours);
    let whole = map(Joint::name);
    let with = |change: &dyn Fn(&mut Robot)| {
        let mut robot = good.clone();
        change(&mut robot);
        read(&robot, &whole).map(|_| ()).expect_err("not our robot")
    };
    let says = |error: &str, words: &[&str]| {
        for word in words {
            assert!(error.contains(word), "`{word}` is not in: {error}");
        }
    };

    let error = read(&good, &whole.replace("\"right_knee\"", "\"right_nee\"")).map(|_| ()).expect_err("no such joint");
    says(&error, &["map.toml:", "joint.right_knee.urdf", "\"right_nee\"", "must be a joint of the URDF", "[[fixed]]"]);
    let error = read(&good, &whole.replace("\"right_knee\"", "\"left_knee\"")).map(|_| ()).expect_err("named twice");
    says(&error, &["joint.left_knee.urdf", "it is joint.right_knee's already"]);
    let exchanged = whole
        .replace("\"left_knee\"", "\"?\"")
        .replace("\"left_hip_pitch\"", "\"left_knee\"")
        .replace('?', "left_hip_pitch");
    says(
        &read(&good, &exchanged).map(|_| ()).expect_err("exchanged"),
        &["robot.urdf: joint left_hip_pitch as left_knee", "must be"],
    );
    let error = with(&|robot| joint(robot, "left_hip_yaw").axis.xyz = Vec3([0.0, 0.2, 0.8]));
    says(&error, &["robot.urdf: joint left_hip_yaw as left_hip_yaw", "must lie along z"]);
    let error = with(&|robot| joint(robot, "left_knee").origin.xyz.0[2] -= 0.01);
    // half of it off the mean
    says(&error, &["5.00 mm off its mean", "idealise.asymmetry_max_m = 0.005"]);
    let error = with(&|robot| joint(robot, "left_hip_pitch").origin.xyz.0[2] -= 0.02);
    says(&error, &["20.0 mm", "idealise.axes_moved_max_m = 0.02"]);
    let error = with(&|robot| link(robot, "right_shank").inertial.mass.value = 0.0);
    says(&error, &["right_shank weighs nothing"]);
    let error = with(&|robot| link(robot, "trunk").inertial.mass.value = -1.0);
    says(&error, &["link trunk: mass = -1: must be at least 0"]);
    let error = with(&|robot| link(robot, "trunk").inertial.inertia.ixz = 0.2);
    says(&error, &["trunk", "products_of_inertia_max_share = 0.194"]);
    let error = with(&|robot| link(robot, "left_thigh").inertial.mass.value += 1.0);
    says(&error, &["the mass of right_thigh", "asymmetry_max_share"]);
    let error = with(&|robot| joint(robot, "left_knee").limit.lower = 0.3);
    says(&error, &["joint left_knee as left_knee", "17.19°", "must have 0.00° inside"]);
    let error = with(&|robot| joint(robot, "left_knee").parent.link = "nowhere".into());
    says(&error, &["joint left_knee: link nowhere must be one of the robot's links"]);
}

fn mechanism() -> Mechanism {
    Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR")))
        .unwrap_or_else(|e| panic!("{e}"))
}

fn read(robot: &Robot, map: &str) -> Result<Imported, String> {
    let text = urdf_rs::write_to_string(robot).expect("a robot can be written");
    import(NamedText { text: &text, file: "robot.urdf" }, NamedText { text: map, file: "map.toml" })
        .map_err(|error| error.0)
}

/// A map for our robot, whose joints are called so.
fn map(called: impl Fn(Joint) -> &'static str) -> String {
    let config =
        std::fs::read_to_string(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
    // name, sole and motors as in our own file
    let mut text = config[..config.find("[joint.").unwrap()].to_string();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let motor = if joint >= Joint::RightShoulder { "arm" } else { "leg" };
        text += &format!(
            "[joint.{}]\nurdf = \"{}\"\nmotor = \"{motor}\"\nrate_max_deg_per_s = {}\n",
            joint.name(),
            called(joint),
            if motor == "arm" { 600 } else { 500 }
        );
    }
    text
}

fn joint<'r>(robot: &'r mut Robot, name: &str) -> &'r mut urdf_rs::Joint {
    robot.joints.iter_mut().find(|joint| joint.name == name).unwrap()
}

fn link<'r>(robot: &'r mut Robot, name: &str) -> &'r mut urdf_rs::Link {
    robot.links.iter_mut().find(|link| link.name == name).unwrap()
}

/// Our robot with the right leg hanging on the pelvis: every link between is told from its upper joint.
fn at_pelvis(ours: &Mechanism) -> Robot {
    let mut robot = urdf(ours);
    let leg = &Joint::ALL[Joint::RightAnkleRoll.index()..=Joint::RightHipRoll.index()];
    for (place, reversed) in leg.iter().enumerate() {
        let above = leg.get(place + 1).map_or(Vector3::zeros(), |above| ours.links[*above].origin);
        let reversed_joint = joint(&mut robot, reversed.name());
        let up = Vector3::from(reversed_joint.origin.xyz.0);
        std::mem::swap(&mut reversed_joint.parent.link, &mut reversed_joint.child.link);
        reversed_joint.axis.xyz = Vec3((-Vector3::from(reversed_joint.axis.xyz.0)).into());
        reversed_joint.origin.xyz = Vec3((-above).into());
        let below = reversed_joint.child.link.clone();
        let com = &mut link(&mut robot, &below).inertial.origin.xyz;
        *com = Vec3((Vector3::from(com.0) - up).into());
    }
    robot
}

/// Turns the frame of the link that a joint carries, and tells all that is mounted on it in the new one.
fn turn_link(robot: &mut Robot, carrier: &str, carried: &str, rpy: [f64; 3]) {
    let turn = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
    let back = |vector: &mut Vec3| *vector = Vec3((turn.inverse() * Vector3::from(vector.0)).into());
    let turned_back = |angles: &mut Vec3| {
        let (roll, pitch, yaw) = turn.inverse().euler_angles();
        *angles = Vec3([roll, pitch, yaw]);
    };
    let carrier = joint(robot, carrier);
    carrier.origin.rpy = Vec3(rpy);
    back(&mut carrier.axis.xyz);
    let name = carrier.child.link.clone();
    let next = joint(robot, carried);
    back(&mut next.origin.xyz);
    turned_back(&mut next.origin.rpy);
    let body = &mut link(robot, &name).inertial;
    back(&mut body.origin.xyz);
    turned_back(&mut body.origin.rpy);
}
