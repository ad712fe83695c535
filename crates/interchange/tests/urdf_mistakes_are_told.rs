//! Mistakes of a URDF are told where they stand: file, line, link or joint, element, value and what would be right, all
//! at once; what is no mistake is taken.

mod support;

use config::Config;
use interchange::import::{Imported, NamedText, import};
use model::Mechanism;

use support::Tree;
use support::robots::{Allowed, is_symmetric, same_robot};
use support::walker::{in_joint, in_link, walker};

#[test]
fn walker_needs_no_map_and_comes_in_exactly() {
    let imported = taken(&walker(), "");
    same_robot(&walker(), &imported, 0.0, Allowed { place: 1e-9, arms: 1e-9, com: 1e-9 });
    is_symmetric(&imported);
    let file: toml::Table = imported.text.parse().unwrap();
    let sole = |key: &str| file["sole"][key].as_float().unwrap();
    assert!((sole("behind_m") - 0.05).abs() < 1e-9 && (sole("ahead_m") - 0.11).abs() < 1e-9);
    assert!((sole("width_m") - 0.08).abs() < 1e-9 && (sole("ankle_height_m") - 0.04).abs() < 1e-9);
    told(&imported, "the map tells no name: called walker");
}

#[test]
fn coupled_joints_are_told() {
    let mimic = "<mimic joint=\"right_shoulder\" multiplier=\"1\"/></joint>";
    let arm = in_joint(&walker(), "left_shoulder", "</joint>", mimic);
    told(&taken(&arm, ""), "couplings to right_shoulder are not taken over (mimic): left_shoulder held");
    let map = "name = \"w\"\n[joint.left_shoulder]\nurdf = \"left_shoulder\"\n";
    refused_with_map(&arm, map, &["map.toml:3:8", "joint.left_shoulder.urdf", "mimics joint right_shoulder"]);
    let knee = in_joint(&walker(), "left_knee", "</joint>", "<mimic joint=\"right_knee\"/></joint>");
    refused(&knee, &["robot.urdf:", "joint left_knee as left_knee", "<mimic joint = \"right_knee\">"]);
    let of_used = in_joint(&walker(), "left_shoulder", "</joint>", "<mimic joint=\"left_knee\"/></joint>");
    told(&taken(&of_used, ""), "couplings to left_knee, which moves, are not taken over");
}

#[test]
fn what_is_no_tree_is_refused_with_its_links() {
    let more = |more: &str| walker().replace("</robot>", &format!("{more}</robot>"));
    let joint = |name: &str, parent: &str, child: &str| {
        format!("<joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>\n")
    };
    let itself = more(&format!("<link name=\"plate\"/>\n{}", joint("to itself", "plate", "plate")));
    refused(&itself, &["joint to itself", "from a link to itself, plate"]);
    let ring = more(&format!("<link name=\"a\"/><link name=\"b\"/>{}{}", joint("x", "a", "b"), joint("y", "b", "a")));
    refused(&ring, &["the links a, b hang together in a ring"]);
    let only_ring = format!(
        "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>{}{}</robot>",
        joint("x", "a", "b"),
        joint("y", "b", "a")
    );
    refused(&only_ring, &["the links a, b hang together in a ring"]);
    refused(
        &more(&joint("closing", "left_shank", "right_foot")),
        &["joint closing", "right_foot", "joint right_ankle_roll (line"],
    );
    refused(&more("<link name=\"lonely\"/>"), &["pelvis, lonely", "are no joint's child"]);
    refused(&more("<link name=\"torso\"/>"), &["link torso: must have a name of its own", "line 14 has it"]);
    refused(&more(&joint("left_knee", "torso", "pelvis")), &["joint left_knee: must have a name of its own"]);
    refused(
        &more(&joint("to nowhere", "torso", "nowhere")),
        &["<child> link = \"nowhere\"", "one of the robot's links"],
    );
    refused(&more("<joint name=\"half\" type=\"fixed\"/>"), &["must have <parent link", "must have <child link"]);
}

