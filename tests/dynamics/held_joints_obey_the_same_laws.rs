//! Robots whose held joints turn: where these are at their angles, they are the robots that the controller knows; with
//! drives that do not yield they move as those do; and free they keep their energy.

use config::Config;
use dynamics::{ArticulatedBody, FloatingRates, HeldJointDrive, HeldPoses, Kinematics, Tree};
use halfstep_tests::{random, random_joints, repository};
use model::{Body, GRAVITY, JointVector, Mechanism, PerJoint, UnlumpedMechanism};
use nalgebra::{Isometry3, Matrix3, UnitQuaternion, Vector3};
use rand::{Rng, rngs::StdRng};

/// Robots in the box with held joints: wrists of three joints, waists that turn, arms that hang by joints of their own.
const NAMES: [&str; 9] = ["g1", "gr1t1", "h1_2", "jvrc1", "limx", "op3", "qinglong", "t1", "talos"];

fn robot(name: &str) -> (Mechanism, UnlumpedMechanism) {
    let file = repository().join("config/robots").join(name).join("mechanism.toml");
    let mechanism = Mechanism::load(file).unwrap_or_else(|errors| panic!("{errors}"));
    let unlumped = mechanism.unlumped();
    assert!(unlumped.held.len() >= 6, "{name}: only {} held joints have links", unlumped.held.len());
    (mechanism, unlumped)
}

/// Angles or rates of the joints that a robot has.
fn of_joints(robot: &Mechanism, random: &mut StdRng, size: f64) -> JointVector {
    let values = random_joints(random, size);
    PerJoint::from_fn(|joint| if robot.has(joint) { values[joint] } else { 0.0 })
}

fn vector(random: &mut StdRng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

/// Bodies with rotation and origin of their frames.
fn bodies(
    robot: &UnlumpedMechanism,
    kinematics: &Kinematics,
    held: &HeldPoses,
) -> Vec<(Body, Matrix3<f64>, Vector3<f64>)> {
    let links = robot.mechanism.links.iter();
    let links = links.map(|(joint, link)| (link.body, kinematics.rotation[joint], kinematics.origin[joint]));
    links.chain(robot.held.iter().zip(held).map(|(link, pose)| (link.body, pose.rotation, pose.origin))).collect()
}

/// Mass, and first and second moment about the origin.
fn moments(bodies: &[(Body, Matrix3<f64>, Vector3<f64>)]) -> (f64, Vector3<f64>, Matrix3<f64>) {
    bodies.iter().fold((0.0, Vector3::zeros(), Matrix3::zeros()), |(mass, first, second), (body, turn, origin)| {
        let com = origin + turn * body.com;
        let about_com = turn * body.inertia_matrix() * turn.transpose();
        let steiner = body.mass * (Matrix3::identity() * com.norm_squared() - com * com.transpose());
        (mass + body.mass, first + body.mass * com, second + about_com + steiner)
    })
}

#[test]
fn at_their_angles_held_joints_make_the_robot_that_the_controller_knows() {
    let mut random = random(11);
    for (mechanism, unlumped) in NAMES.map(robot) {
        let (lumped, tree) = (Tree::new(&mechanism), Tree::with_held(&unlumped));
        let rigid = UnlumpedMechanism { mechanism: mechanism.clone(), held: Vec::new() };
        assert!((tree.mass - lumped.mass).abs() < 1e-9, "{}: {} and {} kg", mechanism.name, tree.mass, lumped.mass);
        for _ in 0..10 {
            let sole = Isometry3::new(vector(&mut random, 1.0), vector(&mut random, 1.0));
            let (angles, rates) = (of_joints(&mechanism, &mut random, 0.8), of_joints(&mechanism, &mut random, 2.0));
            let (mut of_lumped, mut kinematics) = (Kinematics::default(), Kinematics::default());
            of_lumped.compute_floating_base(&lumped, &sole, &angles);
            let mut held = HeldPoses::new();
            kinematics.compute_with_held(&tree, &sole, &angles, &[], &mut held);
            assert!((of_lumped.com(&lumped) - kinematics.com_with_held(&tree, &held, &still()).0).norm() < 1e-9);

            let (mass, first, second) = moments(&bodies(&rigid, &of_lumped, &HeldPoses::new()));
            let (sum, first_sum, second_sum) = moments(&bodies(&unlumped, &kinematics, &held));
            assert!((sum - mass).abs() < 1e-9 && (first_sum - first).norm() < 1e-9, "{}", mechanism.name);
            let off = (second_sum - second).norm();
            assert!(off < 1e-9, "{}: inertias differ by {off} kg·m²", mechanism.name);

            // Its centre of mass moves alike, too.
            let (angular_rate, velocity) = (vector(&mut random, 2.0), vector(&mut random, 2.0));
            let moving = FloatingRates { angular_rate, velocity, joints: &rates, held: &[] };
            let (com, moves) = kinematics.com_with_held(&tree, &held, &moving);
            let (against_sole, _) = of_lumped.com_velocity(&lumped, &rates);
            let expected = velocity + angular_rate.cross(&(com - sole.translation.vector)) + against_sole;
            assert!((moves - expected).norm() < 1e-9, "{}: {moves} and {expected}", mechanism.name);
        }
    }
}

fn still() -> FloatingRates<'static> {
    let (angular_rate, velocity) = (Vector3::zeros(), Vector3::zeros());
    FloatingRates { angular_rate, velocity, joints: &JointVector::ZERO, held: &[] }
}

