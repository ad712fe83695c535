//! Holding: at a swap, with both soles on the ground, the pelvis is braked and the robot stands still.
//!
//! The pelvis' velocity dies away as e^(−ωt) with the pendulum's own ω, so that the ZMP stays where the divergent component
//! of motion was at the swap, in the front foot; both soles keep their places, by leg inverse kinematics.

use dynamics::{Kinematics, Leg, Tree, solve_leg};
use model::{Joint, Motion, Side};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// A stop on both feet, told in support coordinates.
#[derive(Clone, Debug)]
pub struct Holding {
    /// What is left of each rate falls by this share per second (1/s).
    decay: f64,
    pelvis: Isometry3<f64>,
    pelvis_rate: Vector3<f64>,
    pelvis_velocity: Vector3<f64>,
    /// Where the other foot stands.
    other_foot: Isometry3<f64>,
    motion: Motion,
}

const PELVIS: Joint = Leg(Side::Right).end();
const OTHER_FOOT: Joint = Leg(Side::Left).end();

impl Holding {
    /// Begins to brake a motion at whose instant both soles are on the ground and at rest.
    ///
    /// * `pendulum_rate` – `ω` of the walk (rad/s)
    pub fn begin(tree: &Tree, motion: &Motion, pendulum_rate: f64) -> Self {
        let kinematics = Kinematics::fixed_base(tree, &motion.angles);
        let pelvis = kinematics.link_to_world(PELVIS);
        let (mut pelvis_rate, mut pelvis_velocity) = (Vector3::zeros(), Vector3::zeros());
        for joint in Leg(Side::Right).joints() {
            let spin = kinematics.axis[joint] * motion.rates[joint];
            pelvis_rate += spin;
            pelvis_velocity += spin.cross(&(pelvis.translation.vector - kinematics.origin[joint]));
        }
        Self {
            decay: pendulum_rate,
            pelvis,
            pelvis_rate,
            pelvis_velocity,
            other_foot: kinematics.link_to_world(OTHER_FOOT),
            motion: *motion,
        }
    }

    /// Moves on by `dt` seconds and gives the posture. A leg that would have to stretch too far stops the pelvis there.
    pub fn advance(&mut self, tree: &Tree, dt: f64) -> Motion {
        let remains = 1.0 / (1.0 + self.decay * dt);
        let pelvis_velocity = self.pelvis_velocity * remains;
        let pelvis_rate = self.pelvis_rate * remains;
        let pelvis = Isometry3::from_parts(
            (self.pelvis.translation.vector + pelvis_velocity * dt).into(),
            UnitQuaternion::from_scaled_axis(pelvis_rate * dt) * self.pelvis.rotation,
        );

        let before = self.motion;
        let mut angles = before.angles;
        for joint in Joint::ALL.into_iter().filter(|joint| !joint.is_in_leg()) {
            angles[joint] += before.rates[joint] * remains * dt;
        }
        let reached = solve_leg(tree, Leg(Side::Right), &pelvis, &mut angles)
            .and_then(|()| solve_leg(tree, Leg(Side::Left), &self.other_foot, &mut angles));
        match reached {
            Ok(()) => {
                let rates = (angles - before.angles) * (1.0 / dt);
                let accelerations = (rates - before.rates) * (1.0 / dt);
                self.motion = Motion { angles, rates, accelerations };
                self.pelvis = pelvis;
                self.pelvis_velocity = pelvis_velocity;
                self.pelvis_rate = pelvis_rate;
            }
            Err(_) => {
                self.motion = Motion::at_rest(before.angles);
                self.pelvis_velocity = Vector3::zeros();
                self.pelvis_rate = Vector3::zeros();
            }
        }
        self.motion
    }
}
