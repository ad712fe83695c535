//! One control period of the simulated robot.

use dynamics::{ArticulatedBody, Kinematics, Tree};
use model::{GRAVITY, Joint, JointVector, Mechanism, Motion, Side, Wrench};
use nalgebra::{UnitQuaternion, Vector3};

use crate::contact::FootMotion;
use crate::loads::Loads;
use crate::robot::TRUNK;
use crate::sensor_fault::Arrival;
use crate::{Disturbances, Drive, GroundContact, Measurement, Parameters, Push, RobotState, Sensors, with_mass_error};

/// What the drives are to reach at the end of the period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// [rad]
    pub angles: JointVector,
    /// [rad/s]
    pub rates: JointVector,
    /// Torques to add to the servos' [N·m].
    pub feed_forward: JointVector,
}

/// The simulated robot with its ground, drives and sensors.
#[derive(Clone, Debug)]
pub struct Plant {
    /// As built: with its errors of mass.
    pub(crate) mechanism: Mechanism,
    pub(crate) tree: Tree,
    /// Height of its centre of mass when it stands straight [m].
    pub(crate) standing_height: f64,
    pub(crate) parameters: Parameters,
    period: f64,
    /// Control periods since the start.
    pub(crate) periods: u64,
    /// Decides what is drawn by lot.
    seed: u64,
    /// The robot itself.
    pub robot: RobotState,
    /// What happens to it. More may be added at any time.
    pub disturbances: Disturbances,
    contact: GroundContact,
    drive: Drive,
    sensors: Sensors,
    arrival: Arrival,
    body: ArticulatedBody,
    world_to_level: UnitQuaternion<f64>,
    /// Of the ground on each foot at the end of the last step, about the right sole's origin in world axes.
    pub(crate) ground: [Wrench; 2],
    pub(crate) motor_torques: JointVector,
}

impl Plant {
    /// A robot that stands on its right sole and moves as `start` says.
    ///
    /// * `period` – control period [s]
    /// * `seed` – of the sensors' noise and the errors of mass
    pub fn new(mechanism: &Mechanism, parameters: &Parameters, start: &Motion, period: f64, seed: u64) -> Self {
        let mechanism = with_mass_error(mechanism, parameters.mass_error, seed);
        let tree = Tree::new(&mechanism);
        let weight = (tree.mass + parameters.payload.mass) * GRAVITY;
        let sunk_in = weight / (4.0 * parameters.contact.stiffness);
        let mut plant = Self {
            robot: RobotState::on_right_foot(start, -sunk_in),
            disturbances: Disturbances::default(),
            contact: GroundContact::new(&mechanism),
            drive: Drive::new(&mechanism, &parameters.servo),
            sensors: Sensors::new(parameters.sensors, seed),
            arrival: Arrival::default(),
            body: ArticulatedBody::default(),
            world_to_level: parameters.slope.world_to_level(),
            ground: [Wrench::ZERO; 2],
            motor_torques: JointVector::ZERO,
            standing_height: Kinematics::standing(&tree, &JointVector::ZERO).com(&tree).z,
            mechanism,
            parameters: parameters.clone(),
            period,
            periods: 0,
            seed,
            tree,
        };
        plant.body.gravity = parameters.slope.gravity();
        plant.ground[Side::Right.index()].force = parameters.slope.up() * weight;
        plant
    }

    /// Moves on by one control period towards a setpoint and tells what is sensed at its end.
    pub fn step(&mut self, setpoint: &Setpoint) -> Measurement {
        let count = self.parameters.steps_per_period;
        let step = self.period / f64::from(count);
        for index in 1..=count {
            let lead = f64::from(count - index) * step;
            let number = self.periods * u64::from(count) + u64::from(index);
            self.integrate(setpoint, lead, step, [number - 1, number].map(|number| number as f64 * step));
        }
        self.periods += 1;
        self.measure()
    }

    /// Since the start [s].
    pub fn time(&self) -> f64 {
        self.periods as f64 * self.period
    }

    /// Integrates each control period in so many steps from now on.
    pub fn set_steps_per_period(&mut self, count: u32) {
        self.parameters.steps_per_period = count;
    }

