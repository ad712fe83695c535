//! What a tick costs, and the planning of a half-step that ticks share.

use interface::Measurement;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

use config::Config;
use controller::{Controller, Parameters};
use criterion::{Criterion, criterion_group, criterion_main};
use gait::{NominalTable, Start, Walk};
use model::{Mechanism, Wrench};
use nalgebra::{Quaternion, Vector3};
use pattern::{Gait, PatternGenerator};

fn controller(criterion: &mut Criterion) {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../config");
    let mechanism = Mechanism::load(config.join("mechanism.toml")).expect("the committed mechanism loads");
    let table = NominalTable::read_csv(&config.join("nominal_half_step.csv")).expect("the committed nominal loads");
    let table = Arc::new(table);
    let parameters = Parameters::load(config.join("controller.toml")).expect("the committed file loads");
    let mut group = criterion.benchmark_group("controller");

    // Standing in for the robot: the middle of the half-step again and again, always new.
    let mut measurement = Measurement {
        sample: 0,
        angles: table.rows[30].motion.angles,
        rates: table.rows[30].motion.rates,
        feet: [Wrench { force: Vector3::new(0.0, 0.0, 716.0), moment: Vector3::zeros() }, Wrench::ZERO],
        orientation: Quaternion::identity(),
        angular_rate: Vector3::zeros(),
        currents: model::JointVector::ZERO,
        specific_force: Vector3::z() * model::GRAVITY,
        missing: interface::SensorGroups::NONE,
    };
    let mut walking = Controller::new(&mechanism, table.clone(), &parameters, Start::default()).expect("it walks");
    group.bench_function("tick", |bencher| {
        bencher.iter(|| {
            measurement.sample += 1;
            walking.tick(1e-3, Some(black_box(&measurement)))
        });
    });

    let walk = Walk::new(table, &mechanism, &parameters.gait, Start::default()).expect("it walks");
    let mut preview = PatternGenerator::walking(&mechanism, walk);
    group.bench_function("preview_of_a_half_step", |bencher| bencher.iter(|| preview.advance(black_box(0.6))));
    group.finish();
}

criterion_group!(benches, controller);
criterion_main!(benches);
