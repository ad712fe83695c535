//! Goal: ramps, steps and height fields carry soles as such ground does.
//!
//! Method: a mass rests on one sole on a ramp and is carried by its normal force, up to the friction angle; it is
//! pushed against the side of a step; the whole robot stands on a step and across its edge, and walks on a ramp as it
//! walks under tilted gravity.

use halfstep_tests::mechanism;
use halfstep_tests::walking::{Walking, controller_parameters, plant_parameters};
use interface::Setpoint;
use model::{GRAVITY, Motion, Side};
use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector2, Vector3, Vector6};
use plant::{
    ContactParameters, FloorRamp, FloorShape, FloorStep, FootMotion, Ground, GroundContact, Plant, PlantParameters,
    SensorParameters, Slope, Truth, Unevenness,
};

const STEP: f64 = 2.5e-4;
const MASS: f64 = 73.0;

/// A mass on one sole, which does not turn.
struct Block {
    foot: GroundContact,
    orientation: Matrix3<f64>,
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    contact: ContactParameters,
    ground: Ground,
}

impl Block {
    fn new(floor: FloorShape, friction: f64, orientation: UnitQuaternion<f64>, position: Vector3<f64>) -> Self {
        let contact = ContactParameters { friction, ..plant_parameters().contact };
        let ground = Ground::new(Unevenness::default(), floor, friction, 0);
        let orientation = orientation.to_rotation_matrix().into_inner();
        let foot = GroundContact::new(&mechanism());
        Self { foot, orientation, position, velocity: Vector3::zeros(), contact, ground }
    }

    /// Moves on for some seconds under gravity and another force (N): the ground's force in the end (N).
    fn slide(&mut self, seconds: f64, force: Vector3<f64>) -> Vector3<f64> {
        let weight = Vector3::new(0.0, 0.0, -MASS * GRAVITY);
        let mut carried = Vector3::zeros();
        for _ in 0..(seconds / STEP) as usize {
            let motion = FootMotion {
                rotation: self.orientation,
                origin: Vector3::zeros(),
                velocity: Vector6::new(0.0, 0.0, 0.0, self.velocity.x, self.velocity.y, self.velocity.z),
            };
            let foot = &mut self.foot.feet[Side::Right.index()];
            let load = foot.forces_at_step_end(&motion, &self.position, &self.ground, &self.contact, STEP);
            let added = load.added_inertia.fixed_view::<3, 3>(3, 3);
            let inertia = Matrix3::from_diagonal_element(MASS) + added;
            let acceleration = inertia.lu().solve(&(load.wrench.force + weight + force)).expect("a mass can be moved");
            carried = load.wrench.force - added * acceleration;
            self.velocity += acceleration * STEP;
            self.position += self.velocity * STEP;
        }
        carried
    }
}

fn ramp(rise: f64, heading: f64) -> FloorRamp {
    FloorRamp { direction: Vector2::new(heading.cos(), heading.sin()), from: 0.5, rise, length: 100.0 }
}

/// A block on a ramp of some angle and heading (rad), at rest on it.
fn on_ramp(rise: f64, heading: f64, friction: f64) -> (Block, Vector3<f64>, Vector3<f64>) {
    let uphill = Vector3::new(heading.cos() * rise.cos(), heading.sin() * rise.cos(), rise.sin());
    let orientation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading)
        * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -rise);
    let normal = orientation * Vector3::z();
    let along = 10.0;
    let place = Vector3::new(heading.cos() * along, heading.sin() * along, (along - 0.5) * rise.tan());
    let floor = FloorShape { ramps: vec![ramp(rise, heading)], ..FloorShape::default() };
    (Block::new(floor, friction, orientation, place), uphill, normal)
}

#[test]
fn a_block_rests_on_a_ramp_up_to_the_friction_angle() {
    for heading in [0.0, 1.0, 2.5, -1.6] {
        let rise = 0.29_f64.atan();
        let (mut block, uphill, normal) = on_ramp(rise, heading, 0.3);
        block.slide(0.5, Vector3::zeros());
        let before = block.position;
        let force = block.slide(1.0, Vector3::zeros());
        assert!((block.position - before).norm() < 1e-5, "slid by {}", block.position - before);
        let [pressed, held] = [force.dot(&normal), force.dot(&uphill)];
        let weight = MASS * GRAVITY;
        assert!((pressed - weight * rise.cos()).abs() < 1e-3 * weight, "{pressed} N normal to the ramp");
        assert!((held - weight * rise.sin()).abs() < 1e-3 * weight, "{held} N along the ramp");
    }
}

#[test]
fn a_block_slides_down_a_ramp_above_the_friction_angle() {
    let rise = 0.32_f64.atan();
    let (mut block, uphill, normal) = on_ramp(rise, 0.7, 0.3);
    block.slide(0.5, Vector3::zeros());
    let before = block.velocity;
    block.slide(0.5, Vector3::zeros());
    let gained = (block.velocity - before).dot(&uphill);
    let expected = -0.5 * GRAVITY * (rise.sin() - 0.3 * rise.cos());
    assert!((gained - expected).abs() < 0.01 * expected.abs(), "{gained} m/s instead of {expected} m/s");
    assert!(block.velocity.dot(&normal).abs() < 1e-4, "it stays on the ramp");
}