#[test]
fn names_of_all_scripts_come_back() {
    for name in
        ["Lau\u{308}fer e\u{301}", "दो पैर वाला", "walker 👩\u{200d}🔧", "C:\\n \"quoted\" 'x'", "tab\tbell\u{7}"]
    {
        let quoted = name.replace('\\', "\\\\").replace('"', "\\\"").replace('\t', "\\t").replace('\u{7}', "\\u0007");
        let quoted = format!("\"{quoted}\"");
        let urdf = walker().replace("left_knee", &name.replace('"', "&quot;").replace(['\t', '\u{7}'], "_"));
        let map = format!(
            "name = {quoted}\n[motor.{quoted}]\nresistance_ohm = 1\ntorque_constant_n_m_per_a = \
             0.05\nrotor_inertia_kg_m2 = 1e-5\ngear_ratio = 50\nvoltage_max_v = 48\n[joint.left_knee]\nmotor = \
             {quoted}\n[joint.right_knee]\nmotor = {quoted}\n"
        );
        let imported = taken(&urdf, &map);
        let file: toml::Table = imported.text.parse().unwrap_or_else(|error| panic!("{error}: {}", imported.text));
        assert_eq!(file["name"].as_str(), Some(name));
        assert_eq!(file["joint"]["left_knee"]["motor"].as_str(), Some(name));
        assert!(file["motor"].get(name).is_some());
        let expected = name.replace(['\t', '\u{7}'], "_");
        assert_eq!(file["joint"]["left_knee"]["urdf"].as_str(), Some(expected.as_str()));
        assert_eq!(taken(&urdf, &imported.map).text, imported.text);
    }
}

#[test]
fn numbers_that_are_none_are_refused_where_they_stand() {
    for bad in ["nan", "inf", "-inf", "1e400", "", "x", "1,5", "${size}"] {
        let value = format!("\"{bad}\"");
        let three = format!("\"{bad} 0 0\"");
        let cases = [
            (in_joint(&walker(), "left_knee", "\"0 0 -0.2\"", &three), "joint left_knee: <origin> xyz"),
            (in_joint(&walker(), "left_knee", "\"0 1 0\"", &three), "joint left_knee: <axis> xyz"),
            (in_joint(&walker(), "left_knee", "\"-0.1\"", &value), "joint left_knee: <limit> lower"),
            (in_joint(&walker(), "left_knee", "\"9\"", &value), "joint left_knee: <limit> velocity"),
            (in_joint(&walker(), "left_shoulder", "\"30\"", &value), "joint left_shoulder: <limit> effort"),
            (in_link(&walker(), "torso", "\"0 0 0.15\"", &three), "link torso: <origin> xyz"),
            (in_link(&walker(), "torso", "\"6\"", &value), "link torso: <mass> value"),
            (in_link(&walker(), "torso", "ixx=\"0.024\"", &format!("ixx={value}")), "link torso: <inertia> ixx"),
            (in_link(&walker(), "left_foot", "\"0.16 0.08 0.02\"", &three), "link left_foot: <box> size"),
        ];
        for (urdf, place) in cases {
            refused(&urdf, &["robot.urdf:", place, "must be"]);
        }
    }
    refused(&in_link(&walker(), "torso", "\"6\"", "\"-6\""), &["robot.urdf:17: link torso: <mass> value = \"-6\""]);
    refused(&in_joint(&walker(), "left_knee", "\"9\"", "\"-9\""), &["<limit> velocity = \"-9\"", "at least 0"]);
    refused(&in_joint(&walker(), "left_knee", "\"0 1 0\"", "\"0 0 0\""), &["joint left_knee", "must be a direction"]);
    refused(&in_joint(&walker(), "left_knee", "revolute", "hinge"), &["type = \"hinge\"", "revolute, continuous"]);
    let two = in_link(&walker(), "torso", "\"6\"", "\"6kg\"");
    let two = in_joint(&two, "right_knee", "upper=\"2.2\"", "upper=\"y\"");
    let error = refused(&two, &["link torso: <mass> value = \"6kg\"", "joint right_knee: <limit> upper = \"y\""]);
    assert_eq!(error.lines().count(), 2, "{error}");
    assert!(!error.contains("custom"));
}

