//! The joint map: which joint of a URDF is which joint of a mechanism, and what a URDF lacks (soles, motors).

use config::{ConfigErrors, Document, Table};
use model::{Motor, PerJoint, Sole};
use urdf_rs::{JointType, Robot};

use crate::import::NamedText;

/// Content of a map file.
#[derive(Clone, Debug)]
pub struct JointMap {
    /// Name of the robot, for users.
    pub name: String,
    /// The sole of each foot.
    pub sole: Sole,
    /// The motors with their names.
    pub motors: Vec<(String, Motor)>,
    /// The URDF's joint for each powered joint of the mechanism; `None` for the two unpowered ones.
    pub joints: PerJoint<Option<Mapped>>,
    /// Joints of the URDF that are fixed, by index, each with its angle (rad).
    pub fixed: Vec<(usize, f64)>,
    /// How far the robot may be idealised.
    pub idealise: Idealise,
}

/// A joint of the mechanism in the URDF; angles have the URDF's zero and sign.
#[derive(Clone, Copy, Debug)]
pub struct Mapped {
    /// Index among the URDF's joints.
    pub index: usize,
    /// Index among the map's motors.
    pub motor: usize,
    /// Angle of the straight posture (rad).
    pub straight: f64,
    /// Smallest and largest angle if other than in the URDF (rad).
    pub range: Option<[f64; 2]>,
    /// Largest rate if other than in the URDF (rad/s).
    pub rate_max: Option<f64>,
}

/// How far an import may change the robot so that it fits a mechanism file; all zero allows no change.
#[derive(Clone, Copy, Debug, Default)]
pub struct Idealise {
    /// How far a leg's axis may be moved so that hip and ankle turn about one point each and the leg is straight (m).
    pub axes_moved_max: f64,
    /// Greatest product of inertia that may be left out, as a share of the link's greatest moment.
    pub products_of_inertia_max: f64,
    /// How far a joint or a centre of mass may be from its mirror image (m).
    pub asymmetry_max: f64,
    /// By which share masses and moments may differ from the other side's.
    pub asymmetry_share_max: f64,
}

impl JointMap {
    /// Reads a map for a URDF.
    ///
    /// # Errors
    /// Every mistake in the map: also joints that the URDF does not have, that cannot turn, or that are mapped twice,
    /// and movable joints of the URDF that the map does not mention.
    pub fn read(map: NamedText, robot: &Robot) -> Result<Self, ConfigErrors> {
        let document = Document::parse(map.text, map.file)?;
        let root = document.root();
        let name = root.text("name").to_string();
        let sole = Sole::read(&root.table("sole"));
        let motors: Vec<_> =
            Motor::read_all(&root).into_iter().map(|(name, motor)| (name.to_string(), motor)).collect();
        let mut taken = Taken { robot, by: vec![None; robot.joints.len()] };
        let joint_table = root.table("joint");
        let joints = PerJoint::from_fn(|joint| {
            let table = joint.is_powered().then(|| joint_table.table(joint.name()))?;
            mapped(&table, &motors, &mut taken)
        });
        let fixed = root.tables("fixed").iter().filter_map(|table| fixed(table, &mut taken)).collect();
        let idealise = if root.has("idealise") { idealise(&root.table("idealise")) } else { Idealise::default() };

        let free = robot.joints.iter().zip(&taken.by);
        let free = free.filter(|(joint, by)| by.is_none() && joint.joint_type != JointType::Fixed);
        let free: Vec<String> = free.map(|(joint, _)| format!("\"{}\"", joint.name)).collect();
        if !free.is_empty() {
            let must = format!("every unmapped movable joint needs a `[[fixed]]` table: {}", free.join(", "));
            root.refuse("fixed", &must);
        }
        document.finish(Self { name, sole, motors, joints, fixed, idealise })
    }
}

/// The joints of the URDF that the map has mentioned, and where.
struct Taken<'r> {
    robot: &'r Robot,
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
            let names = self.robot.joints.iter().filter(|joint| joint.joint_type != JointType::Fixed);
            let names: Vec<&str> = names.map(|joint| joint.name.as_str()).collect();
            table.refuse(key, &format!("must be a joint of the URDF, which has {}", names.join(", ")));
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

fn mapped(table: &Table, motors: &[(String, Motor)], taken: &mut Taken) -> Option<Mapped> {
    let index = taken.take(table, "urdf");
    if let Some(index) = index {
        let kind = &taken.robot.joints[index].joint_type;
        if !matches!(kind, JointType::Revolute | JointType::Continuous) {
            table.refuse("urdf", &format!("must be a joint that turns (revolute or continuous); this one is {kind:?}"));
        }
    }
    let choices = motors.iter().enumerate().map(|(place, (name, _))| (name.as_str(), place));
    let motor = table.choice("motor", choices);
    Some(Mapped {
        straight: if table.has("straight_deg") { table.angle("straight_deg").between(-360.0, 360.0) } else { 0.0 },
        range: table.has("range_deg").then(|| table.angles("range_deg").increasing_between(-720.0, 720.0)),
        rate_max: table.has("rate_max_deg_per_s").then(|| table.angle("rate_max_deg_per_s").between(0.1, 1e4)),
        index: index?,
        motor: motor?,
    })
}

fn fixed(table: &Table, taken: &mut Taken) -> Option<(usize, f64)> {
    let angle = if table.has("at_deg") { table.angle("at_deg").between(-360.0, 360.0) } else { 0.0 };
    Some((taken.take(table, "urdf")?, angle))
}

fn idealise(table: &Table) -> Idealise {
    let share = |key| table.number(key).between(0.0, 1.0);
    Idealise {
        axes_moved_max: table.number("axes_moved_max_m").between(0.0, 1.0),
        products_of_inertia_max: share("products_of_inertia_max_share"),
        asymmetry_max: table.number("asymmetry_max_m").between(0.0, 1.0),
        asymmetry_share_max: share("asymmetry_max_share"),
    }
}
