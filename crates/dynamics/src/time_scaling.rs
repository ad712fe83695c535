//! Time scaling: the same path at another speed (Hollerbach 1984; DESIGN §4.2).
//!
//! With q(t) = q_n(ct) the dynamic parts of torque and wrench grow with c², the gravity parts stay: nothing is
//! recomputed.

use model::{GRAVITY, Wrench};
use nalgebra::Vector2;

/// The ground wrench of a motion at a constant speed factor `c`, from its two parts at nominal speed.
#[inline]
pub fn wrench_at_speed(gravity: &Wrench, dynamic: &Wrench, speed: f64) -> Wrench {
    *gravity + *dynamic * (speed * speed)
}

/// ZMP at a constant speed factor `c`, relative to O (m), of a half-step whose ZMP at c = 1 stays in O:
/// `(1 − c²)·M·g·COM_xy / (M·g + c²·Fz_dyn)`. An oracle for tests, independent of inverse dynamics.
///
/// * `com` – projection of the centre of mass at that progress, relative to O (m)
/// * `mass` – mass of the robot (kg)
/// * `dynamic_force_z` – vertical force of the motion at nominal speed (N)
#[inline]
pub fn zmp_at_speed(com: Vector2<f64>, mass: f64, dynamic_force_z: f64, speed: f64) -> Vector2<f64> {
    let weight = mass * GRAVITY;
    let c2 = speed * speed;
    com * ((1.0 - c2) * weight / (weight + c2 * dynamic_force_z))
}
