//! A robot with stiff joints, dropped from 1 cm on both soles, bounces out and settles: its energy never grows, and the
//! ground ends up carrying its weight.

use dynamics::{Tree, kinetic_energy, potential_energy};
use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::Setpoint;
use model::{GRAVITY, JointVector, Motion, Side};
use plant::Plant;

#[test]
fn energy_of_a_dropped_robot_never_grows_until_it_settles_at_its_weight() {
    let mechanism = mechanism();
    let tree = Tree::new(&mechanism);
    let parameters = plant_parameters();
    let mut plant = Plant::new(&mechanism, &parameters, &Motion::default(), 1e-3, 1);
    plant.robot.sole_to_world.translation.vector.z = 0.01;

    // Of the robot, the springs of the drives and of the ground: nothing may add to the sum.
    let rotors =
        model::PerJoint::from_fn(|joint| mechanism.links[joint].motor.map_or(0.0, |motor| motor.reflected_inertia()));
    let energy = |plant: &Plant| {
        let robot = &plant.robot;
        let kinematics = robot.kinematics(&tree);
        let moving = kinetic_energy(&tree, &kinematics, robot.angular_rate, robot.velocity, &robot.rates)
            + 0.5 * rotors.0.iter().zip(&robot.rates.0).map(|(inertia, rate)| inertia * rate * rate).sum::<f64>();
        let stiffness = |joint| mechanism.servos.of(joint).stiffness;
        let servos: f64 = robot.angles.iter().map(|(joint, angle)| 0.5 * stiffness(joint) * angle * angle).sum();
        let ground: f64 = plant
            .truth()
            .soles
            .iter()
            .zip(Side::BOTH)
            .flat_map(|(sole, side)| mechanism.sole.corners(side).map(|corner| sole * nalgebra::Point3::from(corner)))
            .map(|corner| 0.5 * parameters.contact.stiffness * corner.z.min(0.0).powi(2))
            .sum();
        moving + potential_energy(&tree, &kinematics) + servos + ground
    };

    let mut before = energy(&plant);
    let start = before;
    for tick in 0..3000 {
        plant.step(&Setpoint { angles: JointVector::ZERO, ..Setpoint::default() });
        let now = energy(&plant);
        assert!(now <= before + 1e-6 * start, "period {tick}: energy grew from {before} J to {now} J");
        before = now;
    }
    let truth = plant.truth();
    let weight = mechanism.mass() * GRAVITY;
    let carried = truth.loads[0] + truth.loads[1];
    assert!((carried - weight).abs() < 0.01 * weight, "the ground carries {carried} N of {weight} N");
    assert!(before < start, "the drop lost nothing");
}
