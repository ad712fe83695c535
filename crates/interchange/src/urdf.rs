//! The mechanism as URDF, for viewers and other simulators.
//!
//! A floating tree rooted at the right foot link `right_foot`, whose frame lies on the sole: joints 1 and 2, the
//! contact of foot and ground, are left out; joints 3 to 20 are revolute and keep their names. Links between joints
//! that meet in one point have no mass: an element of MuJoCo's own, which others ignore, makes it add the mass that it
//! needs there.
//!
//! Pinocchio drops the root link's mass when the base is fixed: load it there with a free-flyer.

use model::{Body, Joint, JointLimits, Mechanism, Motor, Side};
use nalgebra::Vector3;
use urdf_rs::{
    Axis, Collision, Geometry, Inertia, Inertial, JointLimit, JointType, Link, LinkName, Mass, Pose, Robot, UrdfError,
    Vec3, Visual,
};

/// Writes the mechanism as the text of a URDF file.
///
/// # Errors
/// The mechanism cannot be written as XML, which no loaded mechanism should cause.
pub fn urdf_text(mechanism: &Mechanism) -> Result<String, UrdfError> {
    let robot = urdf_rs::write_to_string(&urdf(mechanism))?;
    // The first tag is the robot's.
    let robot = robot.replacen('>', &format!(">{FOR_MUJOCO}"), 1);
    Ok(format!("<?xml version=\"1.0\"?>\n{robot}\n"))
}

/// MuJoCo's element for the mass of massless links.
const FOR_MUJOCO: &str = "\n  <mujoco><compiler boundmass=\"1e-6\" boundinertia=\"1e-9\"/></mujoco>";

/// Converts the mechanism to a URDF robot: a floating tree rooted at the right foot.
pub fn urdf(mechanism: &Mechanism) -> Robot {
    let carried = Joint::ALL.into_iter().filter(|joint| *joint >= root());
    let links = carried.map(|joint| link(mechanism, joint)).collect();
    let powered = Joint::ALL.into_iter().filter(|joint| joint.is_powered());
    let joints = powered.map(|each| joint(mechanism, each)).collect();
    Robot { name: mechanism.name.clone(), version: None, links, joints, materials: Vec::new() }
}

/// The joint whose link is the root.
const fn root() -> Joint {
    Mechanism::RIGHT_FOOT
}

/// Name of the link that a joint carries.
fn link_name(joint: Joint) -> String {
    joint.link_name().map_or_else(|| format!("{}_link", joint.name()), str::to_owned)
}

fn joint(mechanism: &Mechanism, joint: Joint) -> urdf_rs::Joint {
    let link = &mechanism.links[joint];
    urdf_rs::Joint {
        name: joint.name().to_string(),
        joint_type: JointType::Revolute,
        origin: at(link.origin),
        parent: LinkName { link: link_name(link.parent.unwrap_or(root())) },
        child: LinkName { link: link_name(joint) },
        axis: Axis { xyz: vec3(*link.axis) },
        limit: limit(link.limits, link.motor),
        calibration: None,
        dynamics: None,
        mimic: None,
        safety_controller: None,
    }
}

/// Range and rate of a joint; as effort the torque of its motor at standstill and full voltage.
fn limit(limits: Option<JointLimits>, motor: Option<Motor>) -> JointLimit {
    let (lower, upper, velocity) = limits.map_or((0.0, 0.0, 0.0), |l| (l.angle_min, l.angle_max, l.rate_max));
    let effort = motor.map_or(0.0, |motor| motor.torque_max());
    JointLimit { lower, upper, effort, velocity, ..Default::default() }
}

fn link(mechanism: &Mechanism, joint: Joint) -> Link {
    let body = mechanism.links[joint].body;
    let foot = Side::BOTH.into_iter().find(|side| mechanism.foot(*side) == joint);
    let (visual, collision) = match foot {
        // Only the soles collide: thighs and pelvis overlap at the hips, and a simulator would push them apart.
        Some(side) => {
            let (place, geometry) = foot_box(mechanism, side);
            (Some((place, geometry.clone())), Some((place, geometry)))
        }
        None if body.mass > 0.0 => (Some((body.com, equivalent_box(&body))), None),
        None => (None, None),
    };
    let visual = visual.map(|(place, geometry)| Visual { origin: at(place), geometry, ..Default::default() });
    let collision = collision.map(|(place, geometry)| Collision { origin: at(place), geometry, ..Default::default() });
    Link {
        name: link_name(joint),
        inertial: inertial(&body),
        visual: visual.into_iter().collect(),
        collision: collision.into_iter().collect(),
    }
}