#[test]
fn other_units_are_suspected() {
    let scaled = |factor: f64, key: &str| {
        let mut text = String::new();
        for (place, part) in walker().split(key).enumerate() {
            if place == 0 {
                text += part;
                continue;
            }
            let (numbers, rest) = part.split_once('"').unwrap();
            let numbers = numbers.split(' ').map(|number| (number.parse::<f64>().unwrap() * factor).to_string());
            text += &format!("{key}{}\"{rest}", numbers.collect::<Vec<_>>().join(" "));
        }
        text
    };
    refused(&scaled(1000.0, "xyz=\""), &["legs are 400.0000 long", "0.1 to 2 m", "millimetres"]);
    refused(&scaled(100.0, "xyz=\""), &["legs are 40.0000 long", "centimetres"]);
    refused(&scaled(1000.0, "mass value=\""), &["weighs 15400.0000", "grams"]);
    refused(&scaled(1e-3, "mass value=\""), &["weighs 0.0154", "tonnes"]);
    refused(&scaled(1e6, "ixx=\""), &["the trunk", "another unit"]);
    let degrees = in_joint(&walker(), "left_knee", "upper=\"2.2\"", "upper=\"126\"");
    refused(&degrees, &["joint left_knee as left_knee", "7219°", "radians", "looks like degrees"]);
    let turned = in_joint(&walker(), "left_knee", "xyz=\"0 0 -0.2\"", "xyz=\"0 0 -0.2\" rpy=\"0 0 90\"");
    refused(&turned, &["joint left_knee: <origin> rpy = \"0 0 90\"", "radians, not degrees"]);
    let far = in_link(&walker(), "torso", "\"0 0 0.15\"", "\"0 0 150\"");
    refused(&far, &["link torso: its centre of mass is 150.000 m", "another unit"]);
}

#[test]
fn other_formats_get_one_line_about_the_file() {
    let one_line = |text: &str, words: &[&str]| {
        let error = refused(text, words);
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(error.starts_with("robot.urdf: no URDF: "), "{error}");
    };
    one_line("<sdf version=\"1.7\"><model name=\"w\"><link name=\"p\"/></model></sdf>", &["<sdf>", "SDF"]);
    one_line("<mujoco model=\"w\"><worldbody/></mujoco>", &["<mujoco>", "MJCF"]);
    one_line("<robot name=\"w\" xmlns:xacro=\"x\"><xacro:macro name=\"leg\"/></robot>", &["line 1", "xacro"]);
    one_line("<robot name=\"w\"/>", &["no links and joints"]);
    one_line("<html></html>", &["<html>", "<robot>"]);
    one_line("", &["no XML elements"]);
    one_line("name = \"a map\"\n[sole]\n", &["no XML"]);
    one_line("<robot><link name=\"a\"></robot>", &["line 1", "no well-formed XML"]);
    one_line("<robot name=\"w\"><link name=\"a\" name=\"b\"/></robot>", &["line 1", "link"]);
    let half = walker();
    for end in (10..half.len() - 10).step_by(97) {
        one_line(&half[..end], &["it breaks off at line"]);
    }
    let knee = half.find("<joint name=\"left_knee\"").unwrap();
    one_line(&half[..knee + 60], &["within <joint name=\"left_knee\">"]);
    one_line(&half[..knee + 3], &["within the tag <jo"]);
    let deep = "<robot name=\"r\">".to_owned() + &"<a>\n".repeat(100_000);
    one_line(&deep, &["line 32", "more than 32 elements within each other"]);
    let many = "<robot name=\"r\">".to_owned() + &"<link name=\"l\"/>".repeat(1001) + "</robot>";
    one_line(&many, &["more than 1000 links and joints"]);
    one_line("<!DOCTYPE r [<!ENTITY a \"aaaa\">]><robot name=\"&a;\"/>", &["line 1", "no <!DOCTYPE>"]);
    one_line(&" ".repeat((4 << 20) + 1), &["bytes, and may have 4194304"]);
}

