//! Goal: half-steps follow each other without a jump, and the swing foot neither scuffs nor stamps.
//! Method: the table's end against its mirrored start, and the kinematics of the swing sole.

mod common;
#[path = "common/half_steps.rs"]
mod half_steps;

use dynamics::{Kinematics, Tree};
use half_steps::all;
use model::{JointVector, Mirror, Mirrored, Side};
use nalgebra::Vector3;
use synthesis::SynthesisParameters;

/// (rad and rad/s)
const SWAP_MAX: f64 = 1e-6;

#[test]
fn angles_and_rates_of_the_nominal_are_continuous_across_the_support_change() {
    for (label, mechanism, synthesis) in all() {
        let mirror = Mirror::new(&mechanism).expect("a symmetric robot");
        let (first, last) = (&synthesis.table.rows[0].motion, &synthesis.table.rows[60].motion);
        let next = last.mirrored(&mirror);
        assert!((next.angles - first.angles).max_abs() <= SWAP_MAX, "{label}: angles jump");
        assert!((next.rates - first.rates).max_abs() <= SWAP_MAX, "{label}: rates jump");
        assert_eq!(synthesis.table.check(&mirror), Ok(()), "{label}");
    }
}

#[test]
fn centre_of_mass_ends_over_the_next_foot_as_it_began_over_this_one() {
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let rows = &synthesis.table.rows;
        let [first, last] = [&rows[0], &rows[60]].map(|row| Kinematics::fixed_base(&tree, &row.motion.angles));
        let next_foot = last.sole_to_world(&mechanism, Side::Left).translation.vector;
        let over_next = last.com(&tree) - next_foot;
        let mirrored = Vector3::new(over_next.x, -over_next.y, over_next.z);
        assert!((mirrored - first.com(&tree)).amax() < 1e-9, "{label}: {mirrored} against {}", first.com(&tree));
    }
}

#[test]
fn swing_sole_stays_level_and_above_the_ground() {
    let clearance = SynthesisParameters::default().clearance;
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let mut highest = 0.0_f64;
        for step in 0..=1200 {
            let motion = synthesis.table.at(f64::from(step) / 1200.0);
            let kinematics = Kinematics::fixed_base(&tree, &motion.angles);
            let sole = kinematics.sole_to_world(&mechanism, Side::Left);
            let pelvis = kinematics.link_to_world(model::Joint::RightHipRoll);
            assert!(sole.rotation.angle() < 1e-6 && pelvis.rotation.angle() < 1e-6, "{label}, {step}: not level");
            assert!(sole.translation.z > -1e-7, "{label}, {step}: {} m", sole.translation.z);
            highest = highest.max(sole.translation.z);
        }
        assert!((highest - clearance).abs() < 1e-4, "{label}: lifts {highest} m");
    }
}

#[test]
fn swing_sole_goes_from_step_to_step_and_rests_at_both_ends() {
    let SynthesisParameters { step_length, .. } = SynthesisParameters::default();
    for (label, mechanism, synthesis) in all() {
        let tree = Tree::new(&mechanism);
        let width = mechanism.links[model::Joint::LeftHipRoll].origin.y;
        let sole_at = |angles: &JointVector| {
            Kinematics::fixed_base(&tree, angles).sole_to_world(&mechanism, Side::Left).translation.vector
        };
        for (row, x) in [(0, -step_length), (60, step_length)] {
            let motion = &synthesis.table.rows[row].motion;
            let place = sole_at(&motion.angles);
            assert!((place - Vector3::new(x, width, 0.0)).amax() < 1e-9, "{label}, row {row}: {place}");

            // The path along rates and accelerations, differenced.
            let h = 1e-4;
            let along = |time: f64| {
                sole_at(&(motion.angles + motion.rates * time + motion.accelerations * (time * time / 2.0)))
            };
            let velocity = (along(h) - along(-h)) / (2.0 * h);
            let acceleration = (along(h) + along(-h) - place * 2.0) / (h * h);
            assert!(velocity.amax() < 1e-5, "{label}, row {row}: {velocity} m/s");
            assert!(acceleration.amax() < 1e-4, "{label}, row {row}: {acceleration} m/s²");
        }
    }
}
