//! A half-step that suits a robot: the default in its proportions, changed as little as its joints and drives demand.

use gait::NominalRow;
use model::{Joint, Mechanism};

use crate::arms;
use crate::{Balance, LegPattern, Synthesis, SynthesisError, SynthesisParameters, synthesize};

/// Largest share of a torque or rate limit that a half-step may need: the rest is for requests and for feedback.
const LOAD_MAX: f64 = 0.8;
/// Changes that are tried, from the smallest on: shares of the leg by which the hips are higher, factors of step
/// length, duration, and pelvis sway.
const HIPS_HIGHER: [f64; 3] = [0.0, 0.01, 0.02];
const SHORTER: [f64; 4] = [1.0, 0.85, 0.7, 0.5];
const LONGER_LASTING: [f64; 3] = [1.0, 1.15, 1.3];
const SWAY: [f64; 3] = [1.0, 0.5, 0.0];
/// Shares of the arms' swing that are tried, the largest that shoulders and elbows can drive.
const ARM_SWING: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// Shares of the leg that the pelvis is tried behind the middle between the feet, so that the trunk is upright.
const SETBACK_STEP: f64 = 0.02;
/// A trunk that leans by no more counts as upright (rad).
const UPRIGHT: f64 = 0.02;

/// A half-step for a robot.
#[derive(Clone, Debug)]
pub struct FittedHalfStep {
    /// Its parameters.
    pub parameters: SynthesisParameters,
    /// The half-step.
    pub synthesis: Synthesis,
    /// Largest share of a limit that it needs, and the joint (-).
    pub load: (f64, Joint),
}

/// Finds a half-step for a robot. Of those that need no more than 80 % of any limit it is the nearest to the default;
/// if there is none, the one that needs least.
///
/// # Errors
/// The default's [`SynthesisError`] if no half-step within the joints' ranges is found.
pub fn fit_half_step(mechanism: &Mechanism) -> Result<FittedHalfStep, SynthesisError> {
    let in_proportion = arms::within_ranges(mechanism, SynthesisParameters::for_robot(mechanism));
    let default = upright(mechanism, with_driven_arms(mechanism, in_proportion));
    let first = try_out(mechanism, default);
    let mut candidates = Vec::new();
    let is_trunk = matches!(default.balance.of(mechanism), Ok(Balance::Trunk));
    for (distance, changed) in changes(mechanism, &default, is_trunk) {
        candidates.push((distance, changed));
    }
    candidates.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let mut best: Option<FittedHalfStep> = None;
    for (_, parameters) in candidates {
        let Ok(tried) = try_out(mechanism, parameters) else { continue };
        if tried.load.0 <= LOAD_MAX {
            return Ok(tried);
        }
        if best.as_ref().is_none_or(|best| tried.load.0 < best.load.0) {
            best = Some(tried);
        }
    }
    best.map_or(first, Ok)
}

/// The parameters with the arms' swing so small that shoulders and elbows can drive it.
fn with_driven_arms(mechanism: &Mechanism, parameters: SynthesisParameters) -> SynthesisParameters {
    let swung = ARM_SWING.map(|share| SynthesisParameters { arm_swing: share * parameters.arm_swing, ..parameters });
    let is_driven = |tried: &SynthesisParameters| match synthesize_free(mechanism, tried) {
        Ok(found) => load(mechanism, &found.table.rows, Joint::is_in_arm).0 <= LOAD_MAX,
        Err(SynthesisError::RateTooHigh { joint, .. }) => !joint.is_in_arm(),
        Err(_) => true,
    };
    swung.into_iter().find(is_driven).unwrap_or(SynthesisParameters { arm_swing: 0.0, ..parameters })
}

/// Changed parameters, each with how far it is from the default.
fn changes(
    mechanism: &Mechanism,
    default: &SynthesisParameters,
    is_trunk: bool,
) -> impl Iterator<Item = (f64, SynthesisParameters)> {
    let leg = default.hip_height - mechanism.sole.ankle_height;
    let sways = if is_trunk { SWAY.len() } else { 1 };
    let indices = (0..HIPS_HIGHER.len()).flat_map(move |hips| {
        (0..SHORTER.len()).flat_map(move |shorter| {
            (0..LONGER_LASTING.len()).flat_map(move |longer| (0..sways).map(move |sway| [hips, shorter, longer, sway]))
        })
    });
    let default = *default;
    indices.map(move |[hips, shorter, longer, sway]| {
        let parameters = SynthesisParameters {
            hip_height: rounded(default.hip_height + HIPS_HIGHER[hips] * leg),
            step_length: rounded(default.step_length * SHORTER[shorter]),
            duration: rounded(default.duration * LONGER_LASTING[longer]),
            pelvis_sway: rounded(default.pelvis_sway * SWAY[sway]),
            ..default
        };
        // A trunk that sways costs nothing, a short or slow step is a slow walk.
        (0.5 * sway as f64 + hips as f64 + 2.0 * shorter as f64 + 1.5 * longer as f64, parameters)
    })
}