#[test]
fn rates_and_torques_that_the_urdf_does_not_tell_are_assumed_and_told() {
    for (from, to, said) in [
        ("velocity=\"9\"", "velocity=\"0\"", "the URDF tells no rate (velocity 0); assumed"),
        ("velocity=\"9\"", "", "the URDF tells no rate (no velocity); assumed"),
        ("effort=\"30\"", "effort=\"0\"", "the URDF tells no torque (effort 0 or none); assumed 30.2"),
        ("effort=\"30\"", "", "the URDF tells no torque (effort 0 or none); assumed 30.2"),
        ("effort=\"30\"", "effort=\"1000\"", "torque 1000 N·m taken as given"),
        ("effort=\"30\"", "effort=\"1e9\"", "tells 1000000000 N·m, which is no limit worth the name; assumed 30.2"),
        ("velocity=\"9\"", "velocity=\"500\"", "the URDF tells 500 rad/s, which is no limit worth the name"),
    ] {
        let imported = taken(&walker().replace(from, to), "");
        told(&imported, said);
        assert!(!imported.text.contains("inf") && !imported.lines.iter().any(|line| line.contains("inf ")));
    }
}

#[test]
fn limits_matter_where_joints_are_used() {
    let knee = |limit: &str| in_joint(&walker(), "left_knee", "lower=\"-0.1\" upper=\"2.2\"", limit);
    refused(&knee("lower=\"2.2\" upper=\"-0.1\""), &["joint left_knee as left_knee", "lower must be less than upper"]);
    refused(&knee("lower=\"0\" upper=\"0\""), &["joint left_knee as left_knee", "must leave the joint a range"]);
    let none = in_joint(&walker(), "left_knee", "<limit", "<none");
    refused(&none, &["joint left_knee as left_knee", "must have <limit lower"]);
    let arm = in_joint(&walker(), "left_shoulder", "lower=\"-3\" upper=\"1\"", "lower=\"1\" upper=\"-3\"");
    told(&taken(&arm, ""), "left_shoulder: its limits contradict each other");
    let endless = walker().replace("_yaw\" type=\"revolute\"", "_yaw\" type=\"continuous\"");
    let file: toml::Table = taken(&endless, "").text.parse().unwrap();
    assert_eq!(file["joint"]["left_hip_yaw"]["range_deg"].to_string(), "[-180, 180]");
    // a range without zero holds an arm that does not swing at its nearer end
    let arms = ["right_shoulder", "left_shoulder"].iter().fold(walker(), |urdf, joint| {
        let urdf = in_joint(&urdf, joint, "0 1 0", "0 0 1");
        in_joint(&urdf, joint, "lower=\"-3\" upper=\"1\"", "lower=\"0.5\" upper=\"1\"")
    });
    let imported = taken(&arms, "");
    told(&imported, "right_shoulder at 28.65°");
    same_robot(&arms, &imported, 0.0, Allowed { place: 1e-9, arms: 1e-9, com: 1e-9 });
}

#[test]
fn odd_numbers_are_taken_and_told() {
    let slim = walker().replace("izz=\"0.006\"", "izz=\"0.05\"");
    told(&taken(&slim, ""), "were raised: thigh [6.000e-3, 6.000e-3, 5.000e-2] to [2.500e-2, 2.500e-2, 5.000e-2]");
    let points = walker().replace("<inertia ", "<none ");
    told(&taken(&points, ""), "were raised: pelvis [0.000e0, 0.000e0, 0.000e0] to");
    let half = walker().replace("lower=\"-0.1\" upper=\"2.2\"", "upper=\"2.2\"");
    told(&taken(&half, ""), "the URDF tells but one end of the range; the other one is 0: right_knee, left_knee");
    let late = walker().replace("lower=\"-0.1\" upper=\"2.2\"", "lower=\"0.1\" upper=\"2.2\"");
    told(&taken(&late, ""), "the range 5.7° to 126.1° leaves out the straight posture: right_knee, left_knee");
    let no_waist = walker().replace("\"waist_pitch\" type=\"revolute\"", "\"waist_pitch\" type=\"fixed\"");
    told(&taken(&no_waist, "[joint.waist_pitch]\neffort_n_m = 3\n"), "joint.waist_pitch of the map is not used");
}

