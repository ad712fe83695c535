//! Forecast: the coming half-steps played ahead, to see whether soles, joints and drives can do them.

use model::{Joint, JointVector, Mechanism, Motion, Side};
use nalgebra::{Point3, Vector2};

use crate::Plan;
use crate::preview::{KNOT, Preview};

/// What coming half-steps are foreseen to need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Least distance of the planned ZMP to the bearing sole's edge, off the swaps [m].
    pub margin: f64,
    /// The limit that is broken first, if any.
    pub strain: Option<Strain>,
}

/// A limit that would be broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strain {
    /// Which.
    pub limit: Limit,
    /// What would be needed.
    pub value: f64,
    /// What there is.
    pub bound: f64,
}

/// What limits a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Distance of the ZMP to the sole's edge [m].
    Margin,
    /// Angle of a physical joint [rad].
    JointRange(Joint),
    /// Rate of a physical joint [rad/s].
    JointRate(Joint),
    /// Voltage of a physical joint's motor [V].
    Voltage(Joint),
    /// Distance of the swinging sole to the other one, or to the ground in mid-swing [m].
    SoleClearance,
    /// Distance of hip and ankle: the posture before was kept; value and bound mean nothing.
    LegReach,
}

/// What is demanded of coming half-steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastParameters {
    /// Least distance of the planned ZMP to the sole's edge [m].
    pub margin_min: f64,
    /// Least distance of the soles to each other [m].
    pub clearance_min: f64,
}

/// Progress between which a half-step's margin counts: at a swap the ZMP goes from foot to foot.
const OFF_THE_SWAPS: std::ops::Range<f64> = 0.1..0.9;
/// Progress between which the swinging sole must be off the ground.
const MID_SWING: std::ops::Range<f64> = 0.3..0.7;
/// Least height of the swinging sole then [m].
const HEIGHT_MIN: f64 = 0.01;

/// Plays previews ahead.
#[derive(Clone, Debug)]
pub struct Forecaster {
    parameters: ForecastParameters,
    mechanism: Mechanism,
    plan: Plan,
}

impl Forecaster {
    /// For a robot.
    pub fn new(mechanism: &Mechanism, plan: Plan, parameters: ForecastParameters) -> Self {
        Self { parameters, mechanism: mechanism.clone(), plan }
    }

    /// Moves a preview on by so many knots and looks at each.
    pub fn play(&mut self, preview: &mut Preview, knots: usize) -> Forecast {
        let mut forecast = Forecast { margin: f64::INFINITY, strain: None };
        for _ in 0..knots {
            preview.advance(KNOT);
            let strain = self.look(preview, &mut forecast.margin);
            forecast.strain = forecast.strain.or(strain);
        }
        if forecast.strain.is_none() && forecast.margin < self.parameters.margin_min {
            let strain = Strain { limit: Limit::Margin, value: forecast.margin, bound: self.parameters.margin_min };
            forecast.strain = Some(strain);
        }
        forecast
    }

    /// What is broken now; the margin is lessened where it is less.
    fn look(&mut self, preview: &Preview, margin: &mut f64) -> Option<Strain> {
        if preview.is_out_of_reach() {
            return Some(Strain { limit: Limit::LegReach, value: 0.0, bound: 0.0 });
        }
        let (tree, mirror) = (preview.tree(), preview.walk().mirror());
        let (half_step, on_both_feet) = (preview.half_step(), preview.weight_on_bearing() < 1.0);
        let motion = preview.motion();
        self.plan.update(tree, mirror, &motion, on_both_feet);
        let is_swinging = !on_both_feet && OFF_THE_SWAPS.contains(&half_step.progress);
        if is_swinging {
            *margin = margin.min(self.plan.margin);
        }
        let (motion, torques) = match half_step.support {
            Side::Right => (motion, self.plan.torques),
            Side::Left => (motion.mirrored(mirror), mirror.apply(&self.plan.torques)),
        };
        let strain = self.joints(&motion, &torques);
        strain.or_else(|| if is_swinging { self.clearance(half_step.progress) } else { None })
    }

    /// Told in physical joints.
    fn joints(&self, motion: &Motion, torques: &JointVector) -> Option<Strain> {
        Joint::ALL.into_iter().find_map(|joint| {
            let link = &self.mechanism.links[joint];
            let limits = link.limits?;
            let (angle, rate) = (motion.angles[joint], motion.rates[joint]);
            let broken = |limit, value: f64, bound: f64| Some(Strain { limit, value, bound });
            if angle > limits.angle_max {
                return broken(Limit::JointRange(joint), angle, limits.angle_max);
            }
            if angle < limits.angle_min {
                return broken(Limit::JointRange(joint), angle, limits.angle_min);
            }
            if rate.abs() > limits.rate_max {
                return broken(Limit::JointRate(joint), rate, limits.rate_max.copysign(rate));
            }
            let motor = link.motor?;
            let voltage = (torques[joint] + motor.back_emf_damping() * rate) / motor.torque_per_volt();
            if voltage.abs() > motor.voltage_max {
                return broken(Limit::Voltage(joint), voltage, motor.voltage_max.copysign(voltage));
            }
            None
        })
    }

    /// How far the swinging sole is from the bearing one and, in mid-swing, from the ground.
    fn clearance(&self, progress: f64) -> Option<Strain> {
        let sole = &self.mechanism.sole;
        let swinging = self.plan.kinematics().sole_to_world(&self.mechanism, Side::Left);
        if MID_SWING.contains(&progress) && swinging.translation.z < HEIGHT_MIN {
            return Some(Strain { limit: Limit::SoleClearance, value: swinging.translation.z, bound: HEIGHT_MIN });
        }
        let gap = sole.corners().into_iter().fold(f64::INFINITY, |gap, corner| {
            let point: Vector2<f64> = (swinging * Point3::from(corner)).coords.xy();
            let beside = Vector2::new(point.x.clamp(-sole.behind, sole.ahead), point.y.min(sole.half_width));
            gap.min((point - beside).norm())
        });
        let bound = self.parameters.clearance_min;
        (gap < bound).then_some(Strain { limit: Limit::SoleClearance, value: gap, bound })
    }
}
