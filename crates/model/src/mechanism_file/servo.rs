//! The drives' servos: `[servo.legs_and_waist]` and `[servo.arms]`.

use config::Table;

use crate::{Servo, Servos};

/// Smallest and largest stiffness of a servo (N·m/rad): the controller divides by it.
const STIFFNESS: (f64, f64) = (1e-3, 1e6);
/// Largest damping of a servo (N·m·s/rad).
const DAMPING_MAX: f64 = 1e5;

/// Reads the servos; notes where a mechanism without them is to get them from.
pub(super) fn read(root: &Table) -> Servos {
    if !root.has("servo") {
        let must = "must have the tables [servo.legs_and_waist] and [servo.arms]: until 0.1.0 they were in plant.toml";
        root.refuse("servo", must);
        let unknown = Servo { stiffness: f64::NAN, damping: f64::NAN };
        return Servos { legs_and_waist: unknown, arms: unknown };
    }
    let servos = root.table("servo");
    let read = |name| {
        let table = servos.table(name);
        Servo {
            stiffness: table.number("stiffness_n_m_per_rad").between(STIFFNESS.0, STIFFNESS.1),
            damping: table.number("damping_n_m_s_per_rad").between(0.0, DAMPING_MAX),
        }
    };
    Servos { legs_and_waist: read("legs_and_waist"), arms: read("arms") }
}