#[test]
fn torn_texts_neither_panic_nor_fail_without_a_word() {
    let text = walker();
    let mut seed = 7_u64;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as usize % below
    };
    let pieces: Vec<&str> = text.split_inclusive(['\n', ' ', '"']).collect();
    for _ in 0..1500 {
        let mut torn = pieces.clone();
        for _ in 0..1 + random(3) {
            let (from, to) = (random(torn.len()), random(torn.len()));
            match random(3) {
                0 => torn.swap(from, to),
                1 => torn[from] = pieces[to],
                _ => {
                    let length = (from + 1 + random(20)).min(torn.len()) - from;
                    torn.drain(from..from + length);
                }
            }
        }
        if let Err(error) = import(NamedText { text: &torn.concat(), file: "robot.urdf" }, None) {
            assert!(error.0.starts_with("robot.urdf:") && error.0.len() > 20, "{error}");
        }
    }
}

#[test]
fn what_a_urdf_may_be_is_taken() {
    let plain = taken(&walker(), "").text;
    let crlf = format!("\u{feff}{}", walker().replace('\n', "\r\n"));
    assert_eq!(taken(&crlf, "").text, plain);
    let extras = walker().replace(
        "</robot>",
        "<transmission name=\"t\"><joint name=\"left_knee\"/><link name=\"torso\"/></transmission><gazebo \
         reference=\"torso\"><mass value=\"nan\"/></gazebo><material name=\"m\"/></robot>",
    );
    assert_eq!(taken(&extras, "").text, plain);
    let floating = walker().replace(
        "</robot>",
        "<link name=\"world\"/><joint name=\"free\" type=\"floating\"><parent link=\"world\"/><child \
         link=\"pelvis\"/></joint></robot>",
    );
    assert_eq!(taken(&floating, "").text, plain);
    let sliding = in_joint(&walker(), "left_shoulder", "revolute", "prismatic");
    told(&taken(&sliding, ""), "held: left_shoulder, a prismatic joint");
}

#[test]
fn robots_that_are_no_such_bipeds_are_refused_with_what_was_found() {
    let fixed =
        |joint: &str| walker().replace(&format!("{joint}\" type=\"revolute\""), &format!("{joint}\" type=\"fixed\""));
    refused(
        &fixed("_ankle_roll"),
        &["exactly six joints", "found 5 joints in each leg", "right_ankle_pitch (about y)"],
    );
    let mut toes = walker();
    for side in ["left", "right"] {
        let toe = format!(
            "<link name=\"{side}_toe\"/><joint name=\"{side}_toe\" type=\"revolute\"><parent \
             link=\"{side}_foot\"/><child link=\"{side}_toe\"/><axis xyz=\"0 1 0\"/><origin \
             xyz=\"0.1 0 0\"/></joint></robot>"
        );
        toes = toes.replace("</robot>", &toe);
    }
    refused(&toes, &["found 7 joints in each leg", "right_toe (about y)", "[[held]]"]);
    let held = "[[held]]\nurdf = \"left_toe\"\n[[held]]\nurdf = \"right_toe\"\n";
    same_robot(&toes, &taken(&toes, held), 0.0, Allowed { place: 1e-9, arms: 1e-9, com: 1e-9 });
    refused(&walker().replace("xyz=\"0 0 1\"", "xyz=\"1 0 0\""), &["the first three must be the hip's"]);
    let turned = |urdf: &str, joint: &str, pitch: f64| {
        let origin = format!("<origin rpy=\"0 {pitch} 0\"");
        let left = in_joint(urdf, &format!("left_{joint}"), "<origin", &origin);
        in_joint(&left, &format!("right_{joint}"), "<origin", &origin)
    };
    let bent = turned(&turned(&walker(), "knee", 1.2), "ankle_pitch", -1.2);
    refused(&bent, &["left leg: it is bent by 69°", "must stand straight"]);
    let no_sole = walker().replace("<box size=\"0.16 0.08 0.02\"/>", "<mesh filename=\"foot.stl\"/>");
    refused(&no_sole, &["link right_foot: the foot has no boxes", "[sole]", "ankle_height_m"]);
    refused(
        &in_joint(&walker(), "left_knee", "\"0 0 -0.2\"", "\"0 0 -0.23\""),
        &["robot.urdf:", "joints right_knee and left_knee as knee", "30.0 mm"],
    );
    let massless = in_link(&in_link(&walker(), "left_shank", "\"1\"", "\"0\""), "right_shank", "\"1\"", "\"0\"");
    refused(&massless, &["the left shank weighs nothing", "the right shank weighs nothing"]);
}

