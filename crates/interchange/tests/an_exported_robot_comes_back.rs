//! Import undoes export: the legs and the waist of our robot, written as URDF and read again, are the same, number for
//! number, whichever link the URDF is rooted at, whatever its links and joints are called, in whatever order and frames
//! they stand. Its arms are held, and weigh on the trunk.

use config::Config;
use interchange::import::{Imported, NamedText, import};
use interchange::urdf::urdf;
use model::{Joint, Mechanism};
use nalgebra::{Rotation3, Vector3};
use urdf_rs::{JointType, Pose, Robot, Vec3};

#[test]
fn exported_urdf_imports_to_the_same_mechanism() {
    let imported = read(&urdf(&mechanism()), &map()).unwrap_or_else(|error| panic!("{error}"));
    is_ours(&imported, |joint| joint.name().to_string());
    let odd = imported.lines.iter().filter(|line| line.contains("symmetric") || line.contains("rate"));
    assert_eq!(odd.count(), 0, "{:?}", imported.lines);
}

#[test]
fn exported_urdf_needs_no_map_at_all() {
    let imported = import(NamedText { text: &text(&urdf(&mechanism())), file: "robot.urdf" }, None);
    let imported = imported.unwrap_or_else(|error| panic!("{error}"));
    let file: toml::Table = imported.text.parse().unwrap();
    let ours = mechanism().sole;
    let told = ["behind_m", "ahead_m", "width_m", "ankle_height_m"].map(|key| number(&file["sole"][key]));
    let expected = [ours.behind, ours.ahead, 2.0 * ours.half_width, ours.ankle_height];
    assert!(told.iter().zip(expected).all(|(told, ours)| (told - ours).abs() < 1e-9), "{told:?}");
    assert_eq!(imported.name, mechanism().name);
}

#[test]
fn printed_map_imports_to_the_same_text() {
    let urdf = text(&urdf(&mechanism()));
    let urdf = NamedText { text: &urdf, file: "robot.urdf" };
    let (first, map) = (map(), "map.toml");
    let imported = import(urdf, Some(NamedText { text: &first, file: map })).unwrap_or_else(|error| panic!("{error}"));
    let again = import(urdf, Some(NamedText { text: &imported.map, file: map }));
    assert_eq!(again.unwrap_or_else(|error| panic!("{error}")).text, imported.text);
}

#[test]
fn urdf_rooted_at_the_pelvis_imports_to_the_same_mechanism() {
    let imported = read(&at_pelvis(&mechanism()), &map()).unwrap_or_else(|error| panic!("{error}"));
    is_ours(&imported, |joint| joint.name().to_string());
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
    let foreign = |name: &str| format!("J\u{301}.\"{}\\", name.len() * 100 + usize::from(name.as_bytes()[0]));
    let foreign =
        |name: &str| format!("{}{}", foreign(name), name.to_uppercase().replace("RIGHT", "A").replace("LEFT", "B"));
    for joint in &mut robot.joints {
        joint.name = foreign(&joint.name);
        joint.parent.link = format!("Glied {}", joint.parent.link);
        joint.child.link = format!("Glied {}", joint.child.link);
    }
    robot.links.reverse();
    robot.joints.reverse();
    let mut map = map();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let toml = foreign(joint.name()).replace('\\', "\\\\").replace('"', "\\\"");
        map = map.replace(&format!("urdf = \"{}\"", joint.name()), &format!("urdf = \"{toml}\""));
    }
    let imported = read(&robot, &map).unwrap_or_else(|error| panic!("{error}"));
    is_ours(&imported, |joint| foreign(joint.name()));
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
    let imported = read(&robot, &map()).unwrap_or_else(|error| panic!("{error}"));
    let file: toml::Table = imported.text.parse().unwrap();
    let pelvis = &file["joint"]["right_hip_roll"];
    assert!((number(&pelvis["mass_kg"]) - 8.164).abs() < 1e-9);
    let more = 8.164 / 2.0 * 0.1 * 0.1;
    for (moment, expected) in
        pelvis["inertia_kg_m2"].as_array().unwrap().iter().zip([0.0657, 0.0525 + more, 0.0592 + more])
    {
        assert!((number(moment) - expected).abs() < 1e-9, "{moment} and {expected}");
    }
}

