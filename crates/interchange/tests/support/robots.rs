//! Compares an imported robot with its URDF.

use std::collections::BTreeMap;

use interchange::import::Imported;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{Tree, as_number};

/// How far an import may differ from its URDF.
#[derive(Clone, Copy)]
pub(crate) struct Allowed {
    /// Places of joints (m), and those of the arms.
    pub(crate) place: f64,
    pub(crate) arms: f64,
    /// Centre of mass (m).
    pub(crate) com: f64,
}

/// Mass, places of all joints with a role, and centre of mass of mechanism and URDF are the same at random angles, held
/// joints a little off theirs; the robot's x axis is `yaw` to the left of its root's.
pub(crate) fn same_robot(urdf: &str, imported: &Imported, yaw: f64, allowed: Allowed) {
    let file: toml::Table = imported.text.parse().unwrap_or_else(|error| panic!("{error}"));
    let (urdf, mechanism) = (Tree::of_urdf(urdf), Tree::of_mechanism_with_held(&file));
    assert!((urdf.mass() - mechanism.mass()).abs() < 1e-9, "{} and {} kg", urdf.mass(), mechanism.mass());

    let held: BTreeMap<String, f64> = file.get("held").map_or(BTreeMap::new(), |held| {
        let held = held.as_array().unwrap().iter();
        held.map(|held| (held["urdf"].as_str().unwrap().to_string(), as_number(&held["at_deg"]).to_radians())).collect()
    });
    let roles: Vec<(String, String, f64)> = file["joint"]
        .as_table()
        .unwrap()
        .iter()
        .filter_map(|(role, joint)| {
            Some((role.clone(), joint.get("urdf")?.as_str()?.to_string(), as_number(&joint["urdf_sign"])))
        })
        .collect();
    assert_eq!(roles.len(), imported.roles.len());

    // where the zero postures lie in each other
    let zero = (urdf.poses(&held), mechanism.poses(&BTreeMap::new()));
    let urdf_place = |poses: &BTreeMap<String, Isometry3<f64>>, name: &str| {
        let joint = urdf.joint(name);
        (poses[&joint.parent] * joint.origin).translation.vector
    };
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, -yaw);
    let pairs: Vec<(Vector3<f64>, Vector3<f64>)> = roles
        .iter()
        .filter(|(role, ..)| !role.starts_with("waist") && !is_in_arm(role))
        .map(|(role, name, _)| (zero.1[role].translation.vector, turn * urdf_place(&zero.0, name)))
        .collect();
    let shift = pairs.iter().map(|(ours, theirs)| ours - theirs).sum::<Vector3<f64>>() / pairs.len() as f64;
    let root_to_ours = Isometry3::from_parts(Translation3::from(shift), turn);
    let foot = foot_link(&urdf, &roles);

    let mut seed = 12345_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let exchanged = imported.lines.iter().any(|line| line.starts_with("the waist rolls below"));
    for _ in 0..20 {
        let (mut ours, mut theirs) = (BTreeMap::new(), held.clone());
        // one of the waist's joints at a time: their order may have been exchanged
        let still = if random() < 0.0 { "waist_roll" } else { "waist_pitch" };
        for (role, name, sign) in roles.iter().filter(|(role, ..)| role != still) {
            let angle = random();
            ours.insert(role.clone(), angle);
            theirs.insert(name.clone(), sign * angle);
        }
        for (name, angle) in &held {
            let (part, deflection) = (format!("held {name}"), 0.2 * random());
            if mechanism.joints.iter().any(|joint| joint.name == part) {
                ours.insert(part, deflection);
                theirs.insert(name.clone(), angle + deflection);
            }
        }
        let (ours, theirs) = (mechanism.poses(&ours), urdf.poses(&theirs));
        // the right foot stays where it was
        let to_ours = root_to_ours * zero.0[&foot] * theirs[&foot].inverse();
        for (role, name, _) in roles.iter().filter(|(role, ..)| !(exchanged && role.starts_with("waist"))) {
            let theirs = (to_ours * Translation3::from(urdf_place(&theirs, name))).translation.vector;
            let ours = ours[role].translation.vector;
            let allowed = if is_in_arm(role) { allowed.arms } else { allowed.place };
            assert!((ours - theirs).norm() < allowed, "{role}: {ours:?} and {theirs:?}");
        }
        let theirs = to_ours * nalgebra::Point3::from(urdf.com(&theirs));
        let ours = mechanism.com(&ours);
        assert!((ours - theirs.coords).norm() < allowed.com, "centres of mass: {ours:?} and {theirs:?}");
    }
}

fn is_in_arm(role: &str) -> bool {
    role.ends_with("shoulder") || role.ends_with("elbow")
}

