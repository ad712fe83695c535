//! Goal: at a constant speed the torques are the table's gravity part plus `c²` times its dynamic part (Hollerbach
//! 1984); while the speed ramps, the inertia of `ċ·q′` comes on top.
//!
//! Method: inverse dynamics of the motion as it is played, to 1e-9 N·m; for the ramp the mass matrix as a second
//! oracle, which is computed another way (composite bodies).

use dynamics::{Kinematics, NewtonEuler, Tree, mass_matrix};
use gait::{NominalRow, at_speed};
use halfstep_tests::mechanism;
use halfstep_tests::walking::nominal;
use model::{JointVector, PerJoint};
use nalgebra::SVector;

/// The torques of a row at another constant speed: the gravity part plus `c²` times the dynamic part.
fn torques(row: &NominalRow, speed: f64) -> JointVector {
    row.torque_gravity + row.torque_dynamic * (speed * speed)
}

#[test]
fn torques_at_constant_speed_come_from_the_table() {
    let tree = Tree::new(&mechanism());
    let table = nominal();
    let mut inverse = NewtonEuler::default();
    for speed in [0.5, 0.6, 0.95, 1.0, 1.2, 1.4] {
        for (number, row) in table.rows.iter().enumerate() {
            inverse.compute_fixed_base(&tree, &at_speed(&row.motion, speed, 0.0));
            let apart = (inverse.torques - torques(row, speed)).max_abs();
            assert!(apart < 1e-9, "row {number}, speed {speed}: {apart} N·m");
        }
    }
}

#[test]
fn a_change_of_speed_adds_inertia_times_its_rate_to_the_torques() {
    let tree = Tree::new(&mechanism());
    let table = nominal();
    let mut inverse = NewtonEuler::default();
    let mut greatest = 0.0_f64;
    for (speed, speed_rate) in [(0.7, 1.2), (1.0, -0.8), (1.3, 0.5)] {
        for (number, row) in table.rows.iter().enumerate() {
            let nominal = row.motion;
            inverse.compute_fixed_base(&tree, &at_speed(&nominal, speed, speed_rate));
            let mass = mass_matrix(&tree, &Kinematics::fixed_base(&tree, &nominal.angles));
            let inertia = mass * SVector::from(nominal.rates.0) * speed_rate;
            let extra: JointVector = PerJoint(inertia.into());
            let apart = (inverse.torques - torques(row, speed) - extra).max_abs();
            assert!(apart < 1e-9, "row {number}, speed {speed}, its rate {speed_rate}: {apart} N·m");
            greatest = greatest.max(extra.max_abs());
        }
    }
    assert!(greatest > 1.0, "the extra term is {greatest} N·m at most: this would not be seen if it were missing");
}