fn inertial(body: &Body) -> Inertial {
    let inertia = body.inertia_matrix();
    let [ixx, iyy, izz] = inertia.diagonal().into();
    Inertial {
        origin: at(body.com),
        mass: Mass { value: body.mass },
        inertia: Inertia { ixx, iyy, izz, ixy: inertia.m12, ixz: inertia.m13, iyz: inertia.m23 },
    }
}

/// The foot as a box on its sole, half as high as the ankle.
fn foot_box(mechanism: &Mechanism, side: Side) -> (Vector3<f64>, Geometry) {
    let sole = mechanism.sole;
    let height = sole.ankle_height / 2.0;
    let centre = mechanism.sole_in_foot(side) + Vector3::new((sole.ahead - sole.behind) / 2.0, 0.0, height / 2.0);
    let size = Vec3([sole.ahead + sole.behind, 2.0 * sole.half_width, height]);
    (centre, Geometry::Box { size })
}

fn equivalent_box(body: &Body) -> Geometry {
    Geometry::Box { size: vec3(equivalent_sides(body)) }
}

/// Sides of the box of uniform density that has the body's mass and moments (m): they follow from Iz = m (a² + b²) / 12
/// and the same for x and y.
pub(crate) fn equivalent_sides(body: &Body) -> Vector3<f64> {
    let sum = body.inertia.sum();
    body.inertia.map(|moment| (6.0 * (sum - 2.0 * moment) / body.mass).max(0.0).sqrt())
}

fn at(place: Vector3<f64>) -> Pose {
    Pose { xyz: vec3(place), rpy: Vec3([0.0; 3]) }
}

fn vec3(vector: Vector3<f64>) -> Vec3 {
    Vec3(vector.into())
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    fn mechanism() -> Mechanism {
        Mechanism::load(format!("{}/../../config/mechanism.toml", env!("CARGO_MANIFEST_DIR")))
            .unwrap_or_else(|errors| panic!("{errors}"))
    }

    /// The robot as another program reads it.
    fn read_back(mechanism: &Mechanism) -> Robot {
        urdf_rs::read_from_string(&urdf_text(mechanism).unwrap()).unwrap()
    }

    #[test]
    fn urdf_robot_has_the_mass_of_the_mechanism() {
        let mass: f64 = read_back(&mechanism()).links.iter().map(|link| link.inertial.mass.value).sum();
        assert!((mass - 73.031).abs() < 1e-12, "{mass}");
    }

    #[test]
    fn urdf_joints_have_the_axes_and_limits_of_the_mechanism() {
        let mechanism = mechanism();
        let robot = read_back(&mechanism);
        assert_eq!((robot.links.len(), robot.joints.len()), (19, 18));
        for exported in &robot.joints {
            let joint = Joint::from_name(&exported.name).expect("a joint of the mechanism");
            let link = &mechanism.links[joint];
            let limits = link.limits.expect("powered");
            assert_eq!(Vector3::from(exported.axis.xyz.0), *link.axis);
            assert_eq!(Vector3::from(exported.origin.xyz.0), link.origin);
            assert_eq!((exported.limit.lower, exported.limit.upper), (limits.angle_min, limits.angle_max));
        }
    }

    #[test]
    fn urdf_links_are_one_tree_rooted_at_the_right_foot() {
        let robot = read_back(&mechanism());
        let is_child = |name: &str| robot.joints.iter().any(|joint| joint.child.link == name);
        let roots: Vec<_> = robot.links.iter().map(|link| &link.name).filter(|name| !is_child(name)).collect();
        assert_eq!(roots, ["right_foot"]);
        let is_link = |name: &str| robot.links.iter().any(|link| link.name == name);
        assert!(robot.joints.iter().all(|joint| is_link(&joint.parent.link) && is_link(&joint.child.link)));
    }

    #[test]
    fn box_of_a_link_has_its_mass_and_moments() {
        // a uniform brick of 2 kg and sides 0.1, 0.2, 0.3 m
        let moments = [0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04].map(|squares| 2.0 / 12.0 * squares);
        let brick = Body { mass: 2.0, com: Vector3::zeros(), inertia: moments.into(), ..Body::NONE };
        let Geometry::Box { size } = equivalent_box(&brick) else { panic!("not a box") };
        assert!((Vector3::from(size.0) - Vector3::new(0.1, 0.2, 0.3)).norm() < 1e-12, "{size:?}");
    }

    #[test]
    fn urdf_foot_boxes_lie_on_the_floor_at_zero_angles() {
        let mechanism = mechanism();
        let bottom = |side: Side| {
            let (centre, Geometry::Box { size }) = foot_box(&mechanism, side) else { panic!("not a box") };
            centre.z - size.0[2] / 2.0
        };
        assert!(bottom(Side::Right).abs() < 1e-15);
        assert!((bottom(Side::Left) + mechanism.sole.ankle_height).abs() < 1e-15);
    }
}
