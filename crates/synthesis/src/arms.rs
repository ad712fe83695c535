//! The arms: hanging with bent elbows, swinging against the legs.

use dynamics::{atan2, sin_cos};
use model::{Joint, Mechanism, Motion, Side};
use nalgebra::Vector3;

use crate::SynthesisParameters;
use crate::jet::Jet;

/// Shoulder and elbow of each side.
const ARMS: [[Joint; 2]; 2] = [[Joint::RightShoulder, Joint::RightElbow], [Joint::LeftShoulder, Joint::LeftElbow]];

/// The motion of all joints of the arms that a robot has.
pub(crate) struct ArmSwing {
    /// Each with its mean angle and the swing that it adds at the beginning of the half-step (rad).
    joints: Vec<(Joint, f64, f64)>,
}

impl ArmSwing {
    /// The swing that the parameters define, about where the arms hang.
    pub(crate) fn new(mechanism: &Mechanism, parameters: &SynthesisParameters) -> Self {
        let mut joints = Vec::new();
        for (side, [shoulder, elbow]) in Side::BOTH.into_iter().zip(ARMS) {
            // The right leg supports the robot and goes back, so the right arm comes forward.
            let back = if side == Side::Right { parameters.arm_swing } else { -parameters.arm_swing };
            let [shoulder_hangs, elbow_hangs] = hanging(mechanism, side);
            joints.push((shoulder, shoulder_hangs, -back * lift(mechanism, shoulder)));
            joints.push((elbow, elbow_hangs + parameters.elbow_flexion * lift(mechanism, elbow), 0.0));
        }
        joints.retain(|(joint, ..)| mechanism.has(*joint));
        Self { joints }
    }

    /// Writes the motion of the arms into `motion`. Over two half-steps the shoulders follow a cosine: they are extreme
    /// and at rest at the support change.
    pub(crate) fn apply(&self, progress: Jet, motion: &mut Motion) {
        let cosine = (progress * std::f64::consts::PI).cos();
        for (joint, mean, swing) in &self.joints {
            let Jet { value, rate, acceleration } = cosine * *swing;
            motion.angles[*joint] = mean + value;
            motion.rates[*joint] = rate;
            motion.accelerations[*joint] = acceleration;
        }
    }
}

/// The parameters with the largest swing and flexion, up to theirs, that the ranges of shoulders and elbows permit
/// (whole degrees).
pub(crate) fn within_ranges(mechanism: &Mechanism, parameters: SynthesisParameters) -> SynthesisParameters {
    let [shoulder, elbow] = ARMS[Side::Right.index()];
    let [shoulder_hangs, elbow_hangs] = hanging(mechanism, Side::Right);
    let room = |joint: Joint, angle: f64| {
        let limits = mechanism.links[joint].limits;
        limits.map_or([f64::INFINITY; 2], |limits| [angle - limits.angle_min, limits.angle_max - angle])
    };
    let [below, above] = room(shoulder, shoulder_hangs);
    let [down, up] = room(elbow, elbow_hangs);
    let forward = if lift(mechanism, elbow) > 0.0 { up } else { down };
    let at_most = |angle: f64, room: f64| if angle > room { room.to_degrees().floor().to_radians() } else { angle };
    SynthesisParameters {
        arm_swing: at_most(parameters.arm_swing, below.min(above)),
        elbow_flexion: at_most(parameters.elbow_flexion, forward),
        ..parameters
    }
}

/// The angles of shoulder and elbow at which an arm hangs by its weight while the robot stands straight, each the
/// nearest in its joint's range (rad).
fn hanging(mechanism: &Mechanism, side: Side) -> [f64; 2] {
    let [shoulder, elbow] = ARMS[side.index()];
    let links = &mechanism.links;
    let in_range = |joint: Joint, angle: f64| {
        links[joint].limits.map_or(angle, |limits| angle.clamp(limits.angle_min, limits.angle_max))
    };
    let down = -Vector3::z();
    let upper_arm = if mechanism.has(elbow) { links[elbow].origin } else { links[shoulder].body.com };
    let at_shoulder = in_range(shoulder, towards(&links[shoulder].axis, &upper_arm, &down));
    let down_in_upper_arm = turned(&links[shoulder].axis, &down, -at_shoulder);
    let at_elbow = in_range(elbow, towards(&links[elbow].axis, &links[elbow].body.com, &down_in_upper_arm));
    [at_shoulder, at_elbow]
}

/// The angle about an axis that brings a lever nearest to a direction (rad).
fn towards(axis: &Vector3<f64>, lever: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
    let across = lever - axis * axis.dot(lever);
    atan2(axis.cross(lever).dot(direction), across.dot(direction))
}

