//! What several statements share: the committed robot, and random motions with a seed.

#[cfg(feature = "command-line")]
pub mod command_line;
pub mod counting;
pub mod destination;
pub mod fall_trial;
#[cfg(feature = "command-line")]
pub mod kill_trial;
#[cfg(feature = "command-line")]
pub mod paper;
pub mod planted_faults;
pub mod pushing;
#[cfg(feature = "command-line")]
mod python_side;
pub mod replaying;
pub mod sequence;
pub mod velocity;
pub mod walking;

use std::path::PathBuf;

#[cfg(feature = "command-line")]
pub use python_side::python;

use config::Config;
use model::{Joint, JointVector, Mechanism, Motion, PerJoint};
use rand::{Rng, SeedableRng, rngs::StdRng};

/// The repository's root.
pub fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the repository").to_path_buf()
}

/// A folder of `../shared`, where tests find what the repository does not hold, such as public robots. `None` where it
/// does not exist, with a line on stderr that says what was not tested.
pub fn shared(name: &str) -> Option<PathBuf> {
    let folder = repository().parent()?.join("shared").join(name);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("{} does not exist: not tested with it", folder.display());
    None
}

/// `config/mechanism.toml`.
pub fn mechanism() -> Mechanism {
    Mechanism::load(repository().join("config/mechanism.toml")).expect("the committed mechanism loads")
}

/// A generator of random motions; the same seed gives the same.
pub fn random(seed: u64) -> StdRng {
    StdRng::seed_from_u64(seed)
}

/// Values within ±`size`, one per joint.
pub fn random_joints(random: &mut StdRng, size: f64) -> JointVector {
    PerJoint::from_fn(|_| random.random_range(-size..size))
}

/// A motion with angles within ±0.8 rad, rates within ±3 rad/s and accelerations within ±20 rad/s².
pub fn random_motion(random: &mut StdRng) -> Motion {
    Motion {
        angles: random_joints(random, 0.8),
        rates: random_joints(random, 3.0),
        accelerations: random_joints(random, 20.0),
    }
}

/// The same with the two unpowered joints at rest: the floating robot has none.
pub fn without_contact_joints(mut motion: Motion) -> Motion {
    for joint in [Joint::FootRoll, Joint::FootPitch] {
        motion.angles[joint] = 0.0;
        motion.rates[joint] = 0.0;
        motion.accelerations[joint] = 0.0;
    }
    motion
}