#[test]
fn keys_of_older_maps_are_told_what_to_do() {
    let map = "name = \"w\"\n[idealise]\naxes_moved_max_m = 0.1\n[joint.left_knee]\nstraight_deg = 3\n[[fixed]]\nurdf \
               = \"waist_yaw\"\n";
    let error = refused_with_map(
        &walker(),
        map,
        &["idealise", "must be removed", "joint.left_knee.straight_deg", "must be [[held]]"],
    );
    assert_eq!(error.lines().count(), 3, "{error}");
}

#[test]
fn map_may_say_otherwise() {
    let map = "name = \"w\"\n[sole]\nbehind_m = 0.04\nahead_m = 0.1\nwidth_m = 0.07\nankle_height_m = 0.045\n\
               [joint.left_knee]\nrange_deg = [-2, 100]\nrate_max_deg_per_s = 300\neffort_n_m = 20\n\
               [[held]]\nurdf = \"left_shoulder\"\nat_deg = -30\n[[held]]\nurdf = \"right_shoulder\"\nat_deg = -30\n";
    let imported = taken(&walker(), map);
    same_robot(&walker(), &imported, 0.0, Allowed { place: 1e-9, arms: 1e-9, com: 1e-9 });
    let file: toml::Table = imported.text.parse().unwrap();
    assert_eq!(file["joint"]["left_knee"]["range_deg"].to_string(), "[-2, 100]");
    assert_eq!(file["joint"]["right_knee"]["range_deg"].to_string(), "[-100, 2]");
    let right = Tree::of_mechanism(&file);
    assert!((right.joints.len(), file["held"].as_array().unwrap().len()) == (20, 3));
    // exchanged feet of a robot whose directions nothing else tells
    let map = "name = \"w\"\n[joint.right_knee]\nurdf = \"left_knee\"\n";
    told(&taken(&walker(), map), "against it: the knees bend backward");
}

/// What is imported can be loaded.
fn taken(urdf: &str, map: &str) -> Imported {
    let imported = read(urdf, map);
    Mechanism::from_toml(&imported.text, "mechanism.toml")
        .unwrap_or_else(|errors| panic!("{errors}\n{}", imported.text));
    imported
}

fn read(urdf: &str, map: &str) -> Imported {
    import(NamedText { text: urdf, file: "robot.urdf" }, Some(NamedText { text: map, file: "map.toml" }))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn told(imported: &Imported, words: &str) {
    assert!(imported.lines.iter().any(|line| line.contains(words)), "`{words}` is not in {:#?}", imported.lines);
}

fn refused(urdf: &str, words: &[&str]) -> String {
    refused_with_map(urdf, "", words)
}

fn refused_with_map(urdf: &str, map: &str, words: &[&str]) -> String {
    let map = NamedText { text: map, file: "map.toml" };
    let error = import(NamedText { text: urdf, file: "robot.urdf" }, Some(map)).expect_err("refused").to_string();
    assert!(!error.trim().is_empty());
    for word in words {
        assert!(error.contains(word), "`{word}` is not in: {error}");
    }
    error
}
