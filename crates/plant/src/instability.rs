//! A simulation that has left physics: numbers that are not finite, or motions that no robot makes.
//!
//! Integration is linearly implicit and stable in all that occurs; it is lost with settings that are far off, such as a
//! floor of tiles as high as a leg.

use std::fmt;

use model::Joint;

use crate::Plant;

/// Largest rate of a joint or of the right foot (rad/s), and largest speed of that (m/s): hundreds of times those of a
/// fall.
const RATE_MAX: f64 = 1e4;
const SPEED_MAX: f64 = 1e3;

/// What shows that the simulation has become unstable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instability {
    /// Time since the start (s).
    pub time: f64,
    /// The joint that moves impossibly, or on whose link a held one does; `None` for the robot as a whole.
    pub joint: Option<Joint>,
    /// Its rate (rad/s), or the robot's speed (m/s); maybe not finite.
    pub speed: f64,
}

impl Plant {
    /// Whether the simulation has become unstable; from then on its state means nothing.
    pub fn instability(&self) -> Option<Instability> {
        let time = self.time();
        let within = |value: f64, max: f64| value.abs() <= max;
        let joint = self.robot.rates.iter().find(|(joint, rate)| {
            let angle = self.robot.angles[*joint];
            !within(**rate, RATE_MAX) || !angle.is_finite()
        });
        if let Some((joint, rate)) = joint {
            return Some(Instability { time, joint: Some(joint), speed: *rate });
        }
        if let Some(index) = self.robot.held.rates.iter().position(|rate| !within(*rate, RATE_MAX)) {
            return Some(Instability {
                time,
                joint: self.held_drives.mount(index),
                speed: self.robot.held.rate(index),
            });
        }
        let speed = self.robot.velocity.norm();
        let moves = within(speed, SPEED_MAX) && within(self.robot.angular_rate.norm(), RATE_MAX);
        (!moves || !self.robot.is_finite()).then_some(Instability { time, joint: None, speed })
    }

    /// The settings of `plant.toml`, and the servos of `mechanism.toml`, that are likely to have made the simulation
    /// unstable, with their values: those far from the usual ones, else those on which its stability depends.
    pub fn unstable_settings(&self) -> Vec<String> {
        let parameters = &self.parameters;
        let (contact, shares, servos) = (&parameters.contact, &parameters.servo, &self.mechanism.servos);
        let (legs, arms) = (&servos.legs_and_waist, &servos.arms);
        let weight_share = |mass: f64| mass / self.tree.mass;
        // Key, value, and what is usual for a robot of this mass.
        let scale = self.tree.mass / 73.0;
        let settings = [
            ("unevenness.height_m", parameters.unevenness.height, 0.0..=0.02),
            ("payload.mass_kg", parameters.payload.mass, 0.0..=self.tree.mass),
            ("mass_error", parameters.mass_error, 0.0..=0.2),
            ("contact.stiffness_n_per_m", contact.stiffness, 0.0..=1e7 * scale),
            ("contact.damping_n_s_per_m", contact.damping, 0.0..=5e4 * scale),
            ("contact.stiffness_tangential_n_per_m", contact.stiffness_tangential, 0.0..=1e7 * scale),
            ("contact.damping_tangential_n_s_per_m", contact.damping_tangential, 0.0..=5e4 * scale),
            ("contact.friction", contact.friction, 0.0..=2.0),
            ("servo.stiffness_share", shares.stiffness, 0.0..=10.0),
            ("servo.damping_share", shares.damping, 0.0..=10.0),
            ("servo.legs_and_waist.stiffness_n_m_per_rad", legs.stiffness, 0.0..=5e4 * scale),
            ("servo.legs_and_waist.damping_n_m_s_per_rad", legs.damping, 0.0..=2e3 * scale),
            ("servo.arms.stiffness_n_m_per_rad", arms.stiffness, 0.0..=5e3 * scale),
            ("servo.arms.damping_n_m_s_per_rad", arms.damping, 0.0..=2e2 * scale),
        ];
        let unusual = settings.iter().filter(|(_, value, usual)| !usual.contains(value));
        let mut named: Vec<String> = unusual.map(|(key, value, _)| format!("{key} = {value}")).collect();
        let strongest = self.disturbances.pushes.iter().map(|push| push.impulse.norm()).fold(0.0, f64::max);
        if weight_share(strongest) > 5.0 {
            named.push(format!("the push of {strongest} N·s"));
        }
        let (steps, rate) = (parameters.steps_per_period, 1.0 / self.period());
        named.push(format!("steps_per_period = {steps} (more are stabler, here at {rate:.0} Hz)"));
        if named.len() == 1 {
            named.push("[contact] and [servo] (softer is stabler for a light robot)".to_owned());
        }
        named
    }
}

impl fmt::Display for Instability {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "the simulation became unstable at {:.3} s: ", self.time)?;
        match self.joint {
            Some(joint) => write!(out, "{} turns at {:.1e} rad/s", joint.name(), self.speed),
            None => write!(out, "the robot moves at {:.1e} m/s", self.speed),
        }
    }
}
