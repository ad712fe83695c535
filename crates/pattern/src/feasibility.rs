//! Feasibility check: plays coming half-steps ahead and checks them against the limits of soles, joints and drives.

use dynamics::ReferenceDynamics;
use model::{Joint, JointVector, Mechanism, Motion, Side};
use nalgebra::{Point3, Vector2};

use crate::gait::Gait;
use crate::knot::KNOT;
use crate::pattern_generator::PatternGenerator;
use crate::proportions::PatternProportions;

/// The result of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feasibility {
    /// Least distance of the planned ZMP to the edge of the support sole, off the support changes (m).
    pub margin: f64,
    /// The limit that is violated first, if any.
    pub violation: Option<LimitViolation>,
}

/// A limit that is violated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitViolation {
    /// Which limit.
    pub limit: Limit,
    /// The value that the motion needs, in the unit of the limit.
    pub value: f64,
    /// The bound on this value, in the unit of the limit.
    pub bound: f64,
}

/// A limit of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Distance of the ZMP to the edge of the sole (m).
    Margin,
    /// Angle of a physical joint (rad).
    JointRange(Joint),
    /// Rate of a physical joint (rad/s).
    JointRate(Joint),
    /// Voltage of a physical joint's motor (V).
    Voltage(Joint),
    /// Distance of the swing sole to the support sole, or to the ground in mid-swing (m).
    SoleClearance,
    /// Length of a leg, which was too short for a posture; value and bound mean nothing.
    LegReach,
}

/// The configured limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeasibilityParameters {
    /// Least distance of the planned ZMP to the edge of the sole (m).
    pub margin_min: f64,
    /// Least distance of the soles to each other (m).
    pub clearance_min: f64,
}

/// Progress between which the margin counts: at a support change the ZMP moves from foot to foot.
const OFF_SUPPORT_CHANGES: std::ops::Range<f64> = 0.1..0.9;
/// Progress between which the swing sole must be off the ground.
const MID_SWING: std::ops::Range<f64> = 0.3..0.7;

/// Checks motions of one robot. Never allocates after it is made.
#[derive(Clone, Debug)]
pub struct FeasibilityCheck {
    parameters: FeasibilityParameters,
    mechanism: Mechanism,
    proportions: PatternProportions,
    dynamics: ReferenceDynamics,
}

impl FeasibilityCheck {
    /// A check for a robot.
    ///
    /// * `dynamics` – of that robot; its state does not matter
    pub fn new(mechanism: &Mechanism, dynamics: ReferenceDynamics, parameters: FeasibilityParameters) -> Self {
        Self { parameters, mechanism: mechanism.clone(), proportions: PatternProportions::of(mechanism), dynamics }
    }

    /// Advances a generator by so many knots and checks each.
    pub fn play(&mut self, generator: &mut PatternGenerator, knots: usize) -> Feasibility {
        let mut feasibility = Feasibility { margin: f64::INFINITY, violation: None };
        for _ in 0..knots {
            generator.advance(KNOT);
            let violation = self.check(generator, &mut feasibility.margin);
            feasibility.violation = feasibility.violation.or(violation);
        }
        let (margin, margin_min) = (feasibility.margin, self.parameters.margin_min);
        if feasibility.violation.is_none() && margin < margin_min {
            feasibility.violation = Some(LimitViolation { limit: Limit::Margin, value: margin, bound: margin_min });
        }
        feasibility
    }

    /// The limit that is violated at present, if any; lessens `margin` to the present one.
    fn check(&mut self, generator: &PatternGenerator, margin: &mut f64) -> Option<LimitViolation> {
        if generator.is_leg_out_of_reach() {
            return Some(LimitViolation { limit: Limit::LegReach, value: 0.0, bound: 0.0 });
        }
        let (tree, mirror) = (generator.tree(), generator.walk().mirror());
        let (half_step, in_double_support) = (generator.half_step(), generator.in_double_support());
        let motion = generator.motion();
        self.dynamics.update(tree, mirror, &motion, in_double_support);
        let is_swinging = !in_double_support && OFF_SUPPORT_CHANGES.contains(&half_step.progress);
        if is_swinging {
            *margin = margin.min(self.dynamics.margin);
        }
        let motion = mirror.to_physical(half_step.support, &motion);
        let torques = mirror.to_physical(half_step.support, &self.dynamics.torques);
        let violation = self.check_joints(&motion, &torques);
        violation.or_else(|| if is_swinging { self.check_clearance(half_step.progress) } else { None })
    }

    /// * `motion`, `torques` – of physical joints
    fn check_joints(&self, motion: &Motion, torques: &JointVector) -> Option<LimitViolation> {
        Joint::ALL.into_iter().find_map(|joint| {
            let link = &self.mechanism.links[joint];
            let limits = link.limits?;
            let (angle, rate) = (motion.angles[joint], motion.rates[joint]);
            let violated = |limit, value: f64, bound: f64| Some(LimitViolation { limit, value, bound });
            if angle > limits.angle_max {
                return violated(Limit::JointRange(joint), angle, limits.angle_max);
            }
            if angle < limits.angle_min {
                return violated(Limit::JointRange(joint), angle, limits.angle_min);
            }
            if rate.abs() > limits.rate_max {
                return violated(Limit::JointRate(joint), rate, limits.rate_max.copysign(rate));
            }
            let motor = link.motor?;
            let voltage = (torques[joint] + motor.back_emf_damping() * rate) / motor.torque_per_volt();
            if voltage.abs() > motor.voltage_max {
                return violated(Limit::Voltage(joint), voltage, motor.voltage_max.copysign(voltage));
            }
            None
        })
    }

    /// Checks the distance of the swing sole to the support sole and, in mid-swing, to the ground.
    fn check_clearance(&self, progress: f64) -> Option<LimitViolation> {
        let sole = &self.mechanism.sole;
        let swing_sole = self.dynamics.kinematics().sole_to_world(&self.mechanism, Side::Left);
        let (height, height_min) = (swing_sole.translation.z, self.proportions.swing_height_min);
        if MID_SWING.contains(&progress) && height < height_min {
            return Some(LimitViolation { limit: Limit::SoleClearance, value: height, bound: height_min });
        }
        let gap = sole.corners().into_iter().fold(f64::INFINITY, |gap, corner| {
            let point: Vector2<f64> = (swing_sole * Point3::from(corner)).coords.xy();
            let beside = Vector2::new(point.x.clamp(-sole.behind, sole.ahead), point.y.min(sole.half_width));
            gap.min((point - beside).norm())
        });
        let bound = self.parameters.clearance_min;
        (gap < bound).then_some(LimitViolation { limit: Limit::SoleClearance, value: gap, bound })
    }
}
