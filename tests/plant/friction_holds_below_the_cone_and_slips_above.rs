//! A sole pressed on the ground and pulled sideways stays where it is while the pull is within the cone, and slides
//! with the cone's own force beyond it.
//!
//! Method: a mass of the robot's weight rests on one sole and is pulled by a constant force.

use halfstep_tests::mechanism;
use halfstep_tests::walking::plant_parameters;
use model::{Mechanism, Side};
use nalgebra::{Matrix3, Vector3, Vector6};
use plant::{ContactParameters, FootMotion, Ground, GroundContact};

const STEP: f64 = 2.5e-4;

/// Pulls a point mass resting on one sole sideways with `pull` times its weight for a second: how far it goes, and its
/// speed after half the time and at the end. (At first the bristles give way: only the second half is sliding alone.)
fn pulled(pull: f64, friction: f64) -> (f64, [f64; 2]) {
    let parameters = ContactParameters { friction, ..plant_parameters().contact };
    let mechanism: Mechanism = mechanism();
    let foot = &mut GroundContact::new(&mechanism).feet[Side::Right.index()];
    let (mass, gravity) = (73.0, model::GRAVITY);
    let mut position = Vector3::new(0.0, 0.0, -mass * gravity / (4.0 * parameters.stiffness));
    let mut velocity = Vector3::zeros();
    let steps = (1.0 / STEP) as usize;
    let mut half_way = 0.0;
    for index in 0..steps {
        if index == steps / 2 {
            half_way = velocity.x;
        }
        let motion = FootMotion {
            rotation: Matrix3::identity(),
            origin: Vector3::zeros(),
            velocity: Vector6::new(0.0, 0.0, 0.0, velocity.x, velocity.y, velocity.z),
        };
        let load = foot.forces_at_step_end(&motion, &position, &Ground::plane(friction), &parameters, STEP);
        let force = load.wrench.force + Vector3::new(pull * mass * gravity, 0.0, -mass * gravity);
        let inertia = Matrix3::from_diagonal_element(mass) + load.added_inertia.fixed_view::<3, 3>(3, 3);
        velocity += inertia.lu().solve(&force).expect("a mass can be moved") * STEP;
        position += velocity * STEP;
    }
    (position.x, [half_way, velocity.x])
}

#[test]
fn a_sole_pulled_within_the_friction_cone_stays_where_it_is() {
    let (distance, [_, speed]) = pulled(0.55, 0.6);
    assert!(distance < 1e-3, "slid by {distance} m");
    assert!(speed.abs() < 1e-4, "creeps at {speed} m/s");
}

#[test]
fn a_sole_pulled_beyond_the_friction_cone_slides_with_the_cones_force() {
    let (_, [half_way, end]) = pulled(0.65, 0.6);
    let expected = 0.5 * (0.65 - 0.6) * model::GRAVITY;
    let gained = end - half_way;
    assert!((gained - expected).abs() < 0.01 * expected, "in half a second {gained} m/s instead of {expected} m/s");
}
