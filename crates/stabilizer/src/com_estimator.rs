//! Estimates the centre of mass: its place in the body from the joints, the tilt of the body from the inertial
//! measurement unit.

use dynamics::{Kinematics, Tree};
use model::{ComState, Mechanism};
use nalgebra::Vector3;

use crate::support_frame_measurement::SupportFrameMeasurement;

/// The centre of mass as measured. Joints and drives yield, and the sole may tip: the inertial measurement unit shows
/// by how much the whole robot leans beyond what its joints show.
///
/// * `kinematics` – of the measured joint angles
pub fn estimate_com(tree: &Tree, kinematics: &Kinematics, measurement: &SupportFrameMeasurement) -> ComState {
    let trunk_to_sole = &kinematics.rotation[Mechanism::TRUNK];
    let position = kinematics.com(tree);
    let (velocity, link_rates) = kinematics.com_velocity(tree, &measurement.rates);

    // The rotation that levels: small, and about a horizontal axis.
    let levelling = measurement.up_over_sole(kinematics).cross(&Vector3::z());
    let sole_rate = trunk_to_sole * measurement.trunk_rate - link_rates[Mechanism::TRUNK];
    ComState {
        position: position + levelling.cross(&position),
        velocity: velocity + levelling.cross(&velocity) + sole_rate.cross(&position),
    }
}