    /// Pushes the trunk from now on.
    ///
    /// * `impulse` – in world axes [N·s]
    /// * `duration` – [s]
    pub fn push(&mut self, impulse: Vector3<f64>, duration: f64) {
        self.disturbances.pushes.push(Push { link: TRUNK, impulse, start: self.time(), duration });
    }

    /// One integration step `from` a time `to` another [s since the start], which ends `lead` seconds before the setpoint
    /// is due.
    fn integrate(&mut self, setpoint: &Setpoint, lead: f64, step: f64, [from, to]: [f64; 2]) {
        let robot = &self.robot;
        self.body.set_state(
            &self.tree,
            &robot.sole_to_world,
            robot.angular_rate,
            robot.velocity,
            &robot.angles,
            &robot.rates,
        );

        // What the ground, the payload, pushes and the drives do.
        let base = robot.sole_to_world.translation.vector;
        let floor = |place| self.parameters.unevenness.at(place, self.seed);
        let mut loads = Loads::default();
        for side in Side::BOTH {
            let motion = foot_motion(&self.body, side);
            let foot = &mut self.contact.feet[side.index()];
            loads.add(*foot.press(&motion, &base, floor, &self.parameters.contact, step));
        }
        if self.parameters.payload.mass > 0.0 {
            loads.add(self.parameters.payload.load(&self.body));
        }
        for push in &self.disturbances.pushes {
            let force = push.force_over(from, to);
            if force != Vector3::zeros() {
                loads.add_force(force, push.link, &self.mechanism, &self.body);
            }
        }
        let drive = self.drive.press(setpoint, lead, &robot.angles, &robot.rates, step);

        // What follows.
        let accelerations = self.body.accelerations(&self.tree, &drive.torques, &drive.armature, loads.as_slice());
        self.ground = Side::BOTH.map(|side| {
            let foot = &self.contact.feet[side.index()];
            foot.acted(&self.body.link_acceleration(Mechanism::foot(side)))
        });
        self.motor_torques = drive.acted(&accelerations.joints);
        self.robot.integrate(&accelerations, step);
    }

    /// What arrives of the sensors at this instant.
    pub fn measure(&mut self) -> Measurement {
        let kinematics = self.robot.kinematics(&self.tree);
        let base = self.robot.sole_to_world.translation.vector;
        let feet = Side::BOTH.map(|side| {
            let sole = kinematics.sole_to_world(&self.mechanism, side);
            let about_sole = self.ground[side.index()].about(sole.translation.vector - base);
            let to_sole = sole.rotation.inverse();
            Wrench { force: to_sole * about_sole.force, moment: to_sole * about_sole.moment }
        });

        let bearing = if feet[0].force.z >= feet[1].force.z { Side::Right } else { Side::Left };
        let up = kinematics.sole_to_world(&self.mechanism, bearing).rotation.inverse() * Vector3::z();
        let mut angles = self.robot.angles;
        angles[Joint::FootRoll] = up.y.atan2(up.z);
        angles[Joint::FootPitch] = (-up.x).atan2(up.z);

        let trunk_to_world = kinematics.link_to_world(TRUNK).rotation;
        let (angular_rate, _) = self.robot.link_velocity(&self.mechanism, &kinematics, TRUNK, kinematics.origin[TRUNK]);
        let sensed = self.sensors.sense(&Measurement {
            sample: self.periods,
            angles,
            rates: self.robot.rates,
            feet,
            orientation: self.world_to_level * trunk_to_world,
            angular_rate: trunk_to_world.inverse() * angular_rate,
            currents: self.drive.currents(&self.motor_torques),
        });
        self.arrival.receive(sensed, &self.disturbances.sensor_faults, self.period)
    }
}

fn foot_motion(body: &ArticulatedBody, side: Side) -> FootMotion {
    let link = Mechanism::foot(side);
    FootMotion {
        rotation: body.kinematics.rotation[link],
        origin: body.kinematics.origin[link],
        velocity: body.velocity[link],
    }
}