#[test]
fn drives_that_do_not_yield_make_the_welded_robot() {
    let mut random = random(12);
    for (mechanism, unlumped) in NAMES.map(robot) {
        let (lumped, tree) = (Tree::new(&mechanism), Tree::with_held(&unlumped));
        let (mut welded, mut held) = (ArticulatedBody::new(&lumped), ArticulatedBody::new(&tree));
        // Stiffness enters a step as inertia.
        let rigid = HeldJointDrive { armature: 1e13, ..HeldJointDrive::default() };
        for _ in 0..10 {
            let sole = Isometry3::new(vector(&mut random, 1.0), vector(&mut random, 1.0));
            let (angles, rates) = (of_joints(&mechanism, &mut random, 0.8), of_joints(&mechanism, &mut random, 2.0));
            let (rate, velocity) = (vector(&mut random, 2.0), vector(&mut random, 2.0));
            let torques = random_joints(&mut random, 20.0);
            let armature = PerJoint::from_fn(|_| 0.02);
            welded.set_state(&lumped, &sole, rate, velocity, &angles, &rates);
            held.set_held(std::iter::repeat_n(rigid, tree.held_count()));
            held.set_state(&tree, &sole, rate, velocity, &angles, &rates);
            let expected = welded.accelerations(&lumped, &torques, &armature, &[]);
            let found = held.accelerations(&tree, &torques, &armature, &[]);
            let size = 1.0 + expected.joints.max_abs() + expected.base_angular.norm() + expected.base_linear.norm();
            let off = (found.joints - expected.joints).max_abs()
                + (found.base_angular - expected.base_angular).norm()
                + (found.base_linear - expected.base_linear).norm();
            assert!(off < 1e-8 * size, "{}: accelerations of {size} differ by {off}", mechanism.name);
        }
    }
}

/// A robot in free fall, unforced and tumbling, its held joints free as well.
#[derive(Clone)]
struct Tumbling {
    pose: Isometry3<f64>,
    angular_rate: Vector3<f64>,
    velocity: Vector3<f64>,
    angles: JointVector,
    rates: JointVector,
    held_angles: Vec<f64>,
    held_rates: Vec<f64>,
}

impl Tumbling {
    /// Moves on by `step` with the rates of `at` and the accelerations found there.
    fn advanced(&self, at: &Tumbling, body: &mut ArticulatedBody, tree: &Tree, step: f64) -> Tumbling {
        let held = at.held_angles.iter().zip(&at.held_rates);
        body.set_held(held.map(|(&deflection, &rate)| HeldJointDrive {
            deflection,
            rate,
            ..HeldJointDrive::default()
        }));
        body.set_state(tree, &at.pose, at.angular_rate, at.velocity, &at.angles, &at.rates);
        let found = body.accelerations(tree, &JointVector::ZERO, &JointVector::ZERO, &[]);
        let sum = |from: &[f64], by: &[f64]| from.iter().zip(by).map(|(from, by)| from + by * step).collect();
        let held: Vec<f64> = body.held_accelerations().collect();
        Tumbling {
            held_angles: sum(&self.held_angles, &at.held_rates),
            held_rates: sum(&self.held_rates, &held),
            ..self.moved(at, step, found.base_angular, found.base_linear, &found.joints)
        }
    }

