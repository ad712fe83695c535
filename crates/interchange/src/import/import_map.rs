//! The map: what a URDF lacks (name, soles, motors), and what of the import shall be otherwise than found.

use config::{ConfigErrors, Document, Table};
use model::{DcMotor, Sole};

use crate::import::NamedText;
use crate::import::role::JointRole;
use crate::import::urdf_robot::{JointKind, UrdfRobot};
use crate::import::urdf_tree::listed;

/// Content of a map file.
#[derive(Clone, Debug, Default)]
pub(super) struct ImportMap {
    /// Name of the robot, for users.
    pub name: Option<String>,
    /// The sole of each foot; `None` where it must be taken from the URDF.
    pub sole: Option<Sole>,
    /// The motors with their names.
    pub motors: Vec<(String, DcMotor)>,
    /// What is told of joints by their role.
    pub joints: Vec<(JointRole, MapJoint)>,
    /// Joints of the URDF that are held, by index, each with its angle (rad).
    pub held: Vec<(usize, f64)>,
}

/// What the map tells of a joint; angles have the URDF's zero and sign.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct MapJoint {
    /// Index among the URDF's joints, if another one than would be found.
    pub urdf: Option<usize>,
    /// Smallest and largest angle if other than in the URDF (rad).
    pub range: Option<[f64; 2]>,
    /// Largest rate if other than in the URDF (rad/s).
    pub rate_max: Option<f64>,
    /// Largest torque if other than in the URDF (N·m).
    pub effort: Option<f64>,
    /// Index among the map's motors.
    pub motor: Option<usize>,
}

impl ImportMap {
    /// What the map tells of a role.
    pub(super) fn joint(&self, role: JointRole) -> MapJoint {
        self.joints.iter().find(|(other, _)| *other == role).map_or(MapJoint::default(), |(_, joint)| *joint)
    }

    /// Reads a map for a URDF.
    ///
    /// # Errors
    /// Every mistake in the map: also joints that the URDF does not have, that cannot turn, or that are named twice,
    /// and the keys of older maps.
    pub(super) fn read(map: NamedText, robot: &UrdfRobot) -> Result<Self, ConfigErrors> {
        let document = Document::parse(map.text, map.file)?;
        let root = document.root();
        refuse_old_keys(&root);
        let name = root.has("name").then(|| root.text("name").to_string());
        let sole = root.has("sole").then(|| Sole::read(&root.table("sole")));
        let motors: Vec<(String, DcMotor)> =
            DcMotor::read_all(&root).into_iter().map(|(name, motor)| (name.to_string(), motor)).collect();
        let mut taken = Taken { robot, by: vec![None; robot.joints.len()] };
        let mut joints = Vec::new();
        if root.has("joint") {
            let table = root.table("joint");
            for role in JointRole::all().filter(|role| table.has(&role.name())) {
                joints.push((role, read_joint(&table.table(&role.name()), &motors, &mut taken)));
            }
        }
        let held = root.tables("held").iter().filter_map(|table| read_held(table, &mut taken)).collect();
        document.finish(Self { name, sole, motors, joints, held })
    }
}

/// Tells what became of keys that maps once had.
fn refuse_old_keys(root: &Table) {
    if root.has("idealise") {
        root.refuse("idealise", "must be removed: robots are taken as they are, and nothing is idealised any more");
    }
    if root.has("fixed") {
        root.refuse("fixed", "must be [[held]], with the same keys; joints at 0° need none: what has no role is held");
    }
}

fn read_joint(table: &Table, motors: &[(String, DcMotor)], taken: &mut Taken) -> MapJoint {
    if table.has("straight_deg") {
        let must = "must be removed: the URDF's zero is where the robot stands straight";
        table.refuse("straight_deg", must);
    }
    let urdf = table.has("urdf").then(|| taken.take(table, "urdf")).flatten();
    if let Some(index) = urdf {
        let joint = &taken.robot.joints[index];
        if !joint.turns() {
            let must = "must be a joint that turns (revolute or continuous)";
            table.refuse("urdf", &format!("{must}; this one is {}", joint.kind.name()));
        } else if let Some(mimic) = &joint.mimic {
            let must = "must be a joint that moves by itself";
            table.refuse("urdf", &format!("{must}; this one mimics joint {}", mimic.joint));
        }
    }
    let choices = motors.iter().enumerate().map(|(place, (name, _))| (name.as_str(), place));
    MapJoint {
        urdf,
        range: table.has("range_deg").then(|| table.angles("range_deg").increasing_between(-720.0, 720.0)),
        rate_max: table.has("rate_max_deg_per_s").then(|| table.angle("rate_max_deg_per_s").between(0.1, 1e4)),
        effort: table.has("effort_n_m").then(|| table.number("effort_n_m").between(1e-3, 1e5)),
        motor: table.has("motor").then(|| table.choice("motor", choices)).flatten(),
    }
}

fn read_held(table: &Table, taken: &mut Taken) -> Option<(usize, f64)> {
    let angle = if table.has("at_deg") { table.angle("at_deg").between(-360.0, 360.0) } else { 0.0 };
    Some((taken.take(table, "urdf")?, angle))
}

/// The joints of the URDF that the map has mentioned, and where.
struct Taken<'r> {
    robot: &'r UrdfRobot,
    by: Vec<Option<String>>,
}

impl Taken<'_> {
    /// Index of the joint that a key names.
    fn take(&mut self, table: &Table, key: &str) -> Option<usize> {
        let name = table.text(key);
        if name.is_empty() {
            return None;
        }
        let Some(index) = self.robot.joints.iter().position(|joint| joint.name == name) else {
            let names = self.robot.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
            let names = listed(names.map(|joint| joint.name.as_str()));
            table.refuse(key, &format!("must be a joint of the URDF, which has {names}"));
            return None;
        };
        if let Some(other) = &self.by[index] {
            table.refuse(key, &format!("must be a joint of its own: it is {other}'s already"));
            return None;
        }
        self.by[index] = Some(table.path().to_string());
        Some(index)
    }
}
