//! A small reader of URDFs and mechanism files, made for tests: both as joints with places and axes, put into any
//! posture, so that one can be compared with the other.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::path::PathBuf;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use quick_xml::Reader;
use quick_xml::events::Event;

mod held;
pub(crate) mod robots;
pub(crate) mod variants;
pub(crate) mod walker;
pub(crate) mod xml;

/// A joint of either format.
#[derive(Clone, Debug)]
pub(crate) struct TestJoint {
    pub(crate) name: String,
    pub(crate) kind: String,
    pub(crate) parent: String,
    pub(crate) child: String,
    pub(crate) origin: Isometry3<f64>,
    pub(crate) axis: Vector3<f64>,
}

/// Mass, centre of mass in the link's frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TestBody {
    pub(crate) mass: f64,
    pub(crate) com: Vector3<f64>,
    pub(crate) inertia: Matrix3<f64>,
}

/// A tree of links.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) joints: Vec<TestJoint>,
    pub(crate) bodies: BTreeMap<String, TestBody>,
    pub(crate) root: String,
}

impl Tree {
    /// Reads a URDF that is known to be well made.
    pub(crate) fn of_urdf(text: &str) -> Self {
        let mut tree = Tree::default();
        let mut reader = Reader::from_str(text);
        let mut path: Vec<String> = Vec::new();
        let (mut link, mut frame) = (String::new(), Isometry3::identity());
        loop {
            let event = reader.read_event().expect("XML");
            let (start, is_open) = match &event {
                Event::Eof => break,
                Event::Start(start) => (start, true),
                Event::Empty(start) => (start, false),
                Event::End(_) => {
                    path.pop();
                    continue;
                }
                _ => continue,
            };
            let name = String::from_utf8(start.name().as_ref().to_vec()).unwrap();
            let get = |key: &str| {
                start.try_get_attribute(key).unwrap().map(|found| found.unescape_value().unwrap().into_owned())
            };
            let numbers = |key: &str| {
                get(key).map(|text| {
                    let all: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
                    Vector3::new(all[0], all[1], all[2])
                })
            };
            let number = |key: &str| get(key).map_or(0.0, |text| text.trim().parse().unwrap());
            let pose = || {
                let (xyz, rpy) = (numbers("xyz").unwrap_or_default(), numbers("rpy").unwrap_or_default());
                Isometry3::from_parts(Translation3::from(xyz), UnitQuaternion::from_euler_angles(rpy.x, rpy.y, rpy.z))
            };
            let around: Vec<&str> = path.iter().map(String::as_str).collect();
            match (around.as_slice(), name.as_str()) {
                (["robot"], "link") => {
                    link = get("name").unwrap();
                    frame = Isometry3::identity();
                    tree.bodies.insert(link.clone(), TestBody::default());
                }
                (["robot", "link", "inertial"], "origin") => frame = pose(),
                (["robot", "link", "inertial"], "mass") => {
                    tree.bodies.get_mut(&link).unwrap().mass = number("value");
                }
                (["robot", "link", "inertial"], "inertia") => {
                    let [xx, yy, zz, xy, xz, yz] = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"].map(number);
                    let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
                    tree.bodies.get_mut(&link).unwrap().inertia = inertia;
                }
                (["robot"], "joint") => tree.joints.push(TestJoint {
                    name: get("name").unwrap(),
                    kind: get("type").unwrap(),
                    parent: String::new(),
                    child: String::new(),
                    origin: Isometry3::identity(),
                    axis: Vector3::x(),
                }),
                (["robot", "joint"], "parent") => tree.joints.last_mut().unwrap().parent = get("link").unwrap(),
                (["robot", "joint"], "child") => tree.joints.last_mut().unwrap().child = get("link").unwrap(),
                (["robot", "joint"], "origin") => tree.joints.last_mut().unwrap().origin = pose(),
                (["robot", "joint"], "axis") => tree.joints.last_mut().unwrap().axis = numbers("xyz").unwrap(),
                _ => {}
            }
            if name == "inertia" || name == "mass" || name == "origin" {
                if around == ["robot", "link", "inertial"] {
                    tree.bodies.get_mut(&link).unwrap().com = frame.translation.vector;
                }
                if name == "inertia" && around == ["robot", "link", "inertial"] {
                    let turn = frame.rotation.to_rotation_matrix();
                    let body = tree.bodies.get_mut(&link).unwrap();
                    body.inertia = turn * body.inertia * turn.transpose();
                }
            }
            if is_open {
                path.push(name);
            }
        }
        let is_child = |name: &String| tree.joints.iter().any(|joint| joint.child == *name);
        tree.root = tree.bodies.keys().find(|name| !is_child(name)).unwrap().clone();
        tree
    }