/// A vector turned about an axis by an angle (Rodrigues).
fn turned(axis: &Vector3<f64>, vector: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sine, cosine) = sin_cos(angle);
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}

/// The sign of the angle with which a joint lifts a hanging arm forward: against a rotation about y.
fn lift(mechanism: &Mechanism, joint: Joint) -> f64 {
    -mechanism.links[joint].axis.y.signum()
}

#[cfg(test)]
mod tests {
    use config::Config;
    use dynamics::{Kinematics, Tree};
    use model::JointLimits;
    use nalgebra::{Rotation3, Unit};

    use super::*;

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    /// Upper arm and forearm of the right arm, from shoulder and elbow, and the angles, at a progress.
    fn right_arm(mechanism: &Mechanism, progress: f64) -> [Vector3<f64>; 2] {
        let mut motion = Motion::default();
        let at = Jet { value: progress, rate: 1.0, acceleration: 0.0 };
        ArmSwing::new(mechanism, &SynthesisParameters::default()).apply(at, &mut motion);
        let kinematics = Kinematics::fixed_base(&Tree::new(mechanism), &motion.angles);
        let [shoulder, elbow] = ARMS[0];
        let forearm = kinematics.rotation[elbow] * mechanism.links[elbow].body.com;
        [kinematics.origin[elbow] - kinematics.origin[shoulder], forearm]
    }

    /// Degrees forward of straight down.
    fn forward(arm: &Vector3<f64>) -> f64 {
        arm.x.atan2(-arm.z).to_degrees()
    }

    #[test]
    fn an_arm_whose_zero_is_another_posture_swings_as_one_that_hangs_at_zero() {
        let ours = mechanism();
        let mut other = mechanism();
        // the upper arm forward by 50° at zero, the forearm by 90° more
        let [raised, bent] =
            [50.0_f64, 140.0].map(|degrees| Rotation3::from_axis_angle(&Vector3::y_axis(), -degrees.to_radians()));
        for [shoulder, elbow] in ARMS {
            other.links[elbow].origin = raised * other.links[elbow].origin;
            other.links[shoulder].body.com = raised * other.links[shoulder].body.com;
            other.links[elbow].body.com = bent * other.links[elbow].body.com;
            for joint in [shoulder, elbow] {
                other.links[joint].limits = Some(JointLimits { angle_min: -3.0, angle_max: 3.0, rate_max: 10.0 });
            }
        }
        for progress in [0.0, 0.3, 0.5, 1.0] {
            let (ours, other) = (right_arm(&ours, progress), right_arm(&other, progress));
            for (ours, other) in ours.iter().zip(&other) {
                assert!((ours - other).norm() < 1e-9, "{progress}: {ours} {other}");
            }
        }
    }

    #[test]
    fn oblique_shoulders_swing_their_arms_about_straight_down() {
        let mut mechanism = mechanism();
        for (side, [shoulder, _]) in [-1.0, 1.0].into_iter().zip(ARMS) {
            mechanism.links[shoulder].axis = Unit::new_normalize(Vector3::new(0.0, 0.96, 0.28 * side));
        }
        let [ahead, _] = right_arm(&mechanism, 1.0);
        let [behind, _] = right_arm(&mechanism, 0.0);
        assert!((forward(&ahead) + forward(&behind)).abs() < 0.5, "{} {}", forward(&ahead), forward(&behind));
        assert!(forward(&ahead) > 13.0, "{}", forward(&ahead));
    }

    #[test]
    fn ranges_limit_swing_and_flexion() {
        let mut mechanism = mechanism();
        let set = |mechanism: &mut Mechanism, joint: Joint, min: f64, max: f64| {
            let [angle_min, angle_max] = [min, max].map(f64::to_radians);
            mechanism.links[joint].limits = Some(JointLimits { angle_min, angle_max, rate_max: 10.0 });
        };
        let default = SynthesisParameters::default();
        assert_eq!(within_ranges(&mechanism, default), default);
        set(&mut mechanism, Joint::RightShoulder, -100.0, 8.5);
        set(&mut mechanism, Joint::RightElbow, -5.2, 30.0);
        let found = within_ranges(&mechanism, default);
        assert_eq!([found.arm_swing, found.elbow_flexion].map(|angle| angle.to_degrees().round()), [8.0, 5.0]);
        // straight down cannot be reached
        set(&mut mechanism, Joint::RightShoulder, -100.0, -20.0);
        assert_eq!(within_ranges(&mechanism, default).arm_swing, 0.0);
        assert!((forward(&right_arm(&mechanism, 0.5)[0]) - 20.0).abs() < 1e-9);
    }
}