#[test]
fn urdf_that_is_no_such_biped_is_refused_with_joint_and_remedy() {
    let good = urdf(&mechanism());
    let whole = map();
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
    says(&error, &["map.toml:", "joint.right_knee.urdf", "\"right_nee\"", "must be a joint of the URDF"]);
    let error = read(&good, &whole.replace("\"right_knee\"", "\"left_knee\"")).map(|_| ()).expect_err("named twice");
    says(&error, &["joint.left_knee.urdf", "it is joint.right_knee's already"]);
    let exchanged = whole
        .replace("\"left_knee\"", "\"?\"")
        .replace("\"left_hip_pitch\"", "\"left_knee\"")
        .replace('?', "left_hip_pitch");
    let error = read(&good, &exchanged).map(|_| ()).expect_err("exchanged");
    says(&error, &["joint left_hip_pitch as left_knee: it is the left_hip_pitch", "joint left_knee as left_hip_pitch"]);
    let error = with(&|robot| joint(robot, "left_hip_yaw").axis.xyz = Vec3([0.0, 0.2, 0.8]));
    says(&error, &["joints right_hip_yaw and left_hip_yaw", "14.04°", "may by 2°"]);
    let error = with(&|robot| joint(robot, "left_knee").axis.xyz = Vec3([1.0, 0.0, 0.0]));
    says(&error, &["left leg, from the pelvis down left_hip_roll", "the fourth must be the knee"]);
    let error = with(&|robot| joint(robot, "left_knee").origin.xyz.0[2] -= 0.03);
    says(&error, &["joints right_knee and left_knee", "30.0 mm"]);
    let error = with(&|robot| link(robot, "right_shank").inertial.mass.value = 0.0);
    says(&error, &["the right shank weighs nothing"]);
    let error = with(&|robot| link(robot, "trunk").inertial.mass.value = -1.0);
    says(&error, &["link trunk: <mass> value = \"-1\": must be a number from 0"]);
    let error = with(&|robot| joint(robot, "left_knee").limit.lower = 3.0);
    says(&error, &["joint left_knee as left_knee", "lower = \"3\"", "lower must be less than upper"]);
    let error = with(&|robot| joint(robot, "left_knee").parent.link = "nowhere".into());
    says(&error, &["joint left_knee: <parent> link = \"nowhere\": must be one of the robot's links"]);
    let error = with(&|robot| joint(robot, "left_knee").joint_type = JointType::Fixed);
    says(&error, &["left_knee\": must be a joint that turns", "this one is fixed"]);
    let mut robot = good.clone();
    joint(&mut robot, "left_ankle_roll").joint_type = JointType::Fixed;
    let sole = &whole[..whole.find("[joint.").unwrap()];
    let error = read(&robot, sole).map(|_| ()).expect_err("eleven joints");
    says(&error, &["exactly six joints", "found 11 joints from foot to foot", "right_hip_yaw (about z)"]);
}

#[test]
fn differences_of_both_sides_are_taken_as_their_mean_and_told() {
    let mut robot = urdf(&mechanism());
    link(&mut robot, "left_thigh").inertial.mass.value += 1.0;
    joint(&mut robot, "left_knee").origin.xyz.0[2] -= 0.012;
    let imported = read(&robot, &map()).unwrap_or_else(|error| panic!("{error}"));
    let told = |words: &str| assert!(imported.lines.iter().any(|line| line.contains(words)), "{:?}", imported.lines);
    told("the mass of the body below the hip_pitch differs by 9.2 %");
    told("the knee axis differs by 12.0 mm");
    let file: toml::Table = imported.text.parse().unwrap();
    assert_eq!(number(&file["joint"]["right_knee"]["mass_kg"]), 10.86);
    assert_eq!(number(&file["joint"]["left_hip_pitch"]["mass_kg"]), 10.86);
}

/// Legs and waist are those of our own file, the trunk weighs as much as ours with its arms.
fn is_ours(imported: &Imported, urdf_name: impl Fn(Joint) -> String) {
    let ours: toml::Table = config_text().parse().unwrap();
    let theirs: toml::Table = imported.text.parse().unwrap_or_else(|error| panic!("{error}"));
    for key in ["name", "sole", "motor"] {
        assert!(same(&theirs[key], &ours[key]), "{key}: {} and {}", theirs[key], ours[key]);
    }
    for joint in Joint::ALL.into_iter().filter(|joint| *joint < Joint::RightShoulder) {
        let (own, other) = (&ours["joint"][joint.name()], &theirs["joint"][joint.name()]);
        for (key, value) in own.as_table().unwrap() {
            let with_arms = joint == Joint::WaistRoll && ["mass_kg", "com_m", "inertia_kg_m2"].contains(&key.as_str());
            assert!(with_arms || same(value, &other[key]), "{}.{key}: {value} and {}", joint.name(), other[key]);
        }
        if joint.is_powered() {
            assert_eq!(other["urdf"].as_str(), Some(urdf_name(joint).as_str()));
        }
    }
    let trunk = number(&theirs["joint"]["waist_roll"]["mass_kg"]);
    assert!((trunk - 28.625 - 2.0 * (1.98 + 1.624)).abs() < 1e-9, "{trunk}");
    assert!(theirs["joint"]["left_elbow"].get("range_deg").is_none());
    assert_eq!(theirs["held"].as_array().unwrap().len(), 4);
}

/// Whether two values of TOML are the same, whole numbers as others.
fn same(a: &toml::Value, b: &toml::Value) -> bool {
    match (a, b) {
        (toml::Value::Array(a), toml::Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (toml::Value::Table(a), toml::Value::Table(b)) => {
            a.len() == b.len() && a.iter().all(|(key, value)| b.get(key).is_some_and(|other| same(value, other)))
        }
        (toml::Value::String(a), toml::Value::String(b)) => a == b,
        _ => (number(a) - number(b)).abs() < 1e-12,
    }
}

fn number(value: &toml::Value) -> f64 {
    value.as_float().or(value.as_integer().map(|number| number as f64)).expect("a number")
}

fn config_text() -> String {
    std::fs::read_to_string(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn mechanism() -> Mechanism {
    Mechanism::from_toml(&config_text(), "mechanism.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn text(robot: &Robot) -> String {
    urdf_rs::write_to_string(robot).expect("a robot can be written")
}

fn read(robot: &Robot, map: &str) -> Result<Imported, String> {
    let text = text(robot);
    import(NamedText { text: &text, file: "robot.urdf" }, Some(NamedText { text: map, file: "map.toml" }))
        .map_err(|error| error.0)
}

/// A map for our robot with all joints of legs and waist.
fn map() -> String {
    let config = config_text();
    // name, sole and motors as in our own file
    let mut text = config[..config.find("[joint.").unwrap()].to_string();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered() && !joint.is_in_arm()) {
        text += &format!(
            "[joint.{}]\nurdf = \"{}\"\nmotor = \"leg\"\nrate_max_deg_per_s = 500\n",
            joint.name(),
            joint.name()
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
