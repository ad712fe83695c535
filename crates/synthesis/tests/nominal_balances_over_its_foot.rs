//! Goal: the ground reaction of the nominal half-step stays in O, and the torques are those of physics.
//! Method: Newton–Euler on the table's motion, at the rows and between them, for both mechanisms and both leg patterns.

mod common;
#[path = "common/half_steps.rs"]
mod half_steps;

use common::mechanism;
use dynamics::{Kinematics, NewtonEuler, Tree, wrench_at_speed, zmp, zmp_at_speed};
use half_steps::{all, nominal};
use model::{GRAVITY, Motion};
use nalgebra::Vector2;
use synthesis::{LegPattern, SynthesisParameters};

/// (m)
const RESIDUAL_MAX: f64 = 0.2e-3;

#[test]
fn zmp_stays_in_o_at_the_rows_and_between_them() {
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let mut newton_euler = NewtonEuler::default();
        let mut distance_at = |motion: &Motion| {
            newton_euler.compute_fixed_base(&tree, motion);
            zmp(&newton_euler.ground).expect("the robot weighs on the ground").norm()
        };
        let table = &synthesis.table;
        let rows = table.rows.iter().map(|row| distance_at(&row.motion)).fold(0.0, f64::max);
        let between = (0..=6000).map(|step| distance_at(&table.at(f64::from(step) / 6000.0))).fold(0.0, f64::max);
        println!("{label}: {:.4} mm at the rows, {:.4} mm between", rows * 1e3, between * 1e3);
        assert!(rows <= RESIDUAL_MAX && between <= RESIDUAL_MAX, "{label}: {rows} m at the rows, {between} m between");
        assert!((rows - synthesis.report.residual).abs() < 1e-9, "{label}: the report says something else");
    }
}

#[test]
fn gravity_and_dynamic_parts_add_up_to_inverse_dynamics() {
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let mut newton_euler = NewtonEuler::default();
        for row in &synthesis.table.rows {
            newton_euler.compute_fixed_base(&tree, &row.motion);
            let torques = row.torque_gravity + row.torque_dynamic - newton_euler.torques;
            let ground = row.ground_gravity + row.ground_dynamic - newton_euler.ground;
            assert!(torques.max_abs() < 1e-10, "{label}: {torques:?}");
            assert!(ground.force.amax().max(ground.moment.amax()) < 1e-10, "{label}: {ground:?}");
            assert!(
                (row.ground_gravity.force.z - tree.mass * GRAVITY).abs() < 1e-9,
                "{label}: gravity part is the weight"
            );
        }
    }
}

/// DESIGN §4.2. With M(1) = r about O, which is zero but for the residual, M(c) = (1 − c²)·M_gravity + c²·r: the
/// formula holds to rounding once the residual's share, c²·Fz(1)/Fz(c) of it, is added.
#[test]
fn speed_scales_the_dynamic_part_by_its_square() {
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let mut newton_euler = NewtonEuler::default();
        for speed in [0.6, 0.8, 1.0, 1.1, 1.2, 1.4] {
            for row in &synthesis.table.rows {
                let Motion { angles, rates, accelerations } = row.motion;
                let scaled = Motion { angles, rates: rates * speed, accelerations: accelerations * (speed * speed) };
                newton_euler.compute_fixed_base(&tree, &scaled);
                let found = newton_euler.ground;

                let expected = wrench_at_speed(&row.ground_gravity, &row.ground_dynamic, speed);
                let difference = found - expected;
                assert!(
                    difference.force.amax().max(difference.moment.amax()) < 1e-9,
                    "{label}, c {speed}: {difference:?}"
                );

                let com = Kinematics::fixed_base(&tree, &angles).com(&tree).xy();
                let nominal = row.ground_gravity + row.ground_dynamic;
                let residual = zmp(&nominal).expect("weight") * (speed * speed * nominal.force.z / found.force.z);
                let expected = zmp_at_speed(com, tree.mass, row.ground_dynamic.force.z, speed) + residual;
                let found = zmp(&found).expect("weight");
                assert!((found - expected).amax() < 1e-9, "{label}, c {speed}: {found} against {expected}");
            }
        }
    }
}

/// Oracle: the linear inverted pendulum over O between the same ends (Kajita 2001). The robot differs by what its
/// links' angular momentum takes.
#[test]
fn centre_of_mass_moves_like_an_inverted_pendulum() {
    let mechanism = mechanism("mechanism.toml");
    let synthesis = nominal(&mechanism, &LegPattern::Pendulum);
    let tree = Tree::new(&mechanism);
    let SynthesisParameters { step_length, duration, .. } = SynthesisParameters::default();
    let half_width = mechanism.links[model::Joint::LeftHipRoll].origin.y / 2.0;
    let rows = &synthesis.table.rows;
    let mut worst = 0.0_f64;
    for (index, row) in rows.iter().enumerate() {
        let com = Kinematics::fixed_base(&tree, &row.motion.angles).com(&tree);
        let rate = (GRAVITY / com.z).sqrt();
        let time = duration * (index as f64 / (rows.len() - 1) as f64 - 0.5);
        let end = rate * duration / 2.0;
        let pendulum = Vector2::new(
            step_length / 2.0 * (rate * time).sinh() / end.sinh(),
            half_width * (rate * time).cosh() / end.cosh(),
        );
        worst = worst.max((com.xy() - pendulum).amax());
    }
    println!("largest distance from the pendulum: {:.2} mm", worst * 1e3);
    assert!(worst < 0.01, "{worst} m");
}

/// A statement about how the walk looks: people walk upright.
#[test]
fn the_trunk_of_the_nominal_is_nearly_upright_and_still() {
    let report = nominal(&mechanism("mechanism.toml"), &LegPattern::Pendulum).report;
    for (min, max) in [report.trunk_pitch, report.trunk_roll] {
        assert!(min.abs().max(max.abs()) < 4_f64.to_radians(), "{:.2}° to {:.2}°", min.to_degrees(), max.to_degrees());
        assert!(max - min < 3_f64.to_radians());
    }
}

/// The joint limits must leave room for speed to 1.4 and a step extension of 10°, half of it in each hip and ankle.
#[test]
fn joint_limits_leave_room_for_modifications_of_the_nominal() {
    let mechanism = mechanism("mechanism.toml");
    let synthesis = nominal(&mechanism, &LegPattern::Pendulum);
    assert!(synthesis.report.knee_flexion_min > 25_f64.to_radians(), "knees stay bent");
    let extension = 5_f64.to_radians();
    use model::Joint::*;
    for row in &synthesis.table.rows {
        for joint in [RightAnklePitch, RightHipPitch, LeftHipPitch, LeftAnklePitch] {
            let limits = mechanism.links[joint].limits.expect("a powered joint");
            let angle = row.motion.angles[joint];
            assert!(
                angle - extension > limits.angle_min && angle + extension < limits.angle_max,
                "{}: {:.1}°",
                joint.name(),
                angle.to_degrees()
            );
        }
        for (joint, rate) in row.motion.rates.iter() {
            let rate_max = mechanism.links[joint].limits.map_or(f64::INFINITY, |limits| limits.rate_max);
            assert!(rate.abs() * 1.4 < rate_max, "{}: {:.0} °/s", joint.name(), rate.to_degrees());
        }
    }
}
