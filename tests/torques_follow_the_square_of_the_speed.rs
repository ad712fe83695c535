//! Goal: at a constant speed the torques are the table's gravity part plus `c²` times its dynamic part (Hollerbach 1984);
//! while the speed ramps, the inertia of `ċ·q′` comes on top.
//!
//! Method: inverse dynamics of the motion as it is played, to 1e-9 N·m; for the ramp the mass matrix as a second oracle,
//! which is computed another way (composite bodies).

use dynamics::{Kinematics, NewtonEuler, Tree, mass_matrix};
use gait::at_speed;
use halfstep_tests::mechanism;
use halfstep_tests::walking::nominal;
use model::{JointVector, PerJoint};
use nalgebra::SVector;

/// Each row of the table with its progress.
fn rows() -> (std::sync::Arc<gait::NominalTable>, Vec<f64>) {
    let table = nominal();
    let progress = (0..=table.intervals()).map(|row| row as f64 / table.intervals() as f64).collect();
    (table, progress)
}

#[test]
fn at_constant_speed_nothing_needs_to_be_computed_again() {
    let tree = Tree::new(&mechanism());
    let (table, progresses) = rows();
    let mut inverse = NewtonEuler::default();
    for speed in [0.5, 0.6, 0.95, 1.0, 1.2, 1.4] {
        for &progress in &progresses {
            inverse.stand(&tree, &at_speed(&table.at(progress), speed, 0.0));
            let apart = (inverse.torques - table.torques(progress, speed)).max_abs();
            assert!(apart < 1e-9, "progress {progress}, speed {speed}: {apart} N·m");
        }
    }
}

#[test]
fn a_change_of_speed_takes_inertia_times_rate() {
    let tree = Tree::new(&mechanism());
    let (table, progresses) = rows();
    let mut inverse = NewtonEuler::default();
    let mut greatest = 0.0_f64;
    for (speed, speed_rate) in [(0.7, 1.2), (1.0, -0.8), (1.3, 0.5)] {
        for &progress in &progresses {
            let nominal = table.at(progress);
            inverse.stand(&tree, &at_speed(&nominal, speed, speed_rate));
            let mass = mass_matrix(&tree, &Kinematics::standing(&tree, &nominal.angles));
            let inertia = mass * SVector::from(nominal.rates.0) * speed_rate;
            let extra: JointVector = PerJoint(inertia.into());
            let apart = (inverse.torques - table.torques(progress, speed) - extra).max_abs();
            assert!(apart < 1e-9, "progress {progress}, speed {speed}, its rate {speed_rate}: {apart} N·m");
            greatest = greatest.max(extra.max_abs());
        }
    }
    assert!(greatest > 1.0, "the extra term is {greatest} N·m at most: this would not be seen if it were missing");
}
