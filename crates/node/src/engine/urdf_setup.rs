//! How an external engine makes an imported robot of its URDF: which joints are driven, which are held, where the soles
//! are. `tools/mujoco_plant/README.md` lists the keys.

use model::{Joint, Mechanism, Servo, Side, UrdfJoint, UrdfSource};
use nalgebra::Vector3;
use plant::PlantParameters;
use serde::Serialize;

/// What an engine must know beside the URDF, in SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct UrdfSetup {
    joints: Vec<DrivenJoint>,
    held: Vec<HeldAngle>,
    servo: HeldServos,
    feet: BySide<Foot>,
    soles: BySide<[f64; 3]>,
    sole: SoleRectangle,
    trunk_link: String,
    /// Unit quaternion w, x, y, z.
    to_ahead: [f64; 4],
    friction: f64,
    gravity: [f64; 3],
    payload: PayloadInRoot,
    mass_error: MassError,
}

/// A joint that the mechanism has, too.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct DrivenJoint {
    role: &'static str,
    urdf: String,
    sign: f64,
    effort: f64,
    armature: f64,
    /// Range in the URDF's sign; `None` for none.
    range: Option<[f64; 2]>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct HeldAngle {
    urdf: String,
    at: f64,
}

/// Servos of the held joints between feet and trunk, and of the others.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct HeldServos {
    legs_and_waist: HeldServo,
    arms: HeldServo,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct HeldServo {
    stiffness: f64,
    damping: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct BySide<T> {
    right: T,
    left: T,
}

/// A foot, by the last joint of its leg.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Foot {
    joint: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct SoleRectangle {
    behind: f64,
    ahead: f64,
    inside: f64,
    outside: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct PayloadInRoot {
    mass: f64,
    at: [f64; 3],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct MassError {
    share: f64,
    seed: u64,
}

impl UrdfSetup {
    /// The setup for a robot that the plant's parameters and seed define.
    pub(super) fn new(mechanism: &Mechanism, source: &UrdfSource, parameters: &PlantParameters, seed: u64) -> Self {
        let (turn, [right, left]) = (source.root_to_stand, source.soles_in_root);
        let sole = mechanism.sole;
        let payload = parameters.payload;
        Self {
            joints: Joint::ALL.into_iter().filter_map(|joint| driven(mechanism, source, joint)).collect(),
            held: source.held.iter().map(|held| HeldAngle { urdf: held.name.clone(), at: held.angle }).collect(),
            servo: HeldServos {
                legs_and_waist: servo(parameters.servo.of(&mechanism.servos.legs_and_waist)),
                arms: servo(parameters.servo.of(&mechanism.servos.arms)),
            },
            // The joints next to the feet.
            feet: BySide {
                right: Foot { joint: name_of(source, mechanism.leg(Side::Right)[0]) },
                left: Foot { joint: name_of(source, mechanism.foot(Side::Left)) },
            },
            soles: BySide { right: right.into(), left: left.into() },
            sole: SoleRectangle { behind: sole.behind, ahead: sole.ahead, inside: sole.inside, outside: sole.outside },
            trunk_link: source.trunk_link.clone(),
            to_ahead: [turn.w, turn.i, turn.j, turn.k],
            friction: parameters.contact.friction,
            gravity: parameters.slope.gravity().into(),
            payload: PayloadInRoot { mass: payload.mass, at: in_root(mechanism, source, payload.at).into() },
            mass_error: MassError { share: parameters.mass_error, seed },
        }
    }
}

/// A joint as an engine drives it; `None` if the robot does not have it.
fn driven(mechanism: &Mechanism, source: &UrdfSource, joint: Joint) -> Option<DrivenJoint> {
    let (link, UrdfJoint { name, sign }) = (&mechanism.links[joint], source.joints[joint].as_ref()?);
    let motor = link.motor?;
    let range = link.limits.map(|limits| {
        let [min, max] = [limits.angle_min, limits.angle_max].map(|angle| sign * angle);
        [min.min(max), min.max(max)]
    });
    let (effort, armature) = (motor.torque_max(), motor.reflected_inertia());
    Some(DrivenJoint { role: joint.name(), urdf: name.clone(), sign: *sign, effort, armature, range })
}

fn servo(servo: Servo) -> HeldServo {
    HeldServo { stiffness: servo.stiffness, damping: servo.damping }
}

/// The URDF's name of a joint; empty if the source does not tell it, which engines refuse.
fn name_of(source: &UrdfSource, joint: Joint) -> String {
    source.joints[joint].as_ref().map(|joint| joint.name.clone()).unwrap_or_default()
}

/// A place in the trunk's frame in coordinates of the URDF's root link, of the robot standing straight (m): all frames
/// of the mechanism are parallel then.
fn in_root(mechanism: &Mechanism, source: &UrdfSource, in_trunk: Vector3<f64>) -> Vector3<f64> {
    let mut above_sole = in_trunk;
    let mut link = Some(Mechanism::TRUNK);
    while let Some(joint) = link {
        above_sole += mechanism.links[joint].origin;
        link = mechanism.links[joint].parent;
    }
    source.soles_in_root[Side::Right.index()] + source.root_to_stand.inverse() * above_sole
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::PerJoint;
    use nalgebra::UnitQuaternion;

    use super::*;

    /// The committed robot, as if a URDF rooted at its pelvis faced y and turned every joint the other way.
    fn imported() -> (Mechanism, UrdfSource) {
        let file = |name| format!("{}/../../config/{name}", env!("CARGO_MANIFEST_DIR"));
        let mechanism = Mechanism::load(file("mechanism.toml")).expect("the committed file");
        let joints = PerJoint::from_fn(|joint| {
            mechanism.has(joint).then(|| UrdfJoint { name: format!("{}_joint", joint.name()), sign: -1.0 })
        });
        let source = UrdfSource {
            file: "robot.urdf".to_owned(),
            trunk_link: "torso".to_owned(),
            root_to_stand: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -std::f64::consts::FRAC_PI_2),
            soles_in_root: [Vector3::new(0.1, 0.0, -0.9), Vector3::new(-0.1, 0.0, -0.9)],
            joints,
            held: vec![model::HeldJoint { name: "neck".to_owned(), angle: 0.2, link: None }],
        };
        (mechanism, source)
    }

    fn parameters() -> PlantParameters {
        let file = format!("{}/../../config/plant.toml", env!("CARGO_MANIFEST_DIR"));
        PlantParameters::load(file).expect("the committed file")
    }

    #[test]
    fn joints_that_turn_the_other_way_have_their_range_the_other_way() {
        let (mechanism, source) = imported();
        let setup = UrdfSetup::new(&mechanism, &source, &parameters(), 0);
        assert_eq!(setup.joints.len(), 18);
        for joint in &setup.joints {
            let limits = Joint::from_name(joint.role).and_then(|role| mechanism.links[role].limits).expect("limits");
            assert_eq!(joint.range, Some([-limits.angle_max, -limits.angle_min]), "{}", joint.role);
        }
    }

    #[test]
    fn feet_hang_on_the_ankles() {
        let (mechanism, source) = imported();
        let setup = UrdfSetup::new(&mechanism, &source, &parameters(), 0);
        let joints = [&setup.feet.right.joint, &setup.feet.left.joint];
        assert_eq!(joints, ["right_ankle_roll_joint", "left_ankle_roll_joint"]);
    }

    /// A payload half a metre ahead of the waist joint is half a metre along the root's y axis.
    #[test]
    fn payload_is_seen_from_the_root() {
        let (mechanism, source) = imported();
        let waist = in_root(&mechanism, &source, Vector3::zeros());
        let ahead = in_root(&mechanism, &source, Vector3::new(0.5, 0.0, 0.0));
        assert!((ahead - waist - Vector3::new(0.0, 0.5, 0.0)).norm() < 1e-12, "{waist} {ahead}");
        assert!(waist.x.abs() < 0.02 && waist.z > -0.1, "between the legs and above the hips: {waist}");
    }
}
