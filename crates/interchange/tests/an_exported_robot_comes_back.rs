//! Import undoes export: our robot, written as URDF and read again, is the same, number for number, whichever link the
//! URDF is rooted at, whatever its links and joints are called, in whatever order and frames they stand.

mod support;

use config::Config;
use interchange::import::{Imported, NamedText, import};
use interchange::urdf::urdf_text;
use model::{Joint, Mechanism};
use nalgebra::{Rotation3, Vector3};

use support::xml::TestElement;

#[test]
fn urdf_robot_has_the_mass_of_the_mechanism() {
    let robot = urdf(&mechanism());
    let mass: f64 = robot.all("link").map(|link| link.child("inertial").child("mass").number("value")).sum();
    assert!((mass - 73.031).abs() < 1e-12, "{mass}");
}

#[test]
fn urdf_joints_have_the_axes_and_limits_of_the_mechanism() {
    let mechanism = mechanism();
    let robot = urdf(&mechanism);
    assert_eq!((robot.all("link").count(), robot.all("joint").count()), (19, 18));
    for exported in robot.all("joint") {
        let joint = Joint::from_name(exported.get("name")).expect("a joint of the mechanism");
        let link = &mechanism.links[joint];
        let limits = link.limits.expect("powered");
        assert_eq!(exported.child("axis").vector("xyz"), *link.axis);
        assert_eq!(exported.child("origin").vector("xyz"), link.origin);
        let limit = exported.child("limit");
        assert_eq!((limit.number("lower"), limit.number("upper")), (limits.angle_min, limits.angle_max));
    }
}

#[test]
fn urdf_links_are_one_tree_rooted_at_the_right_foot() {
    let robot = urdf(&mechanism());
    let is_child = |name: &str| robot.all("joint").any(|joint| joint.child("child").get("link") == name);
    let roots: Vec<_> = robot.all("link").map(|link| link.get("name")).filter(|name| !is_child(name)).collect();
    assert_eq!(roots, ["right_foot"]);
    let is_link = |name: &str| robot.all("link").any(|link| link.get("name") == name);
    let ends = |joint: &TestElement| ["parent", "child"].iter().all(|end| is_link(joint.child(end).get("link")));
    assert!(robot.all("joint").all(ends));
}

#[test]
fn exported_urdf_imports_to_the_same_mechanism() {
    let imported = read(&urdf(&mechanism()), &map()).unwrap_or_else(|error| panic!("{error}"));
    is_ours(&imported, |joint| joint.name().to_string());
    let odd = imported.lines.iter().filter(|line| line.contains("symmetric") || line.contains("rate"));
    assert_eq!(odd.count(), 0, "{:?}", imported.lines);
}

#[test]
fn exported_urdf_needs_no_map_at_all() {
    let imported = import(NamedText { text: &urdf(&mechanism()).text(), file: "robot.urdf" }, None);
    let imported = imported.unwrap_or_else(|error| panic!("{error}"));
    let file: toml::Table = imported.text.parse().unwrap();
    let ours = mechanism().sole;
    let told = ["behind_m", "ahead_m", "width_m", "ankle_height_m"].map(|key| number(&file["sole"][key]));
    let expected = [ours.behind, ours.ahead, ours.inside + ours.outside, ours.ankle_height];
    assert!(told.iter().zip(expected).all(|(told, ours)| (told - ours).abs() < 1e-9), "{told:?}");
    assert_eq!(imported.name, mechanism().name);
}

/// Also as its own map tells them.
#[test]
fn soles_that_are_shifted_are_read_off_the_feet() {
    let mut robot = mechanism();
    (robot.sole.inside, robot.sole.outside) = (0.02, 0.05);
    let text = urdf(&robot).text();
    let urdf = NamedText { text: &text, file: "robot.urdf" };
    let found = import(urdf, None).unwrap_or_else(|error| panic!("{error}"));
    let told = import(urdf, Some(NamedText { text: &found.map, file: "map.toml" }));
    for imported in [&found, &told.unwrap_or_else(|error| panic!("{error}"))] {
        let file: toml::Table = imported.text.parse().unwrap();
        let aside = ["inside_m", "outside_m"].map(|key| number(&file["sole"][key]));
        assert!((aside[0] - 0.02).abs() < 1e-9 && (aside[1] - 0.05).abs() < 1e-9, "{aside:?}");
        assert!(file["sole"].get("width_m").is_none());
    }
}

