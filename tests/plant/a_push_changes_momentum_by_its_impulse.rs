//! Goal: a push gives the robot its impulse, wherever and however long it pushes.
//!
//! Method: pushed in free flight, the robot's momentum, mass times the velocity of its centre of mass, changes by
//! impulse and weight alone. What remains is the integrator's, and shrinks with its step.

use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use interface::Setpoint;
use model::{GRAVITY, Joint, Motion};
use nalgebra::Vector3;
use plant::{Plant, PlantParameters, Push};

const PERIOD: f64 = 1e-3;

/// A robot in flight after a number of control periods.
fn flown(push: Option<Push>, steps_per_period: u32, periods: u32) -> Plant {
    let parameters = PlantParameters { steps_per_period, ..plant_parameters() };
    let mut plant = Plant::new(&mechanism(), &parameters, &Motion::default(), PERIOD, 1);
    plant.robot.sole_to_world.translation.vector.z = 10.0;
    plant.disturbances.pushes.extend(push);
    for _ in 0..periods {
        plant.step(&Setpoint::default());
    }
    plant
}

/// Momentum after a quarter of a second of flight (N·s).
fn momentum(push: Option<Push>, steps_per_period: u32) -> Vector3<f64> {
    flown(push, steps_per_period, 250).truth().com_velocity * mechanism().mass()
}

#[test]
fn momentum_of_an_unpushed_robot_in_flight_changes_by_its_weight() {
    let expected = Vector3::new(0.0, 0.0, -mechanism().mass() * GRAVITY * 0.25);
    let found = momentum(None, 4);
    assert!((found - expected).norm() < 1e-6, "{found}");
}

#[test]
fn a_push_on_any_link_changes_momentum_by_its_impulse() {
    let flight = momentum(None, 4);
    let impulse = Vector3::new(5.0, -4.0, 2.0);
    for link in Joint::ALL.into_iter().filter(|joint| joint.link_name().is_some()) {
        // Begins and ends within integration steps.
        let push = Push { link, impulse, start: 0.050_04, duration: 0.099_93 };
        let gained = momentum(Some(push), 4) - flight;
        assert!((gained - impulse).norm() < 0.01 * impulse.norm(), "{}: {gained}", link.name());
    }
}

#[test]
fn momentum_error_of_a_push_shrinks_with_the_integration_step() {
    let push = Push { link: Joint::WaistRoll, impulse: Vector3::new(10.0, 10.0, 0.0), start: 0.05, duration: 0.1 };
    let error = |steps| (momentum(Some(push), steps) - momentum(None, steps) - push.impulse).norm();
    let (coarse, fine) = (error(4), error(8));
    assert!(coarse < 0.05, "{coarse} N·s");
    assert!((1.7..2.3).contains(&(coarse / fine)), "halving the step changed {coarse} to {fine} N·s: not first order");
}

/// What is asked for at the beginning of a period is not asked for in the period before: a script of it must not act
/// there either, not even by a rounding error.
#[test]
fn a_push_that_begins_with_a_period_leaves_the_one_before_alone() {
    for (steps, periods) in [1, 3, 4, 7].into_iter().flat_map(|steps| (1..60).map(move |periods| (steps, periods))) {
        let start = f64::from(periods) * PERIOD;
        let push = Push { link: Joint::WaistRoll, impulse: Vector3::new(5.0, -4.0, 2.0), start, duration: 0.1 };
        let [with, without] = [Some(push), None].map(|push| flown(push, steps, periods));
        assert_eq!(with.robot, without.robot, "{steps} steps, {periods} periods");
    }
}
