//! One control period of the simulated robot.

use dynamics::{ArticulatedBody, Tree, zmp};
use model::{GRAVITY, Joint, JointVector, Mechanism, Motion, Side, Wrench};
use nalgebra::{Isometry3, Vector2, Vector3};

use crate::contact::FootMotion;
use crate::{Drive, GroundContact, Measurement, Parameters, RobotState, Sensors};

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
    mechanism: Mechanism,
    tree: Tree,
    parameters: Parameters,
    period: f64,
    /// The robot itself.
    pub robot: RobotState,
    contact: GroundContact,
    drive: Drive,
    sensors: Sensors,
    body: ArticulatedBody,
    /// Of the ground on each foot at the end of the last step, about the right sole's origin in world axes.
    ground: [Wrench; 2],
    motor_torques: JointVector,
}

/// What nobody on a real robot knows so well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Right and left sole: sole to world.
    pub soles: [Isometry3<f64>; 2],
    /// Vertical force on the right and on the left sole [N].
    pub loads: [f64; 2],
    /// Centre of mass in the world [m].
    pub com: Vector3<f64>,
    /// Where the whole ground reaction acts on the floor, in the world [m]; `None` in the air.
    pub zmp: Option<Vector2<f64>>,
    /// Angle of the trunk's long axis against the vertical [rad].
    pub trunk_tilt: f64,
}

impl Truth {
    /// Whether the robot lies or is past saving: trunk tilted over 60° or its centre of mass below 0.45 m.
    pub fn has_fallen(&self) -> bool {
        !(self.trunk_tilt < std::f64::consts::FRAC_PI_3 && self.com.z > 0.45)
    }
}

impl Plant {
    /// A robot that stands on its right sole and moves as `start` says.
    ///
    /// * `period` – control period [s]
    /// * `seed` – of the sensors' noise
    pub fn new(mechanism: &Mechanism, parameters: &Parameters, start: &Motion, period: f64, seed: u64) -> Self {
        let tree = Tree::new(mechanism);
        let sunk_in = tree.mass * GRAVITY / (4.0 * parameters.contact.stiffness);
        let mut plant = Self {
            robot: RobotState::on_right_foot(start, -sunk_in),
            contact: GroundContact::new(mechanism),
            drive: Drive::new(mechanism, &parameters.servo),
            sensors: Sensors::new(parameters.sensors, seed),
            body: ArticulatedBody::default(),
            ground: [Wrench::ZERO; 2],
            motor_torques: JointVector::ZERO,
            mechanism: mechanism.clone(),
            parameters: parameters.clone(),
            period,
            tree,
        };
        plant.ground[Side::Right.index()].force.z = plant.tree.mass * GRAVITY;
        plant
    }

    /// Moves on by one control period towards a setpoint and tells what is sensed at its end.
    pub fn step(&mut self, setpoint: &Setpoint) -> Measurement {
        let count = self.parameters.steps_per_period;
        let step = self.period / f64::from(count);
        for index in 1..=count {
            let lead = f64::from(count - index) * step;
            self.integrate(setpoint, lead, step);
        }
        self.measure()
    }

    /// One integration step, which ends `lead` seconds before the setpoint is due.
    fn integrate(&mut self, setpoint: &Setpoint, lead: f64, step: f64) {
        let robot = &self.robot;
        self.body.set_state(
            &self.tree,
            &robot.sole_to_world,
            robot.angular_rate,
            robot.velocity,
            &robot.angles,
            &robot.rates,
        );

        // What the ground and the drives do.
        let height = robot.sole_to_world.translation.z;
        let [right, left] = &mut self.contact.feet;
        let motion = Side::BOTH.map(|side| foot_motion(&self.body, side));
        let loads = [
            *right.press(&motion[0], height, &self.parameters.contact, step),
            *left.press(&motion[1], height, &self.parameters.contact, step),
        ];
        let drive = self.drive.press(setpoint, lead, &robot.angles, &robot.rates, step);

        // What follows.
        let accelerations = self.body.accelerations(&self.tree, &drive.torques, &drive.armature, &loads);
        self.ground = Side::BOTH.map(|side| {
            let foot = &self.contact.feet[side.index()];
            foot.acted(&self.body.link_acceleration(Mechanism::foot(side)))
        });
        self.motor_torques = drive.acted(&accelerations.joints);
        self.robot.integrate(&accelerations, step);
    }

    /// What the sensors tell at this instant.
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

        let orientation = kinematics.link_to_world(Joint::WaistRoll).rotation;
        let angular_rate = self.trunk_rate(&kinematics);
        self.sensors.sense(&Measurement {
            angles,
            rates: self.robot.rates,
            feet,
            orientation,
            angular_rate: orientation.inverse() * angular_rate,
            currents: self.drive.currents(&self.motor_torques),
        })
    }

    fn trunk_rate(&self, kinematics: &dynamics::Kinematics) -> Vector3<f64> {
        let mut rate = self.robot.angular_rate;
        let mut link = Some(Joint::WaistRoll);
        while let Some(joint) = link.filter(|joint| joint.is_powered()) {
            rate += kinematics.axis[joint] * self.robot.rates[joint];
            link = self.mechanism.links[joint].parent;
        }
        rate
    }

    /// The truth at this instant.
    pub fn truth(&self) -> Truth {
        let kinematics = self.robot.kinematics(&self.tree);
        let base = self.robot.sole_to_world.translation.vector;
        let total = (self.ground[0] + self.ground[1]).about(Vector3::new(0.0, 0.0, -base.z));
        let up = kinematics.link_to_world(Joint::WaistRoll).rotation * Vector3::z();
        Truth {
            soles: Side::BOTH.map(|side| kinematics.sole_to_world(&self.mechanism, side)),
            loads: self.ground.map(|foot| foot.force.z),
            com: kinematics.com(&self.tree),
            zmp: zmp(&total).map(|point| point + base.xy()),
            trunk_tilt: up.z.clamp(-1.0, 1.0).acos(),
        }
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
