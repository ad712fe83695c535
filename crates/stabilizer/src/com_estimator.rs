//! Estimates the centre of mass: its place in the body from the joints, the tilt of the body from the inertial
//! measurement unit, its velocity from both and from the foot that bears.

use dynamics::{Kinematics, Tree};
use model::{ComState, Mechanism, Side};
use nalgebra::Vector3;

use crate::support_frame_measurement::SupportFrameMeasurement;
use crate::zmp_estimator::ContactEstimate;

/// The centre of mass as measured. Joints and drives yield, and the sole may tip: the inertial measurement unit shows
/// by how much the whole robot leans beyond what its joints show.
///
/// What is at rest is the point of the bearing foot where the ground pushes: a sole that tips turns about its edge, and
/// a support foot that has not landed yet moves with the leg.
///
/// * `kinematics` – of the measured joint angles
pub fn estimate_com(
    tree: &Tree,
    kinematics: &Kinematics,
    measurement: &SupportFrameMeasurement,
    contact: &ContactEstimate,
) -> ComState {
    let trunk_to_sole = &kinematics.rotation[Mechanism::TRUNK];
    let position = kinematics.com(tree);
    let (velocity, links) = kinematics.com_velocity(tree, &measurement.rates);

    // The rotation that levels: small, and about a horizontal axis.
    let levelling = measurement.up_over_sole(kinematics).cross(&Vector3::z());
    // Without a gyro the sole is taken to lie still.
    let sole_rate = measurement
        .trunk_rate
        .map_or_else(Vector3::zeros, |rate| trunk_to_sole * rate - links[Mechanism::TRUNK].angular);

    let at_rest = contact.zmp.map_or_else(Vector3::zeros, |zmp| zmp.push(0.0));
    let swing_foot = links[tree.foot(Side::Left)].at(&at_rest) * contact.swing_share();
    ComState {
        position: position + levelling.cross(&position),
        velocity: velocity - swing_foot + levelling.cross(&velocity) + sole_rate.cross(&(position - at_rest)),
    }
}

/// Acceleration of the trunk's origin less gravity, levelled, in support axes (m/s²), if it is measured.
///
/// * `kinematics` – of the measured joint angles
pub fn level_specific_force(kinematics: &Kinematics, measurement: &SupportFrameMeasurement) -> Option<Vector3<f64>> {
    let over_sole = kinematics.rotation[Mechanism::TRUNK] * measurement.specific_force?;
    let levelling = measurement.up_over_sole(kinematics).cross(&Vector3::z());
    Some(over_sole + levelling.cross(&over_sole))
}

#[cfg(test)]
mod tests {
    use config::Config;
    use dynamics::Tree;
    use model::{Joint, JointVector, Wrench};
    use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2};

    use super::*;

    /// How far the estimated velocity of the centre of mass is from the true one (m/s), by differences.
    ///
    /// * `pivot`, `turns` – about which point of the ground the right sole turns (m), and how fast (rad/s)
    fn velocity_error(rates: &JointVector, pivot: Vector3<f64>, turns: Vector3<f64>, contact: &ContactEstimate) -> f64 {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let tree = Tree::new(&mechanism);
        let angles =
            JointVector::from_fn(|joint| if joint.is_powered() { 0.1 * (joint.index() as f64).sin() } else { 0.0 });
        // The pose of the right sole a moment `h` after it stood flat.
        let sole = |h: f64| {
            let rotation = UnitQuaternion::from_scaled_axis(turns * h);
            Isometry3::from_parts(Translation3::from(pivot - rotation * pivot), rotation)
        };
        let com = |h: f64| {
            let mut kinematics = Kinematics::default();
            kinematics.compute_floating_base(&tree, &sole(h), &(angles + *rates * h));
            (kinematics.com(&tree), kinematics.rotation[Mechanism::TRUNK])
        };
        let h = 1e-6;
        let [before, now, after] = [-h, 0.0, h].map(com);
        let spin = (after.1 - before.1) * now.1.transpose() / (2.0 * h);
        let trunk_rate = now.1.transpose() * Vector3::new(spin.m32, spin.m13, spin.m21);
        let kinematics = Kinematics::fixed_base(&tree, &angles);
        let measurement = SupportFrameMeasurement {
            angles,
            rates: *rates,
            support_foot: Wrench::ZERO,
            swing_foot: Wrench::ZERO,
            up_in_trunk: now.1.transpose() * Vector3::z(),
            trunk_rate: Some(trunk_rate),
            specific_force: None,
        };
        let estimated = estimate_com(&tree, &kinematics, &measurement, contact).velocity;
        (estimated - (after.0 - before.0) / (2.0 * h)).norm()
    }

    fn contact(zmp: Vector2<f64>, in_contact: [bool; 2]) -> ContactEstimate {
        ContactEstimate { zmp: Some(zmp), loads: [700.0; 2], in_contact, ..ContactEstimate::AIRBORNE }
    }

    /// The oracle: differences of the centre of mass of a robot that turns about the edge of its sole.
    #[test]
    fn a_sole_that_tips_or_spins_on_its_edge_does_not_fake_a_velocity() {
        let rates = JointVector::from_fn(|joint| 0.3 * (joint.index() as f64).cos());
        let rates = JointVector::from_fn(|joint| if joint.is_powered() { rates[joint] } else { 0.0 });
        let toe = Vector2::new(0.21, -0.04);
        for turns in [Vector3::new(0.5, 0.0, 0.0), Vector3::new(0.0, 0.8, 0.0), Vector3::new(0.1, -0.3, 1.5)] {
            let error = velocity_error(&rates, toe.push(0.0), turns, &contact(toe, [true, false]));
            assert!(error < 1e-6, "{error} m/s");
        }
    }

    /// The oracle: the left leg swings a support foot that is still in the air.
    #[test]
    fn a_foot_that_bears_is_at_rest_though_it_is_not_the_support_foot() {
        let mechanism = Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap();
        let tree = Tree::new(&mechanism);
        let rates = JointVector::unit(Joint::LeftHipPitch);
        let angles = JointVector::ZERO;
        let kinematics = Kinematics::fixed_base(&tree, &angles);
        let left = kinematics.sole_to_world(&mechanism, Side::Left).translation.vector;
        let measurement = SupportFrameMeasurement {
            angles,
            rates,
            support_foot: Wrench::ZERO,
            swing_foot: Wrench::ZERO,
            up_in_trunk: Vector3::z(),
            // The trunk, and with it the other leg, turns about the left hip, as the left foot is at rest.
            trunk_rate: Some(-(kinematics.com_velocity(&tree, &rates).1[tree.foot(Side::Left)].angular)),
            specific_force: None,
        };
        let estimated = estimate_com(&tree, &kinematics, &measurement, &contact(left.xy(), [false, true])).velocity;
        let h = 1e-6;
        let seen_from_left = |h: f64| {
            let kinematics = Kinematics::fixed_base(&tree, &(angles + rates * h));
            let sole = kinematics.sole_to_world(&mechanism, Side::Left);
            sole.inverse_transform_point(&kinematics.com(&tree).into()).coords
        };
        let expected = (seen_from_left(h) - seen_from_left(-h)) / (2.0 * h);
        assert!((estimated - expected).norm() < 1e-6, "{estimated} instead of {expected}");
    }
}
