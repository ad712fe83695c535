//! The built-in plant's held joints give way as their servos do: at rest the deflection is torque over stiffness.

use config::Config;
use dynamics::{HeldPoses, Kinematics, Tree};
use halfstep_tests::repository;
use interface::Setpoint;
use model::{GRAVITY, Joint, Mechanism, Motion, UnlumpedMechanism};
use nalgebra::Vector3;
use plant::{Plant, PlantParameters, SensorParameters};

fn robot(name: &str) -> (Mechanism, PlantParameters) {
    let folder = repository().join("config/robots").join(name);
    let mechanism = Mechanism::load(folder.join("mechanism.toml")).unwrap_or_else(|errors| panic!("{errors}"));
    let parameters = PlantParameters::load(folder.join("plant.toml")).unwrap_or_else(|errors| panic!("{errors}"));
    (mechanism, PlantParameters { sensors: SensorParameters::PERFECT, ..parameters })
}

/// Torque of gravity about each held joint (N·m), in the posture of a plant.
fn gravity_torques(robot: &UnlumpedMechanism, plant: &Plant) -> Vec<f64> {
    let tree = Tree::with_held(robot);
    let mut kinematics = Kinematics::default();
    let (state, mut poses) = (&plant.robot, HeldPoses::new());
    let deflections = &state.held.deflections;
    kinematics.compute_with_held(&tree, &state.sole_to_world, &state.angles, deflections, &mut poses);
    let moment = |held: usize| {
        let pose = &poses[held];
        let beyond = |mut by: Option<usize>| {
            while let Some(index) = by {
                if index == held {
                    return true;
                }
                by = robot.held[index].below;
            }
            false
        };
        let down = |mass: f64, com: Vector3<f64>| (com - pose.origin).cross(&(Vector3::z() * (-GRAVITY * mass)));
        let is_link_beyond = |link: Joint| {
            let mut way = Some(link);
            while let Some(joint) = way {
                if beyond(tree.held_below(joint)) {
                    return true;
                }
                way = robot.mechanism.links[joint].parent;
            }
            false
        };
        let of_held = robot.held.iter().zip(&poses).enumerate();
        let of_held = of_held.filter(|(index, (link, _))| beyond(Some(*index)) || is_link_beyond(link.mount));
        let of_held = of_held.map(|(_, (link, at))| down(link.body.mass, at.origin + at.rotation * link.body.com));
        let of_links = robot.mechanism.links.iter().filter(|(joint, _)| is_link_beyond(*joint));
        let of_links = of_links.map(|(joint, link)| {
            down(link.body.mass, kinematics.origin[joint] + kinematics.rotation[joint] * link.body.com)
        });
        pose.axis.dot(&of_held.chain(of_links).sum::<Vector3<f64>>())
    };
    (0..robot.held.len()).map(moment).collect()
}

#[test]
fn the_deflection_of_a_held_joint_is_torque_over_stiffness() {
    for name in ["g1", "h1_2", "jvrc1", "t1"] {
        let (mechanism, parameters) = robot(name);
        let unlumped = mechanism.unlumped();
        let mut plant = Plant::new(&mechanism, &parameters, &Motion::default(), 1e-3, 1);
        for _ in 0..6000 {
            plant.step(&Setpoint::default());
        }
        assert!(!plant.truth().has_fallen() && plant.robot.held.rates.iter().all(|rate| rate.abs() < 1e-4), "{name}");
        let torques = gravity_torques(&unlumped, &plant);
        let mut most: f64 = 0.0;
        for (index, torque) in torques.into_iter().enumerate() {
            // Where the torque is within the effort.
            assert!(torque.abs() < unlumped.held[index].drive.effort, "{name}: {torque} N·m at held joint {index}");
            let expected = torque / unlumped.servo_of(index).stiffness;
            let deflection = plant.robot.held.deflections[index];
            assert!((deflection - expected).abs() < 1e-6, "{name} {index}: {deflection} rad, not {expected}");
            most = most.max(deflection.abs());
        }
        assert!(most > 1e-5, "{name}: nothing gives way");
    }
}

/// Half the stiffness, twice the deflection: the share in `plant.toml` is that of held joints, too.
#[test]
fn shares_of_stiffness_are_those_of_held_joints_too() {
    let (mechanism, parameters) = robot("g1");
    let most = |stiffness: f64| {
        let servo = plant::ServoShares { stiffness, damping: 1.0 };
        let parameters = PlantParameters { servo, ..parameters.clone() };
        let mut plant = Plant::new(&mechanism, &parameters, &Motion::default(), 1e-3, 1);
        for _ in 0..4000 {
            plant.step(&Setpoint::default());
        }
        plant.robot.held.deflections.iter().fold(0.0, |most: f64, deflection| most.max(deflection.abs()))
    };
    let ratio = most(0.5) / most(1.0);
    assert!((1.9..2.2).contains(&ratio), "{ratio}");
}
