//! The last gate before the joints: angles within their range, rates within their limits, numbers only.

use model::{Joint, JointVector, Mechanism, Motion, PerJoint};

use crate::{Fault, Faults, Setpoint};

/// Guards the output.
#[derive(Clone, Debug)]
pub struct Guard {
    limits: PerJoint<Option<model::JointLimits>>,
    last: JointVector,
}

impl Guard {
    /// Guards a mechanism whose joints are at `angles` now.
    pub fn new(mechanism: &Mechanism, angles: &JointVector) -> Self {
        Self { limits: PerJoint::from_fn(|joint| mechanism.links[joint].limits), last: *angles }
    }

    /// The nearest setpoint to what is asked that the joints may be given; `dt` is the time since the last one [s].
    pub fn limit(&mut self, asked: &Motion, feed_forward: &JointVector, dt: f64, faults: &mut Faults) -> Setpoint {
        if !(asked.is_finite() && feed_forward.is_finite()) {
            faults.insert(Fault::WalkNotFinite);
            return self.hold();
        }
        let mut setpoint = Setpoint { angles: self.last, rates: JointVector::ZERO, feed_forward: JointVector::ZERO };
        for joint in Joint::ALL {
            let Some(limits) = &self.limits[joint] else { continue };
            let in_range = asked.angles[joint].clamp(limits.angle_min, limits.angle_max);
            let step_max = limits.rate_max * dt;
            let angle = in_range.clamp(self.last[joint] - step_max, self.last[joint] + step_max);
            let rate = asked.rates[joint].clamp(-limits.rate_max, limits.rate_max);
            if in_range != asked.angles[joint] {
                faults.insert(Fault::AngleLimited);
            }
            if angle != in_range || rate != asked.rates[joint] {
                faults.insert(Fault::RateLimited);
            }
            setpoint.angles[joint] = angle;
            // A joint that was held back is not to be carried on by its rate.
            setpoint.rates[joint] = if angle == asked.angles[joint] { rate } else { 0.0 };
            setpoint.feed_forward[joint] = feed_forward[joint];
        }
        self.last = setpoint.angles;
        setpoint
    }

    /// Where the joints were last sent, at rest.
    pub fn hold(&self) -> Setpoint {
        Setpoint { angles: self.last, rates: JointVector::ZERO, feed_forward: JointVector::ZERO }
    }
}
