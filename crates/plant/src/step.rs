//! One control period of the simulated robot.

use dynamics::{ArticulatedBody, Tree, atan2};
use interface::{Measurement, SensorGroups, Setpoint};
use model::{GRAVITY, Joint, JointVector, Mechanism, Motion, Side, Sole, Wrench};
use nalgebra::{UnitQuaternion, Vector3};

use crate::contact::FootMotion;
use crate::loads::Loads;
use crate::mass_error::unlumped_with_mass_error;
use crate::sensor_fault::FaultInjector;
use crate::{
    Disturbances, Drive, Ground, GroundContact, HeldDrives, HeldMotion, PlantParameters, Push, RobotState, Sensors,
};

/// The simulated robot with its ground, drives and sensors.
#[derive(Clone, Debug)]
pub struct Plant {
    /// The mechanism with its errors of mass, its links without the bodies of held ones.
    pub(crate) mechanism: Mechanism,
    pub(crate) tree: Tree,
    /// Height of the centre of mass when the robot stands straight (m).
    pub(crate) standing_height: f64,
    pub(crate) parameters: PlantParameters,
    period: f64,
    /// Number of control periods since the start.
    pub(crate) periods: u64,
    /// Pose and velocity of the robot.
    pub robot: RobotState,
    /// Pushes and sensor faults. More may be added at any time.
    pub disturbances: Disturbances,
    pub(crate) floor: Ground,
    contact: GroundContact,
    drive: Drive,
    pub(crate) held_drives: HeldDrives,
    sensors: Sensors,
    fault_injector: FaultInjector,
    body: ArticulatedBody,
    world_to_level: UnitQuaternion<f64>,
    /// Wrench of the ground on each foot at the end of the last step, about the right sole's origin in world axes.
    pub(crate) ground: [Wrench; 2],
    /// Torques of the motors over the last step, at the joints (N·m).
    pub(crate) motor_torques: JointVector,
    /// Velocity of the trunk's origin in world axes (m/s) at the last measurement, and the period of that.
    trunk_velocity: Option<(Vector3<f64>, u64)>,
}

impl Plant {
    /// A robot that stands on its right sole, with the posture and rates of `start`.
    ///
    /// * `period` – length of a control period (s)
    /// * `seed` – seed of the floor's tiles, the errors of mass and the sensors' noise
    pub fn new(mechanism: &Mechanism, parameters: &PlantParameters, start: &Motion, period: f64, seed: u64) -> Self {
        let robot = unlumped_with_mass_error(mechanism.unlumped(), parameters.mass_error, seed);
        let tree = Tree::with_held(&robot);
        let straight = RobotState::on_right_foot(&Motion::default(), 0.0);
        let standing_height = straight.com(&tree, &straight.kinematics(&tree)).0.z;
        let held = HeldMotion::undeflected(tree.held_count());
        let held_drives = HeldDrives::new(&robot, parameters.servo);
        let mechanism = robot.mechanism;
        let mut plant = Self {
            robot: RobotState { held, ..RobotState::on_right_foot(start, 0.0) },
            disturbances: Disturbances::default(),
            floor: parameters.ground(seed),
            contact: GroundContact::new(&mechanism),
            drive: Drive::new(&mechanism, parameters.servo),
            sensors: Sensors::new(parameters.sensors, seed),
            fault_injector: FaultInjector::default(),
            held_drives,
            body: ArticulatedBody::new(&tree),
            world_to_level: parameters.slope.world_to_level(),
            ground: [Wrench::ZERO; 2],
            motor_torques: JointVector::ZERO,
            trunk_velocity: None,
            standing_height,
            mechanism,
            parameters: parameters.clone(),
            period,
            periods: 0,
            tree,
        };
        plant.body.gravity = parameters.slope.gravity();
        plant.place(start);
        plant
    }

    /// Puts the robot back to where it began, on its right sole with the posture and rates of `motion`: somebody has
    /// lifted it. Time goes on.
    pub fn place(&mut self, motion: &Motion) {
        let weight = (self.tree.mass + self.parameters.payload.mass) * GRAVITY;
        let sunk_in = weight / (Sole::CORNERS as f64 * self.parameters.contact.stiffness);
        let held = HeldMotion::undeflected(self.tree.held_count());
        self.robot = RobotState { held, ..RobotState::on_right_foot(motion, -sunk_in) };
        self.contact = GroundContact::new(&self.mechanism);
        self.ground = [Wrench::ZERO; 2];
        self.ground[Side::Right.index()].force = self.parameters.slope.up() * weight;
        self.motor_torques = JointVector::ZERO;
        self.trunk_velocity = None;
    }

    /// Advances by one control period towards a setpoint, and returns the measurement at its end.
    pub fn step(&mut self, setpoint: &Setpoint) -> Measurement {
        let count = self.parameters.steps_per_period;
        let step = self.period / f64::from(count);
        for index in 1..=count {
            let lead = f64::from(count - index) * step;
            let number = self.periods * u64::from(count) + u64::from(index);
            // A period's last step ends exactly where the next period begins, whatever the number of steps.
            let time = |number: u64| number as f64 / f64::from(count) * self.period;
            self.integrate(setpoint, lead, step, [number - 1, number].map(time));
        }
        self.periods += 1;
        self.measure()
    }