/// The parameters with the pelvis set back so far that the trunk is upright on the average.
fn upright(mechanism: &Mechanism, parameters: SynthesisParameters) -> SynthesisParameters {
    let lean = |setback: f64| {
        let parameters = SynthesisParameters { pelvis_setback: setback, ..parameters };
        let (least, most) = synthesize_free(mechanism, &parameters)?.report.trunk_pitch;
        Ok::<f64, SynthesisError>((least + most) / 2.0)
    };
    let step = SETBACK_STEP * (parameters.hip_height - mechanism.sole.ankle_height);
    let mut setback = parameters.pelvis_setback;
    // The lean is nearly linear in the setback.
    for _ in 0..3 {
        let (Ok(here), Ok(there)) = (lean(setback), lean(setback + step)) else { break };
        if here.abs() < UPRIGHT || here == there {
            break;
        }
        let next = setback + here * step / (here - there);
        let max = 4.0 * step;
        setback = next.clamp(-max, max);
    }
    SynthesisParameters { pelvis_setback: rounded(setback), ..parameters }
}

fn synthesize_free(mechanism: &Mechanism, parameters: &SynthesisParameters) -> Result<Synthesis, SynthesisError> {
    synthesize(mechanism, &LegPattern::Pendulum, parameters, "halfstep import")
}

fn try_out(mechanism: &Mechanism, parameters: SynthesisParameters) -> Result<FittedHalfStep, SynthesisError> {
    let synthesis = synthesize_free(mechanism, &parameters)?;
    let load = load(mechanism, &synthesis.table.rows, |_| true);
    Ok(FittedHalfStep { parameters, synthesis, load })
}

/// The largest share of a torque or rate limit that the rows need of some joints, and at which of them.
fn load(mechanism: &Mechanism, rows: &[NominalRow], of: impl Fn(Joint) -> bool) -> (f64, Joint) {
    let mut largest = (0.0, Joint::FootRoll);
    for row in rows {
        for (joint, link) in mechanism.links.iter().filter(|(joint, _)| of(*joint)) {
            let (Some(limits), Some(motor)) = (link.limits, link.motor) else { continue };
            let rotor = motor.reflected_inertia() * row.motion.accelerations[joint];
            let torque = row.torque_gravity[joint] + row.torque_dynamic[joint] + rotor;
            let rate = row.motion.rates[joint];
            let voltage = motor
                .dc()
                .map_or(0.0, |dc| (torque + motor.back_emf_damping() * rate) / dc.torque_per_volt() / dc.voltage_max);
            for share in [torque / motor.torque_max(), rate / limits.rate_max, voltage] {
                if share.abs() > largest.0 {
                    largest = (share.abs(), joint);
                }
            }
        }
    }
    largest
}

/// What a person would type.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    #[test]
    fn the_trunk_of_a_fitted_half_step_is_upright_and_no_drive_is_near_its_limit() {
        let fitted = fit_half_step(&mechanism()).unwrap();
        let (least, most) = fitted.synthesis.report.trunk_pitch;
        assert!(((least + most) / 2.0).abs() < 2.0 * UPRIGHT, "{least} {most}");
        assert!(fitted.load.0 <= LOAD_MAX, "{:?}", fitted.load);
        assert_eq!(fitted.parameters.step_length, 0.25, "a strong robot takes the default step");
    }

    #[test]
    fn weak_hips_get_a_half_step_that_needs_less() {
        let mut weak = mechanism();
        let strong = try_out(&weak, upright(&weak, SynthesisParameters::for_robot(&weak))).unwrap();
        for joint in [Joint::RightHipRoll, Joint::LeftHipRoll] {
            let rows = &strong.synthesis.table.rows;
            let most = rows.iter().map(|row| (row.torque_gravity[joint] + row.torque_dynamic[joint]).abs());
            let effort = most.fold(0.0, f64::max) / 0.95;
            weak.links[joint].motor = Some(model::Motor::Torque(model::TorqueSource { effort, armature: 0.0 }));
        }
        let fitted = fit_half_step(&weak).unwrap();
        let before = try_out(&weak, strong.parameters).unwrap();
        assert!(fitted.load.0 < before.load.0, "{:?} {:?}", fitted.load, before.load);
    }

    #[test]
    fn weak_or_slow_shoulders_swing_less() {
        let drive = |effort: f64, rate: f64| {
            let mut robot = mechanism();
            for joint in [Joint::RightShoulder, Joint::LeftShoulder] {
                robot.links[joint].motor = Some(model::Motor::Torque(model::TorqueSource { effort, armature: 0.0 }));
                robot.links[joint].limits =
                    robot.links[joint].limits.map(|own| model::JointLimits { rate_max: rate, ..own });
            }
            fit_half_step(&robot).unwrap().parameters
        };
        let (default, weak, slow) = (drive(100.0, 10.0), drive(3.5, 10.0), drive(100.0, 1.0));
        assert_eq!(default.arm_swing, SynthesisParameters::default().arm_swing);
        assert!(weak.arm_swing < default.arm_swing && weak.step_length == default.step_length, "{weak:?}");
        assert!(slow.arm_swing < default.arm_swing && slow.step_length == default.step_length, "{slow:?}");
    }
}
