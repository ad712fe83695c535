//! What one configuration, one integration step and one control period cost.
//!
//! To beat, on the same kind of machine: Pinocchio's RNEA 2.8 µs, its ABA 5.6 µs, MuJoCo's step with both soles on the
//! ground 17 µs.

use interface::Setpoint;
use std::hint::black_box;
use std::path::Path;

use config::Config;
use criterion::{Criterion, criterion_group, criterion_main};
use dynamics::{
    ArticulatedBody, Batch, Kinematics, LANES, LegSolver, NewtonEuler, Tree, ZmpJacobian, mass_matrix, solve_leg, zmp,
};
use gait::{NominalRow, NominalTable, at_speed};
use model::{JointVector, Mechanism, Motion, PerJoint, Side};
use nalgebra::{Isometry3, Vector3};
use paper::{GroundSplit, LeanAt, PaperLean, zmp_by_newton_euler, zmp_by_speed_law};
use plant::Plant;

fn mechanism() -> Mechanism {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../config/mechanism.toml");
    Mechanism::load(file).expect("the committed mechanism loads")
}

fn nominal() -> NominalTable {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../config/nominal_half_step.csv");
    NominalTable::read_csv(&file).expect("the committed nominal loads")
}

/// Different in every joint, so that nothing is a special case; the ground pushes.
fn motion() -> Motion {
    let spread = |size: f64| PerJoint::from_fn(|joint| size * (f64::from(joint.number()) * 0.7).sin());
    Motion { angles: spread(0.5), rates: spread(2.0), accelerations: spread(-10.0) }
}

fn dynamics(criterion: &mut Criterion) {
    let tree = Tree::new(&mechanism());
    let motion = motion();
    let mut group = criterion.benchmark_group("dynamics");

    let mut inverse = NewtonEuler::default();
    group.bench_function("newton_euler_and_zmp", |bencher| {
        bencher.iter(|| {
            inverse.compute_fixed_base(&tree, black_box(&motion));
            zmp(&inverse.ground)
        });
    });
    group.bench_function("zmp_of_eight_at_once", |bencher| {
        let mut batch = Batch::default();
        bencher.iter(|| {
            for lane in 0..LANES {
                batch.set(lane, black_box(&motion));
            }
            batch.compute(&tree);
            std::array::from_fn::<_, LANES, _>(|lane| zmp(&batch.ground(lane)))
        });
    });
    group.bench_function("zmp_jacobian", |bencher| {
        let mut jacobian = ZmpJacobian::default();
        bencher.iter(|| jacobian.compute_fixed_base(&tree, black_box(&motion)).expect("the ground pushes"));
    });
    group.bench_function("kinematics_and_com", |bencher| {
        let mut kinematics = Kinematics::default();
        bencher.iter(|| {
            kinematics.compute_fixed_base(&tree, black_box(&motion.angles));
            kinematics.com(&tree)
        });
    });
    group.bench_function("mass_matrix", |bencher| {
        let kinematics = Kinematics::fixed_base(&tree, &motion.angles);
        bencher.iter(|| mass_matrix(&tree, black_box(&kinematics)));
    });
    group.bench_function("forward_dynamics", |bencher| {
        let mut body = ArticulatedBody::default();
        let pose = Isometry3::identity();
        bencher.iter(|| {
            let motion = black_box(&motion);
            body.set_state(&tree, &pose, Vector3::x(), Vector3::y(), &motion.angles, &motion.rates);
            body.accelerations(&tree, &motion.accelerations, &JointVector::ZERO, &[])
        });
    });
    group.finish();
}

/// Both legs of a walking posture.
fn leg_ik(criterion: &mut Criterion) {
    let (mechanism, nominal) = (mechanism(), nominal());
    let (tree, solver) = (Tree::new(&mechanism), LegSolver::new(&mechanism));
    let [near, wanted] = [29, 30].map(|row: usize| nominal.rows[row].motion.angles);
    let kinematics = Kinematics::fixed_base(&tree, &wanted);
    let pelvis = kinematics.link_to_world(tree.pelvis());
    let feet = Side::BOTH.map(|side| kinematics.link_to_world(tree.foot(side)));
    let mut group = criterion.benchmark_group("leg_ik");

    group.bench_function("closed_form", |bencher| {
        let mut angles = near;
        bencher.iter(|| {
            for side in Side::BOTH {
                let (pelvis, foot) = black_box((&pelvis, &feet[side.index()]));
                solver.solve(side, pelvis, foot, &mut angles).expect("within reach");
            }
            angles
        });
    });
    group.bench_function("newton", |bencher| {
        bencher.iter(|| {
            let mut angles = black_box(near);
            solve_leg(&tree, Side::Right, &pelvis, &mut angles).expect("within reach");
            solve_leg(&tree, Side::Left, &feet[Side::Left.index()], &mut angles).expect("within reach");
            angles
        });
    });
    group.finish();
}

/// Whole half-steps of 61 instants.
fn balance(criterion: &mut Criterion) {
    let (mechanism, nominal) = (mechanism(), nominal());
    let tree = Tree::new(&mechanism);
    let mut group = criterion.benchmark_group("balance");

    let split = |row: &NominalRow| GroundSplit { gravity: row.ground_gravity, dynamic: row.ground_dynamic };
    let splits: Vec<GroundSplit> = nominal.rows.iter().map(split).collect();
    group.bench_function("zmp_by_speed_law", |bencher| {
        bencher.iter(|| zmp_by_speed_law(&splits, black_box(1.2)).map(|zmp| zmp.x + zmp.y).sum::<f64>());
    });
    let motions: Vec<Motion> = nominal.rows.iter().map(|row| at_speed(&row.motion, 1.2, 0.0)).collect();
    // The same half-step, for comparison: the law costs less than a twentieth.
    group.bench_function("zmp_by_newton_euler", |bencher| {
        bencher.iter(|| zmp_by_newton_euler(&tree, black_box(&motions)).map(|zmp| zmp.x + zmp.y).sum::<f64>());
    });
    group.bench_function("best_lean", |bencher| {
        bencher.iter(|| PaperLean::best(&tree, &mechanism.sole, LeanAt::Ankle, black_box(&motions)));
    });
    group.finish();
}

fn plant(criterion: &mut Criterion) {
    let mechanism = mechanism();
    let mut group = criterion.benchmark_group("plant");
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../config/plant.toml");
    let parameters = plant::PlantParameters::load(file).expect("the committed file loads");
    let one_step = plant::PlantParameters { steps_per_period: 1, ..parameters.clone() };
    let mut standing = Plant::new(&mechanism, &one_step, &Motion::default(), 2.5e-4, 1);
    group.bench_function("step_on_both_soles", |bencher| {
        bencher.iter(|| standing.step(black_box(&Setpoint::default())));
    });
    let mut standing = Plant::new(&mechanism, &parameters, &Motion::default(), 1e-3, 1);
    group.bench_function("control_period_on_both_soles", |bencher| {
        bencher.iter(|| standing.step(black_box(&Setpoint::default())));
    });
    group.finish();
}

criterion_group!(benches, dynamics, leg_ik, balance, plant);
criterion_main!(benches);