    /// Lets one control period pass in which the robot is held at rest where it is, and returns the measurement at its
    /// end. It moves on from there with the velocities that it has.
    pub fn hold(&mut self) -> Measurement {
        self.periods += 1;
        let at_rest = self.robot.at_rest();
        let moving = std::mem::replace(&mut self.robot, at_rest);
        // What it does when it is let go is no acceleration.
        self.trunk_velocity = None;
        let measurement = self.measure();
        self.trunk_velocity = None;
        self.robot = moving;
        measurement
    }

    /// Number of control periods since the start.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Time since the start (s).
    pub fn time(&self) -> f64 {
        self.periods as f64 * self.period
    }

    /// Length of a control period (s).
    pub(crate) fn period(&self) -> f64 {
        self.period
    }

    /// Sets the number of integration steps of each further control period.
    pub fn set_steps_per_period(&mut self, count: u32) {
        self.parameters.steps_per_period = count;
    }

    /// Adds a push on the trunk that begins now.
    ///
    /// * `impulse` – impulse of the push, in world axes (N·s)
    /// * `duration` – duration of the push (s)
    pub fn push(&mut self, impulse: Vector3<f64>, duration: f64) {
        self.disturbances.pushes.push(Push { link: Mechanism::TRUNK, impulse, start: self.time(), duration });
    }

    /// One integration step of length `step` (s), between two times since the start (s), which ends `lead` seconds
    /// before the setpoint is due.
    fn integrate(&mut self, setpoint: &Setpoint, lead: f64, step: f64, [from, to]: [f64; 2]) {
        let robot = &self.robot;
        self.body.set_held(self.held_drives.over_step(&robot.held, step));
        self.body.set_state(
            &self.tree,
            &robot.sole_to_world,
            robot.angular_rate,
            robot.velocity,
            &robot.angles,
            &robot.rates,
        );

        // Forces of ground, payload, pushes and drives.
        let base = robot.sole_to_world.translation.vector;
        let mut loads = Loads::default();
        for side in Side::BOTH {
            let motion = foot_motion(&self.body, self.mechanism.foot(side));
            let foot = &mut self.contact.feet[side.index()];
            loads.add(*foot.forces_at_step_end(&motion, &base, &self.floor, &self.parameters.contact, step));
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
        let drive = self.drive.torques_at_step_end(setpoint, lead, &robot.angles, &robot.rates, step);

        // Accelerations, and the forces that they lead to.
        let accelerations = self.body.accelerations(&self.tree, &drive.torques, &drive.armature, loads.as_slice());
        self.ground = Side::BOTH.map(|side| {
            let foot = &self.contact.feet[side.index()];
            foot.resolve(&self.body.link_acceleration(self.mechanism.foot(side)))
        });
        self.motor_torques = drive.resolve(&accelerations.joints);
        self.robot.integrate(&accelerations, step);
        self.robot.held.integrate(self.body.held_accelerations(), step);
    }

    /// The measurement that arrives at the controller in this control period.
    pub fn measure(&mut self) -> Measurement {
        let kinematics = self.robot.kinematics(&self.tree);
        let base = self.robot.sole_to_world.translation.vector;
        let feet = Side::BOTH.map(|side| {
            let sole = kinematics.sole_to_world(&self.mechanism, side);
            let about_sole = self.ground[side.index()].about(sole.translation.vector - base);
            let to_sole = sole.rotation.inverse();
            Wrench { force: to_sole * about_sole.force, moment: to_sole * about_sole.moment }
        });

        let support = if feet[0].force.z >= feet[1].force.z { Side::Right } else { Side::Left };
        let sole = kinematics.sole_to_world(&self.mechanism, support);
        let up = sole.rotation.inverse() * self.floor.normal(sole.translation.vector.xy());
        let mut angles = self.robot.angles;
        angles[Joint::FootRoll] = atan2(up.y, up.z);
        angles[Joint::FootPitch] = atan2(-up.x, up.z);

        let trunk_to_world = kinematics.link_to_world(Mechanism::TRUNK).rotation;
        let (angular_rate, trunk_velocity) = self.robot.link_velocity(
            &self.tree,
            &self.mechanism,
            &kinematics,
            Mechanism::TRUNK,
            kinematics.origin[Mechanism::TRUNK],
        );
        // The mean acceleration of the period, whatever engine moves the robot. Who measures again in the same period
        // has moved it by hand.
        let before = self.trunk_velocity.filter(|(_, period)| *period < self.periods);
        let acceleration =
            before.map_or_else(Vector3::zeros, |(velocity, _)| (trunk_velocity - velocity) / self.period);
        self.trunk_velocity = Some((trunk_velocity, self.periods));
        let sensed = self.sensors.sense(&Measurement {
            sample: self.periods,
            angles,
            rates: self.robot.rates,
            feet,
            orientation: (self.world_to_level * trunk_to_world).into_inner(),
            angular_rate: trunk_to_world.inverse() * angular_rate,
            currents: self.drive.currents(&self.motor_torques),
            specific_force: trunk_to_world.inverse() * (acceleration - self.body.gravity),
            missing: SensorGroups::NONE,
        });
        self.fault_injector.receive(sensed, &self.disturbances.sensor_faults, self.period)
    }
}

fn foot_motion(body: &ArticulatedBody, link: Joint) -> FootMotion {
    FootMotion {
        rotation: body.kinematics.rotation[link],
        origin: body.kinematics.origin[link],
        velocity: body.velocity[link],
    }
}
