//! Goal: the ZMP of a half-step by the `c²` law is the ZMP by Newton–Euler, to 1e-9 m, for the nominal and for any
//! other path, at any constant speed.
//!
//! Method: the table's own wrenches, and splits of random motions, against inverse dynamics of the same motions played
//! at speed; the closed form for ZMP ≡ O as a third way.

use dynamics::{Kinematics, NewtonEuler, Tree, zmp_at_speed};
use gait::at_speed;
use halfstep_tests::walking::nominal;
use halfstep_tests::{mechanism, random, random_motion};
use model::Motion;
use paper::{GroundSplit, zmp_by_newton_euler, zmp_by_speed_law};

const SPEEDS: [f64; 6] = [0.3, 0.6, 0.95, 1.0, 1.2, 1.4];

/// The wrenches that the nominal table holds.
fn nominal_splits() -> Vec<GroundSplit> {
    let split = |row: &gait::NominalRow| GroundSplit { gravity: row.ground_gravity, dynamic: row.ground_dynamic };
    nominal().rows.iter().map(split).collect()
}

#[test]
fn zmp_from_the_table_agrees_with_newton_euler_at_every_speed() {
    let (tree, table) = (Tree::new(&mechanism()), nominal());
    for speed in SPEEDS {
        let motions: Vec<Motion> = table.rows.iter().map(|row| at_speed(&row.motion, speed, 0.0)).collect();
        let by_law = zmp_by_speed_law(&nominal_splits(), speed).collect::<Vec<_>>();
        for (row, (computed, by_law)) in zmp_by_newton_euler(&tree, &motions).zip(by_law).enumerate() {
            assert!(
                (computed - by_law).norm() < 1e-9,
                "row {row} at speed {speed}: {computed:?}, by the law {by_law:?}"
            );
        }
    }
}

#[test]
fn zmp_from_the_split_of_any_motion_agrees_with_newton_euler() {
    let (tree, mut random) = (Tree::new(&mechanism()), random(3));
    let mut inverse = NewtonEuler::default();
    for _ in 0..200 {
        let motion = random_motion(&mut random);
        let split = GroundSplit::of_motion(&mut inverse, &tree, &motion);
        for speed in SPEEDS {
            let computed = zmp_by_newton_euler(&tree, &[at_speed(&motion, speed, 0.0)]).next().unwrap();
            let by_law = split.zmp(speed);
            // A hard random motion may lift the robot, and near that its ZMP is far away.
            let near = computed.norm() < 10.0;
            assert!(
                !near || (computed - by_law).norm() < 1e-9,
                "at speed {speed}: {computed:?}, by the law {by_law:?}"
            );
        }
    }
}

/// The third way needs ZMP ≡ O, which the nominal has to a fraction of a millimetre.
#[test]
fn zmp_in_closed_form_agrees_as_far_as_the_nominal_balances() {
    let (mechanism, table) = (mechanism(), nominal());
    let tree = Tree::new(&mechanism);
    let splits = nominal_splits();
    let residual = splits.iter().map(|split| split.zmp(1.0).norm()).fold(0.0, f64::max);
    for speed in SPEEDS {
        for (row, split) in table.rows.iter().zip(&splits) {
            let com = Kinematics::fixed_base(&tree, &row.motion.angles).com(&tree).xy();
            let closed = zmp_at_speed(com, mechanism.mass(), row.ground_dynamic.force.z, speed);
            let apart = (split.zmp(speed) - closed).norm();
            assert!(apart <= 3.0 * residual, "at speed {speed}: {apart} m apart, residual {residual} m");
        }
    }
}
