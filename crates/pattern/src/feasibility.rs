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
    /// How far each limit is exceeded.
    excess: Excess,
}

/// How far each limit is exceeded at most; 0 where it is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Excess {
    /// Missing distance of the ZMP to the edge of the sole (m).
    margin: f64,
    /// Of the physical joints (rad).
    range: JointVector,
    /// Of the physical joints (rad/s).
    rate: JointVector,
    /// Of the physical joints' motors (V).
    voltage: JointVector,
    /// Missing distance of the swing sole (m).
    clearance: f64,
    /// Whether a leg was too short for a posture.
    is_out_of_reach: bool,
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
/// Loss of margin that counts as none (m).
const MARGIN_LOSS_MAX: f64 = 0.002;
/// Relative increase of another excess that counts as none.
const INCREASE_MAX: f64 = 0.02;

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

    /// Advances a generator knot by knot and checks each, as long as `goes_on` says so of the generator and the number
    /// of knots so far.
    pub fn play(
        &mut self,
        generator: &mut PatternGenerator,
        goes_on: impl Fn(&PatternGenerator, usize) -> bool,
    ) -> Feasibility {
        let mut feasibility = Feasibility { margin: f64::INFINITY, violation: None, excess: Excess::NONE };
        for knots in 0.. {
            if !goes_on(generator, knots) {
                break;
            }
            generator.advance(KNOT);
            self.check(generator, &mut feasibility);
        }
        let (margin, margin_min) = (feasibility.margin, self.parameters.margin_min);
        if margin < margin_min {
            feasibility.excess.margin = margin_min - margin;
            let violation = LimitViolation { limit: Limit::Margin, value: margin, bound: margin_min };
            feasibility.violation.get_or_insert(violation);
        }
        feasibility
    }

    /// Checks the present knot.
    fn check(&mut self, generator: &PatternGenerator, feasibility: &mut Feasibility) {
        if generator.is_leg_out_of_reach() {
            feasibility.excess.is_out_of_reach = true;
            feasibility.violation.get_or_insert(LimitViolation { limit: Limit::LegReach, value: 0.0, bound: 0.0 });
            return;
        }
        let (tree, mirror) = (generator.tree(), generator.walk().mirror());
        let (half_step, in_double_support) = (generator.half_step(), generator.in_double_support());
        let motion = generator.motion();
        self.dynamics.update(tree, mirror, &motion, in_double_support);
        let is_swinging = !in_double_support && OFF_SUPPORT_CHANGES.contains(&half_step.progress);
        if is_swinging {
            feasibility.margin = feasibility.margin.min(self.dynamics.margin);
        }
        let motion = mirror.to_physical(half_step.support, &motion);
        let torques = mirror.to_physical(half_step.support, &self.dynamics.torques);
        self.check_joints(&motion, &torques, feasibility);
        if is_swinging && let Some(violation) = self.check_clearance(half_step.progress) {
            let excess = &mut feasibility.excess;
            excess.clearance = excess.clearance.max(violation.bound - violation.value);
            feasibility.violation.get_or_insert(violation);
        }
    }

    /// * `motion`, `torques` – of physical joints
    fn check_joints(&self, motion: &Motion, torques: &JointVector, feasibility: &mut Feasibility) {
        let Feasibility { violation, excess, .. } = feasibility;
        let mut note = |limit, value: f64, bound: f64, excess: &mut f64| {
            *excess = excess.max((value - bound).abs());
            violation.get_or_insert(LimitViolation { limit, value, bound });
        };
        for joint in Joint::ALL {
            let link = &self.mechanism.links[joint];
            let Some(limits) = link.limits else { continue };
            let (angle, rate) = (motion.angles[joint], motion.rates[joint]);
            let bound = angle.clamp(limits.angle_min, limits.angle_max);
            if angle != bound {
                note(Limit::JointRange(joint), angle, bound, &mut excess.range[joint]);
            }
            if rate.abs() > limits.rate_max {
                note(Limit::JointRate(joint), rate, limits.rate_max.copysign(rate), &mut excess.rate[joint]);
            }
            let Some(motor) = link.motor else { continue };
            let voltage = (torques[joint] + motor.back_emf_damping() * rate) / motor.torque_per_volt();
            if voltage.abs() > motor.voltage_max {
                let bound = motor.voltage_max.copysign(voltage);
                note(Limit::Voltage(joint), voltage, bound, &mut excess.voltage[joint]);
            }
        }
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

impl Feasibility {
    /// Whether every limit is kept, or exceeded no further than by another motion.
    pub fn is_no_worse_than(&self, other: &Feasibility) -> bool {
        self.violation.is_none() || self.excess.is_within(&other.excess)
    }
}

impl Excess {
    const NONE: Self = Self {
        margin: 0.0,
        range: JointVector::ZERO,
        rate: JointVector::ZERO,
        voltage: JointVector::ZERO,
        clearance: 0.0,
        is_out_of_reach: false,
    };

    /// Whether no limit is exceeded further than in `other`.
    fn is_within(&self, other: &Excess) -> bool {
        let is_within = |ours: f64, theirs: f64| ours <= theirs * (1.0 + INCREASE_MAX);
        let all_within = |ours: &JointVector, theirs: &JointVector| {
            Joint::ALL.into_iter().all(|joint| is_within(ours[joint], theirs[joint]))
        };
        let margin_loss_max = if other.margin > 0.0 { MARGIN_LOSS_MAX } else { 0.0 };
        self.margin <= other.margin + margin_loss_max
            && all_within(&self.range, &other.range)
            && all_within(&self.rate, &other.rate)
            && all_within(&self.voltage, &other.voltage)
            && is_within(self.clearance, other.clearance)
            && (other.is_out_of_reach || !self.is_out_of_reach)
    }
}