#[test]
fn the_side_of_a_step_stops_a_foot_and_does_not_lift_it() {
    let height = 0.03;
    let steps = vec![FloorStep { direction: Vector2::x(), from: 1.0, height, length: f64::INFINITY }];
    let floor = FloorShape { steps, ..FloorShape::default() };
    let toe = mechanism().sole.ahead;
    let begin = Vector3::new(1.0 - toe - 0.02, 0.0, -MASS * GRAVITY / (4.0 * plant_parameters().contact.stiffness));
    let mut block = Block::new(floor, 0.1, UnitQuaternion::identity(), begin);
    block.velocity.x = 0.5;
    let push = Vector3::new(200.0, 0.0, 0.0);
    for _ in 0..20 {
        block.slide(0.05, push);
        let into = block.position.x + toe - 1.0;
        assert!(into < 5e-3, "{into} m into the step");
        assert!(block.position.z < 2e-3, "lifted to {} m", block.position.z);
    }
    assert!(block.velocity.norm() < 1e-3 && block.position.x + toe > 1.0 - 1e-4, "it leans on the step");
}

/// The robot standing with its right sole at a place, after some seconds.
fn standing_at(floor: FloorShape, place: Vector3<f64>, seconds: u32) -> Plant {
    let parameters = PlantParameters { floor, sensors: SensorParameters::PERFECT, ..plant_parameters() };
    let mut plant = Plant::new(&mechanism(), &parameters, &Motion::default(), 1e-3, 1);
    plant.robot.sole_to_world.translation.vector += place;
    for _ in 0..1000 * seconds {
        plant.step(&Setpoint::default());
    }
    plant
}

fn step(from: f64, height: f64) -> FloorShape {
    let steps = vec![FloorStep { direction: Vector2::x(), from, height, length: f64::INFINITY }];
    FloorShape { steps, ..FloorShape::default() }
}

#[test]
fn a_robot_stands_on_a_step_at_its_height() {
    for height in [0.03, -0.05] {
        let plant = standing_at(step(1.0, height), Vector3::new(3.0, 0.0, height), 2);
        let truth = plant.truth();
        for sole in truth.soles {
            assert!((sole.translation.z - height).abs() < 1e-3, "{}", sole.translation);
        }
        assert_eq!(truth.floor_height, height);
        assert!(!truth.has_fallen());
    }
}

/// The edge lies 5 cm behind the centre of mass, so that only the front of each sole is on the step. Corners alone
/// would let the heels fall.
#[test]
fn a_robot_stands_with_the_edge_of_a_step_under_its_soles() {
    let com = standing_at(FloorShape::default(), Vector3::zeros(), 1).truth().com.x;
    let plant = standing_at(step(3.0, 0.03), Vector3::new(3.05 - com, 0.0, 0.03), 2);
    let sole = plant.truth().soles[0];
    assert!((sole * Vector3::z_axis()).angle(&Vector3::z()) < 0.02, "{}", sole.rotation);
    assert!(!plant.truth().has_fallen() && (sole.translation.z - 0.03).abs() < 2e-3, "{}", sole.translation);
}

/// The truth after a walk that begins with the robot moved by `to_world`.
fn walked(parameters: &PlantParameters, to_world: &Isometry3<f64>) -> Truth {
    let mut walking = Walking::begin_with(&mechanism(), &controller_parameters(), parameters, 1);
    let robot = &mut walking.plant.robot;
    robot.sole_to_world = to_world * robot.sole_to_world;
    robot.velocity = to_world * robot.velocity;
    robot.angular_rate = to_world * robot.angular_rate;
    walking.measurement = walking.plant.measure();
    walking.walk(4.0)
}

/// The same ramp twice: as ground with shape, and as a plane under tilted gravity. Rounding alone tells them apart.
/// Sensors are perfect: rounding would grow where it changes the last digit of a sensor.
#[test]
fn a_walk_on_a_ramp_is_a_walk_under_tilted_gravity() {
    for rise in [2_f64.to_radians(), -2_f64.to_radians()] {
        let level = PlantParameters { sensors: SensorParameters::PERFECT, ..plant_parameters() };
        let tilted = PlantParameters { slope: Slope { ahead: rise, left: 0.0 }, ..level.clone() };
        let ramps = vec![FloorRamp { direction: Vector2::x(), from: -100.0, rise, length: 1000.0 }];
        let shaped = PlantParameters { floor: FloorShape { ramps, ..FloorShape::default() }, ..level };
        let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -rise);
        let on_ramp = Isometry3::from_parts(Translation3::new(0.0, 0.0, 100.0 * rise.tan()), turn);

        let [expected, found] = [(&tilted, Isometry3::identity()), (&shaped, on_ramp)]
            .map(|(parameters, begin)| walked(parameters, &begin));
        assert!(!expected.has_fallen() && !found.has_fallen());
        let apart = on_ramp * Point3::from(expected.com) - Point3::from(found.com);
        assert!(expected.com.x > 1.0 && apart.norm() < 5e-4, "{} m apart after 4 s", apart.norm());
    }
}
