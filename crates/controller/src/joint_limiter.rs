//! The joint limiter: every setpoint passes it last. Angles stay in range, rates and torques within limits, values
//! finite.

use interface::{Fault, Faults, Setpoint};
use model::{Joint, JointVector, Mechanism, Motion, Motor, PerJoint};

/// Limits setpoints to what the joints permit.
#[derive(Clone, Debug)]
pub struct JointLimiter {
    limits: PerJoint<Option<model::JointLimits>>,
    /// The motor of each joint.
    motors: PerJoint<Option<Motor>>,
    last: JointVector,
}

impl JointLimiter {
    /// A limiter for a mechanism whose joints are at `angles` now (rad).
    pub fn new(mechanism: &Mechanism, angles: &JointVector) -> Self {
        Self {
            limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits),
            motors: PerJoint::from_fn(|joint| mechanism.links[joint].motor),
            last: *angles,
        }
    }

    /// The permitted setpoint nearest to the commanded motion; `dt` is the time since the last one (s).
    pub fn limit(&mut self, commanded: &Motion, feed_forward: &JointVector, dt: f64, faults: &mut Faults) -> Setpoint {
        if !(commanded.is_finite() && feed_forward.is_finite()) {
            faults.insert(Fault::SetpointNotFinite);
            return self.hold();
        }
        let mut setpoint = Setpoint { angles: self.last, rates: JointVector::ZERO, feed_forward: JointVector::ZERO };
        for joint in Joint::ALL {
            let Some(limits) = &self.limits[joint] else { continue };
            let in_range = commanded.angles[joint].clamp(limits.angle_min, limits.angle_max);
            let step_max = limits.rate_max * dt;
            let angle = in_range.clamp(self.last[joint] - step_max, self.last[joint] + step_max);
            let rate = commanded.rates[joint].clamp(-limits.rate_max, limits.rate_max);
            if in_range != commanded.angles[joint] {
                faults.insert(Fault::AngleLimited);
            }
            if angle != in_range || rate != commanded.rates[joint] {
                faults.insert(Fault::RateLimited);
            }
            setpoint.angles[joint] = angle;
            // A joint whose angle was limited must not be carried on by its rate.
            setpoint.rates[joint] = if angle == commanded.angles[joint] { rate } else { 0.0 };
            setpoint.feed_forward[joint] =
                self.motors[joint].map_or(0.0, |motor| available(&motor, feed_forward[joint], setpoint.rates[joint]));
        }
        self.last = setpoint.angles;
        setpoint
    }

    /// Takes these angles for the last setpoint (rad): the joints are there.
    pub fn start_at(&mut self, angles: &JointVector) {
        self.last = *angles;
    }

    /// The angles of the last setpoint, at rest.
    pub fn hold(&self) -> Setpoint {
        Setpoint { angles: self.last, rates: JointVector::ZERO, feed_forward: JointVector::ZERO }
    }
}

/// The torque next to `torque` that a motor gives at a joint rate with its supply voltage (N·m), never more than at
/// standstill.
fn available(motor: &Motor, torque: f64, rate: f64) -> f64 {
    let stall = motor.torque_max();
    let lost = motor.back_emf_damping() * rate;
    torque.min(stall - lost).max(-stall - lost).clamp(-stall, stall)
}