#[test]
fn printed_map_imports_to_the_same_text() {
    let urdf = urdf(&mechanism()).text();
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

/// A mechanism's waist rolls as far to the right as to the left.
#[test]
fn waist_that_rolls_farther_to_one_side_rolls_as_far_as_to_both() {
    let mut robot = urdf(&mechanism());
    joint(&mut robot, "waist_roll").child_mut("limit").set("upper", 0.3);
    let imported = read(&robot, &map()).unwrap_or_else(|error| panic!("{error}"));
    let taken = Mechanism::from_toml(&imported.text, "mechanism.toml").unwrap_or_else(|error| panic!("{error}"));
    let limits = taken.links[Joint::WaistRoll].limits.expect("a waist");
    assert!((limits.angle_min + 0.3).abs() < 1e-9 && (limits.angle_max - 0.3).abs() < 1e-9, "{limits:?}");
    assert!(imported.lines.iter().any(|line| line.starts_with("waist_roll: range -17.2° to 17.2°")));

    joint(&mut robot, "waist_roll").child_mut("limit").set("lower", 0.0);
    let refused = read(&robot, &map()).expect_err("it rolls to one side");
    assert!(refused.contains("waist_roll: must move to both sides"), "{refused}");
}

#[test]
fn urdf_with_other_names_order_and_frames_imports_to_the_same_mechanism() {
    let ours = mechanism();
    let mut robot = at_pelvis(&ours);
    // a shank whose frame is turned any way, and a joint told from its other end
    turn_link(&mut robot, "left_knee", "left_ankle_pitch", [0.3, -0.2, 0.5]);
    let limit = joint(&mut robot, "left_hip_yaw").child_mut("limit");
    let (lower, upper) = (limit.number("lower"), limit.number("upper"));
    limit.set("lower", -upper);
    limit.set("upper", -lower);
    joint(&mut robot, "left_hip_yaw").child_mut("axis").set("xyz", "0 0 -1");
    // foreign names, the wrong way round
    let foreign = |name: &str| format!("J\u{301}.\"{}\\", name.len() * 100 + usize::from(name.as_bytes()[0]));
    let foreign =
        |name: &str| format!("{}{}", foreign(name), name.to_uppercase().replace("RIGHT", "A").replace("LEFT", "B"));
    let rename = |element: &mut TestElement, key: &str, new: &dyn Fn(&str) -> String| {
        let name = new(element.get(key));
        element.set(key, name);
    };
    let of_link = |name: &str| format!("Glied {name}");
    for element in &mut robot.children {
        match element.name.as_str() {
            "link" => rename(element, "name", &of_link),
            "joint" => {
                rename(element, "name", &foreign);
                rename(element.child_mut("parent"), "link", &of_link);
                rename(element.child_mut("child"), "link", &of_link);
            }
            _ => {}
        }
    }
    robot.children.reverse();
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
    let split = |robot: &mut TestElement, place: usize, offset: f64| {
        let share = 8.164 / 4.0;
        let mut part = link(robot, "pelvis").clone();
        part.set("name", format!("part {place}"));
        mass(&mut part).set("value", share);
        for (_, moment) in &mut part.child_mut("inertial").child_mut("inertia").attributes {
            *moment = "0".to_string();
        }
        let mut screwed = robot.all("joint").next().unwrap().clone();
        screwed.set("name", format!("screws {place}"));
        screwed.set("type", "fixed");
        screwed.child_mut("origin").set_vector("xyz", Vector3::new(offset, 0.0, 0.0));
        screwed.child_mut("parent").set("link", "pelvis");
        screwed.child_mut("child").set("link", part.get("name"));
        let pelvis = mass(link(robot, "pelvis"));
        pelvis.set("value", pelvis.number("value") - share);
        robot.children.extend([part, screwed]);
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
    let with = |change: &dyn Fn(&mut TestElement)| {
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
    let error = with(&|robot| joint(robot, "left_hip_yaw").child_mut("axis").set("xyz", "0 0.2 0.8"));
    says(&error, &["joints right_hip_yaw and left_hip_yaw", "14.04°", "may by 2°"]);
    let error = with(&|robot| joint(robot, "left_knee").child_mut("axis").set("xyz", "1 0 0"));
    says(&error, &["left leg, from the pelvis down left_hip_roll", "the fourth must be the knee"]);
    let error = with(&|robot| lower(joint(robot, "left_knee"), 0.03));
    says(&error, &["joints right_knee and left_knee", "30.0 mm"]);
    let error = with(&|robot| mass(link(robot, "right_shank")).set("value", 0.0));
    says(&error, &["the right shank weighs nothing"]);
    let error = with(&|robot| mass(link(robot, "trunk")).set("value", -1.0));
    says(&error, &["link trunk: <mass> value = \"-1\": must be a number from 0"]);
    let error = with(&|robot| joint(robot, "left_knee").child_mut("limit").set("lower", 3.0));
    says(&error, &["joint left_knee as left_knee", "lower = \"3\"", "lower must be less than upper"]);
    let error = with(&|robot| joint(robot, "left_knee").child_mut("parent").set("link", "nowhere"));
    says(&error, &["joint left_knee: <parent> link = \"nowhere\": must be one of the robot's links"]);
    let error = with(&|robot| joint(robot, "left_knee").set("type", "fixed"));
    says(&error, &["left_knee\": must be a joint that turns", "this one is fixed"]);
    let mut robot = good.clone();
    joint(&mut robot, "left_ankle_roll").set("type", "fixed");
    let sole = &whole[..whole.find("[joint.").unwrap()];
    let error = read(&robot, sole).map(|_| ()).expect_err("eleven joints");
    says(&error, &["exactly six joints", "found 11 joints from foot to foot", "right_hip_yaw (about z)"]);
}

#[test]
fn differences_of_both_sides_are_taken_as_their_mean_and_told() {
    let mut robot = urdf(&mechanism());
    let thigh = mass(link(&mut robot, "left_thigh"));
    thigh.set("value", thigh.number("value") + 1.0);
    lower(joint(&mut robot, "left_knee"), 0.012);
    let imported = read(&robot, &map()).unwrap_or_else(|error| panic!("{error}"));
    let told = |words: &str| assert!(imported.lines.iter().any(|line| line.contains(words)), "{:?}", imported.lines);
    told("the mass of the body below the hip_pitch differs by 9.2 %");
    told("the knee axis differs by 12.0 mm");
    let file: toml::Table = imported.text.parse().unwrap();
    assert_eq!(number(&file["joint"]["right_knee"]["mass_kg"]), 10.86);
    assert_eq!(number(&file["joint"]["left_hip_pitch"]["mass_kg"]), 10.86);
}

/// All joints are those of our own file.
fn is_ours(imported: &Imported, urdf_name: impl Fn(Joint) -> String) {
    let ours: toml::Table = config_text().parse().unwrap();
    let theirs: toml::Table = imported.text.parse().unwrap_or_else(|error| panic!("{error}"));
    for key in ["name", "sole", "motor"] {
        assert!(same(&theirs[key], &ours[key]), "{key}: {} and {}", theirs[key], ours[key]);
    }
    for joint in Joint::ALL {
        let (own, other) = (&ours["joint"][joint.name()], &theirs["joint"][joint.name()]);
        for (key, value) in own.as_table().unwrap() {
            assert!(same(value, &other[key]), "{}.{key}: {value} and {}", joint.name(), other[key]);
        }
        if joint.is_powered() {
            assert_eq!(other["urdf"].as_str(), Some(urdf_name(joint).as_str()));
        }
    }
    assert!(theirs.get("held").is_none());
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

/// The mechanism as URDF.
fn urdf(mechanism: &Mechanism) -> TestElement {
    TestElement::parse(&urdf_text(mechanism).expect("our robot can be written"))
}

fn read(robot: &TestElement, map: &str) -> Result<Imported, String> {
    import(NamedText { text: &robot.text(), file: "robot.urdf" }, Some(NamedText { text: map, file: "map.toml" }))
        .map_err(|error| error.0)
}

/// A map for our robot with all joints.
fn map() -> String {
    let config = config_text();
    // name, sole and motors as in our own file
    let mut text = config[..config.find("[servo.").unwrap()].to_string();
    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        let (motor, rate) = if joint.is_in_arm() { ("arm", 600) } else { ("leg", 500) };
        text += &format!(
            "[joint.{}]\nurdf = \"{}\"\nmotor = \"{motor}\"\nrate_max_deg_per_s = {rate}\n",
            joint.name(),
            joint.name()
        );
    }
    text
}

fn joint<'r>(robot: &'r mut TestElement, name: &str) -> &'r mut TestElement {
    robot.named_mut("joint", name)
}

fn link<'r>(robot: &'r mut TestElement, name: &str) -> &'r mut TestElement {
    robot.named_mut("link", name)
}

