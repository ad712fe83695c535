//! Goal: the mirror at a support change can be undone (DESIGN §4.5).
//!
//! Method: mirror seeded motions twice, bit for bit; limits are symmetric.

use config::Config;
use model::{Joint, Mechanism, Mirror, Mirrored, Motion, PerJoint};

/// A value per joint that has nothing to do with any other: fractions of multiples of the golden ratio.
fn scattered(seed: f64) -> PerJoint<f64> {
    PerJoint::from_fn(|joint| ((f64::from(joint.number()) + seed) * 1.618_033_988_749_895).fract() - 0.5)
}

fn mechanisms() -> [Mechanism; 2] {
    ["mechanism.toml", "mechanism_other_reading.toml"].map(|file| {
        let path = format!("{}/../../config/{file}", env!("CARGO_MANIFEST_DIR"));
        Mechanism::load(path).unwrap_or_else(|errors| panic!("{errors}"))
    })
}

#[test]
fn a_motion_mirrored_twice_keeps_its_bits() {
    for mechanism in mechanisms() {
        let mirror = Mirror::new(&mechanism).expect("symmetric");
        for seed in 0..100 {
            let seed = f64::from(seed) * 20.0;
            let motion =
                Motion { angles: scattered(seed), rates: scattered(seed + 0.3), accelerations: scattered(seed + 0.7) };
            assert_ne!(motion.mirrored(&mirror), motion);
            assert_eq!(motion.mirrored(&mirror).mirrored(&mirror), motion);
        }
    }
}

#[test]
fn the_limits_of_a_joint_are_the_mirrored_limits_of_its_partner() {
    for mechanism in mechanisms() {
        let mirror = Mirror::new(&mechanism).expect("symmetric");
        let limit = |pick: fn(&model::JointLimits) -> f64| {
            PerJoint::from_fn(|joint| mechanism.links[joint].limits.as_ref().map_or(0.0, pick))
        };
        let (min, max) = (limit(|limits| limits.angle_min), limit(|limits| limits.angle_max));
        let (mirrored_min, mirrored_max) = (mirror.apply(&min), mirror.apply(&max));
        for joint in Joint::ALL {
            let [a, b] = [mirrored_min[joint], mirrored_max[joint]];
            assert_eq!([a.min(b), a.max(b)], [min[joint], max[joint]], "{}", joint.name());
        }
    }
}
