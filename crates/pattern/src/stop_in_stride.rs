//! A stop in stride: at a support change, with both soles on the ground, the pelvis is brought to rest.
//!
//! The pelvis' velocity decays as `e^(−ωt)` with the pendulum's own `ω`, so that the ZMP stays at the divergent
//! component of motion of the support change, in the front foot; both soles keep their places, by leg inverse
//! kinematics.

use dynamics::{Kinematics, Tree, solve_leg};
use model::{Joint, Motion, Side};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// A stop on both feet, in support coordinates.
#[derive(Clone, Debug)]
pub(crate) struct StopInStride {
    /// Decay rate of all velocities (1/s).
    decay: f64,
    pelvis: Isometry3<f64>,
    pelvis_rate: Vector3<f64>,
    pelvis_velocity: Vector3<f64>,
    /// Pose of the rear foot.
    rear_foot: Isometry3<f64>,
    motion: Motion,
}

impl StopInStride {
    /// Begins with a motion in which both soles are on the ground and at rest.
    ///
    /// * `pendulum_rate` – `ω` of the inverted pendulum (rad/s)
    pub(crate) fn begin(tree: &Tree, motion: &Motion, pendulum_rate: f64) -> Self {
        let kinematics = Kinematics::fixed_base(tree, &motion.angles);
        let pelvis = kinematics.link_to_world(tree.pelvis());
        let (mut pelvis_rate, mut pelvis_velocity) = (Vector3::zeros(), Vector3::zeros());
        for joint in tree.leg(Side::Right) {
            let spin = kinematics.axis[joint] * motion.rates[joint];
            pelvis_rate += spin;
            pelvis_velocity += spin.cross(&(pelvis.translation.vector - kinematics.origin[joint]));
        }
        Self {
            decay: pendulum_rate,
            pelvis,
            pelvis_rate,
            pelvis_velocity,
            rear_foot: kinematics.link_to_world(tree.foot(Side::Left)),
            motion: *motion,
        }
    }

    /// Moves on by `dt` seconds. A leg that would be overextended stops the pelvis where it is.
    pub(crate) fn advance(&mut self, tree: &Tree, dt: f64) {
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
        let reached = solve_leg(tree, Side::Right, &pelvis, &mut angles)
            .and_then(|()| solve_leg(tree, Side::Left, &self.rear_foot, &mut angles));
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
    }

    /// The commanded motion, in support coordinates.
    pub(crate) fn motion(&self) -> Motion {
        self.motion
    }
}