fn mass(link: &mut TestElement) -> &mut TestElement {
    link.child_mut("inertial").child_mut("mass")
}

/// Moves a joint down by a distance (m).
fn lower(joint: &mut TestElement, distance: f64) {
    let origin = joint.child_mut("origin");
    origin.set_vector("xyz", origin.vector("xyz") - distance * Vector3::z());
}

/// Our robot with the right leg hanging on the pelvis: every link between is told from its upper joint.
fn at_pelvis(ours: &Mechanism) -> TestElement {
    let mut robot = urdf(ours);
    let leg = &Joint::ALL[Joint::RightAnkleRoll.index()..=Joint::RightHipRoll.index()];
    for (place, reversed) in leg.iter().enumerate() {
        let above = leg.get(place + 1).map_or(Vector3::zeros(), |above| ours.links[*above].origin);
        let reversed_joint = joint(&mut robot, reversed.name());
        let up = reversed_joint.child("origin").vector("xyz");
        let [parent, child] = ["parent", "child"].map(|end| reversed_joint.child(end).get("link").to_string());
        reversed_joint.child_mut("parent").set("link", child);
        reversed_joint.child_mut("child").set("link", &parent);
        let axis = reversed_joint.child_mut("axis");
        axis.set_vector("xyz", -axis.vector("xyz"));
        reversed_joint.child_mut("origin").set_vector("xyz", -above);
        let com = link(&mut robot, &parent).child_mut("inertial").child_mut("origin");
        com.set_vector("xyz", com.vector("xyz") - up);
    }
    robot
}

/// Turns the frame of the link that a joint carries, and tells all that is mounted on it in the new one.
fn turn_link(robot: &mut TestElement, carrier: &str, carried: &str, rpy: [f64; 3]) {
    let turn = Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]);
    let back = |element: &mut TestElement| {
        element.set_vector("xyz", turn.inverse() * element.vector("xyz"));
    };
    let pose_back = |origin: &mut TestElement| {
        back(origin);
        let (roll, pitch, yaw) = turn.inverse().euler_angles();
        origin.set_vector("rpy", Vector3::new(roll, pitch, yaw));
    };
    let carrier = joint(robot, carrier);
    carrier.child_mut("origin").set_vector("rpy", rpy.into());
    back(carrier.child_mut("axis"));
    let name = carrier.child("child").get("link").to_string();
    pose_back(joint(robot, carried).child_mut("origin"));
    pose_back(link(robot, &name).child_mut("inertial").child_mut("origin"));
}