/// The link that is the right foot: at the first joint of the right ankle, the one that is not on the way to the next.
fn foot_link(urdf: &Tree, roles: &[(String, String, f64)]) -> String {
    let joint = |wanted: &str| urdf.joint(&roles.iter().find(|(role, ..)| role == wanted).unwrap().1);
    let (pitch, roll, knee) = (joint("right_ankle_pitch"), joint("right_ankle_roll"), joint("right_knee"));
    let near = |link: &str, other: &str| reaches(urdf, link, other, &[&pitch.name, &roll.name, &knee.name]);
    let knee_side = |link: &str| near(link, &knee.child) || near(link, &knee.parent);
    let (first, second) =
        if knee_side(&pitch.parent) || knee_side(&pitch.child) { (roll, pitch) } else { (pitch, roll) };
    let middle = |link: &str| near(link, &second.child) || near(link, &second.parent);
    if middle(&first.parent) { first.child.clone() } else { first.parent.clone() }
}

/// Whether two links hang together without some joints.
fn reaches(urdf: &Tree, from: &str, to: &str, without: &[&String]) -> bool {
    let mut found = vec![from.to_string()];
    let mut more = true;
    while more {
        more = false;
        for joint in urdf.joints.iter().filter(|joint| !without.contains(&&joint.name)) {
            let (parent, child) = (found.contains(&joint.parent), found.contains(&joint.child));
            if parent != child {
                found.push(if parent { joint.child.clone() } else { joint.parent.clone() });
                more = true;
            }
        }
    }
    found.iter().any(|link| link == to)
}

/// The mechanism's text is its own mirror image: the chain of joints from foot to foot reads the same from both ends.
pub(crate) fn is_symmetric(imported: &Imported) {
    let file: toml::Table = imported.text.parse().unwrap();
    let mechanism = Tree::of_mechanism(&file);
    let zero = mechanism.poses(&BTreeMap::new());
    let across = |vector: Vector3<f64>| Vector3::new(vector.x, -vector.y, vector.z);
    let place = |name: &str| zero[name].translation.vector;
    let middle = (place("right_knee").y + place("left_knee").y) / 2.0;
    let has = |role: &&str| file["joint"][format!("right_{role}")].get("urdf").is_some();
    let roles = ["hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll", "shoulder", "elbow"];
    for role in roles.into_iter().filter(has) {
        let (right, left) = (format!("right_{role}"), format!("left_{role}"));
        let image = across(place(&left)) + Vector3::y() * 2.0 * middle;
        assert!((place(&right) - image).norm() < 1e-11, "{role}: {} and {image}", place(&right));
        let [right_axis, left_axis] = [&right, &left].map(|name| mechanism.joint(name).axis);
        let image = Vector3::new(-left_axis.x, left_axis.y, -left_axis.z);
        assert!(right_axis.cross(&image).norm() < 1e-9, "{role}");
        assert!(mechanism.joint(&right).axis[main_axis(role)] > 0.0 && left_axis[main_axis(role)] > 0.0);
        let table = |name: &str| file["joint"][name].as_table().unwrap();
        let range = |name: &str| {
            let ends = table(name)["range_deg"].as_array().unwrap();
            [as_number(&ends[0]), as_number(&ends[1])]
        };
        let [low, high] = range(&left);
        let image = if main_axis(role) == 1 && !is_in_arm(role) { [-high, -low] } else { [low, high] };
        assert_eq!(range(&right), image, "{role}");
        assert_eq!(table(&right)["rate_max_deg_per_s"], table(&left)["rate_max_deg_per_s"]);
    }
}

fn main_axis(role: &str) -> usize {
    match role {
        "hip_yaw" => 2,
        "hip_roll" | "ankle_roll" => 0,
        _ => 1,
    }
}

/// Two mechanism files describe the same robot to 1e-9, whatever its joints are called in the URDF.
pub(crate) fn same_numbers(one: &Imported, other: &Imported) {
    let [one, other] = [one, other].map(|imported| imported.text.parse::<toml::Table>().unwrap());
    assert_eq!(one["joint"].as_table().unwrap().len(), 20);
    for (name, joint) in one["joint"].as_table().unwrap() {
        let same = other["joint"][name].as_table().unwrap();
        assert_eq!(joint.as_table().unwrap().len(), same.len(), "{name}");
        for (key, value) in
            joint.as_table().unwrap().iter().filter(|(key, _)| !["urdf", "parent_held"].contains(&key.as_str()))
        {
            assert!(near(value, &same[key]), "{name}.{key}: {value} and {}", same[key]);
        }
    }
    assert!(near(&one["sole"], &other["sole"]));
}

fn near(one: &toml::Value, other: &toml::Value) -> bool {
    match (one, other) {
        (toml::Value::Array(one), toml::Value::Array(other)) => {
            // products of inertia that are but rounding are left out
            let number = |values: &[toml::Value], place: usize| values.get(place).map_or(0.0, as_number);
            (0..6).all(|place| (number(one, place) - number(other, place)).abs() < 1e-9)
        }
        (toml::Value::Table(one), toml::Value::Table(other)) => {
            one.iter().all(|(key, value)| other.get(key).is_some_and(|other| near(value, other)))
        }
        (toml::Value::String(one), toml::Value::String(other)) => one == other,
        _ => (as_number(one) - as_number(other)).abs() < 1e-9,
    }
}