    /// Reads the joints of a mechanism file: links are called as the joints that carry them.
    pub(crate) fn of_mechanism(file: &toml::Table) -> Self {
        let mut tree = Tree { root: "ground".into(), ..Tree::default() };
        for (name, joint) in file["joint"].as_table().unwrap() {
            let numbers = |key: &str| -> Vec<f64> { joint[key].as_array().unwrap().iter().map(as_number).collect() };
            let vector = |key: &str| Vector3::from_iterator(numbers(key).into_iter().take(3));
            tree.joints.push(TestJoint {
                name: name.clone(),
                kind: "revolute".into(),
                parent: joint["parent"].as_str().unwrap().into(),
                child: name.clone(),
                origin: Translation3::from(vector("origin_m")).into(),
                axis: vector("axis"),
            });
            let mut body = TestBody::default();
            if joint.get("mass_kg").is_some() {
                body.mass = as_number(&joint["mass_kg"]);
                body.com = vector("com_m");
                let all = numbers("inertia_kg_m2");
                let [xy, xz, yz] = if all.len() == 6 { [all[3], all[4], all[5]] } else { [0.0; 3] };
                body.inertia = Matrix3::new(all[0], xy, xz, xy, all[1], yz, xz, yz, all[2]);
            }
            tree.bodies.insert(name.clone(), body);
        }
        tree
    }

    /// Poses of all links with joints at some angles, those not named at zero.
    pub(crate) fn poses(&self, angles: &BTreeMap<String, f64>) -> BTreeMap<String, Isometry3<f64>> {
        let mut poses = BTreeMap::from([(self.root.clone(), Isometry3::identity())]);
        while poses.len() < self.bodies.len().max(self.joints.len() + 1) {
            for joint in &self.joints {
                let Some(parent) = poses.get(&joint.parent).copied() else { continue };
                let angle = angles.get(&joint.name).copied().unwrap_or(0.0);
                let axis = Unit::new_normalize(joint.axis);
                let turned = match joint.kind.as_str() {
                    "revolute" | "continuous" => UnitQuaternion::from_axis_angle(&axis, angle),
                    _ => UnitQuaternion::identity(),
                };
                poses.insert(joint.child.clone(), parent * joint.origin * turned);
            }
        }
        poses
    }

    pub(crate) fn mass(&self) -> f64 {
        self.bodies.values().map(|body| body.mass).sum()
    }

    /// Centre of mass with joints at some angles.
    pub(crate) fn com(&self, poses: &BTreeMap<String, Isometry3<f64>>) -> Vector3<f64> {
        let weighted = self.bodies.iter().map(|(name, body)| {
            body.mass * poses.get(name).map_or(Vector3::zeros(), |pose| (pose * Point3::from(body.com)).coords)
        });
        weighted.sum::<Vector3<f64>>() / self.mass()
    }

    pub(crate) fn joint(&self, name: &str) -> &TestJoint {
        self.joints.iter().find(|joint| joint.name == name).unwrap_or_else(|| panic!("joint {name}"))
    }
}

pub(crate) fn as_number(value: &toml::Value) -> f64 {
    value.as_float().or(value.as_integer().map(|number| number as f64)).expect("a number")
}

/// The folder of the public robots that some tests read, if it is there.
pub(crate) fn shared_robots() -> Option<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/robots");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("not tested: there is no folder {}", folder.display());
    None
}

/// Names of the robots in that folder.
pub(crate) const ROBOTS: [&str; 9] = ["g1", "h1_2", "talos", "op3", "limx", "t1", "jvrc1", "gr1t1", "qinglong"];