    fn moved(
        &self,
        at: &Tumbling,
        step: f64,
        angular: Vector3<f64>,
        linear: Vector3<f64>,
        joints: &JointVector,
    ) -> Tumbling {
        let turn = UnitQuaternion::from_scaled_axis(at.angular_rate * step);
        Tumbling {
            pose: Isometry3::from_parts(
                (self.pose.translation.vector + at.velocity * step).into(),
                turn * self.pose.rotation,
            ),
            angular_rate: self.angular_rate + angular * step,
            velocity: self.velocity + linear * step,
            angles: self.angles + at.rates * step,
            rates: self.rates + *joints * step,
            ..self.clone()
        }
    }

    /// Frames and bodies a little later.
    fn bodies(&self, robot: &UnlumpedMechanism, tree: &Tree, later: f64) -> Vec<(Body, Matrix3<f64>, Vector3<f64>)> {
        let zero = (Vector3::zeros(), JointVector::ZERO);
        let at = self.moved(self, later, zero.0, zero.0, &zero.1);
        let held: Vec<f64> = self.held_angles.iter().zip(&self.held_rates).map(|(at, by)| at + by * later).collect();
        let mut kinematics = Kinematics::default();
        let mut poses = HeldPoses::new();
        kinematics.compute_with_held(tree, &at.pose, &at.angles, &held, &mut poses);
        bodies(robot, &kinematics, &poses)
    }

    /// Kinetic and potential energy; velocities are differences of poses.
    fn energy(&self, robot: &UnlumpedMechanism, tree: &Tree) -> f64 {
        const STEP: f64 = 1e-5;
        let [before, now, after] = [-STEP, 0.0, STEP].map(|later| self.bodies(robot, tree, later));
        let each = before.iter().zip(&now).zip(&after);
        each.map(|((before, now), after)| {
            let (body, turn, origin) = now;
            let com = |(body, turn, origin): &(Body, Matrix3<f64>, Vector3<f64>)| origin + turn * body.com;
            let velocity = (com(after) - com(before)) / (2.0 * STEP);
            let turned = after.1 * before.1.transpose();
            let axis = Vector3::new(turned.m32 - turned.m23, turned.m13 - turned.m31, turned.m21 - turned.m12);
            let rate = turn.tr_mul(&(axis / (4.0 * STEP)));
            let height = (origin + turn * body.com).z;
            0.5 * body.mass * velocity.norm_squared()
                + 0.5 * rate.dot(&(body.inertia_matrix() * rate))
                + body.mass * GRAVITY * height
        })
        .sum()
    }
}

#[test]
fn energy_of_a_free_robot_with_free_held_joints_is_kept() {
    for name in ["g1", "talos"] {
        let (mechanism, unlumped) = robot(name);
        let tree = Tree::with_held(&unlumped);
        let error = |step: f64| {
            let mut random = random(7);
            let mut held = |size: f64| (0..tree.held_count()).map(|_| random.random_range(-size..size)).collect();
            let (held_angles, held_rates) = (held(0.3), held(1.0));
            let (angles, rates) = (of_joints(&mechanism, &mut random, 0.5), of_joints(&mechanism, &mut random, 1.0));
            let mut state = Tumbling {
                pose: Isometry3::translation(0.0, 0.0, 1.0),
                angular_rate: Vector3::new(0.5, -1.0, 0.3),
                velocity: Vector3::new(0.4, 0.2, 1.5),
                angles,
                rates,
                held_angles,
                held_rates,
            };
            let mut body = ArticulatedBody::new(&tree);
            let before = state.energy(&unlumped, &tree);
            for _ in 0..(0.05 / step).round() as usize {
                let middle = state.advanced(&state, &mut body, &tree, 0.5 * step);
                state = state.advanced(&middle, &mut body, &tree, step);
            }
            (state.energy(&unlumped, &tree) - before).abs()
        };
        let (coarse, fine) = (error(2e-4), error(1e-4));
        assert!(fine < 1e-2 && (3.0..6.0).contains(&(coarse / fine)), "{name}: {coarse} J and {fine} J");
    }
}
