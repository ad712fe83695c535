//! The arms: hanging with bent elbows, swinging against the legs.

use model::{Joint, Mechanism, Motion};

use crate::SynthesisParameters;
use crate::jet::Jet;

/// Writes the motion of the arms into `motion`. Over two half-steps the shoulders follow a cosine: they are extreme and
/// at rest at the support change.
pub(crate) fn swing_arms(mechanism: &Mechanism, parameters: &SynthesisParameters, progress: Jet, motion: &mut Motion) {
    let forward = (progress * std::f64::consts::PI).cos() * -parameters.arm_swing;
    // The right leg supports the robot and goes back, so the right arm comes forward.
    let bent = Jet::constant(parameters.elbow_flexion);
    for (joint, lifted) in [
        (Joint::RightShoulder, forward),
        (Joint::LeftShoulder, -forward),
        (Joint::RightElbow, bent),
        (Joint::LeftElbow, bent),
    ] {
        if !mechanism.has(joint) {
            continue;
        }
        let Jet { value, rate, acceleration } = lifted * lift(mechanism, joint);
        motion.angles[joint] = value;
        motion.rates[joint] = rate;
        motion.accelerations[joint] = acceleration;
    }
}

/// The sign of the angle with which a joint lifts a hanging arm forward: against a rotation about y.
fn lift(mechanism: &Mechanism, joint: Joint) -> f64 {
    -mechanism.links[joint].axis.y.signum()
}
