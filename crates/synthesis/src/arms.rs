//! The arms: hanging with bent elbows, swinging against the legs.

use model::{Joint, Mechanism, Motion};

use crate::Parameters;
use crate::jet::Jet;

/// Puts the arms' part into a motion. Over two half-steps the shoulders follow a cosine: extreme at the swap, where each takes
/// the other's place at rest.
pub fn swing_arms(mechanism: &Mechanism, parameters: &Parameters, progress: Jet, motion: &mut Motion) {
    let forward = (progress * std::f64::consts::PI).cos() * -parameters.arm_swing;
    // The right leg bears and goes back: the right arm comes forward.
    let bent = Jet::constant(parameters.elbow_flexion);
    for (joint, lifted) in [
        (Joint::RightShoulder, forward),
        (Joint::LeftShoulder, -forward),
        (Joint::RightElbow, bent),
        (Joint::LeftElbow, bent),
    ] {
        let Jet { value, rate, acceleration } = lifted * lift(mechanism, joint);
        motion.angles[joint] = value;
        motion.rates[joint] = rate;
        motion.accelerations[joint] = acceleration;
    }
}

/// The sign with which a joint lifts a hanging arm forward: against a rotation about y.
fn lift(mechanism: &Mechanism, joint: Joint) -> f64 {
    -mechanism.links[joint].axis.y.signum()
}
