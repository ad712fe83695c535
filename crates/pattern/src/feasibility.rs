//! Feasibility check: plays coming half-steps ahead and checks them against the limits of soles, joints and drives.
//!
//! Most limits change slowly from knot to knot. Around a support change the ZMP moves from foot to foot within two
//! knots, and torques peak between them. So the motion between the knots is checked, too, there and wherever a drive
//! comes near its limit; always at the same shares of the time between two knots, whenever the check is made.

use dynamics::ReferenceDynamics;
use model::{Joint, JointVector, Mechanism, Motion, Side, Sole};
use nalgebra::{Point3, Vector2};

use crate::gait::Gait;
use crate::limit::{ANKLES, Excess, Limit, LimitViolation};
use crate::pace::Pace;
use crate::pattern_generator::PatternGenerator;
use crate::proportions::PatternProportions;
use crate::sole_friction::SoleFriction;
use crate::start_overload::StartOverload;

/// The result of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feasibility {
    /// Least distance of the planned ZMP to the edge of the support sole, off the support changes (m).
    pub margin: f64,
    /// The least one at the knots alone (m).
    margin_at_knots: f64,
    /// The limit that is violated first, if any.
    pub violation: Option<LimitViolation>,
    /// The half-step in which that is, counted from 0.
    pub violated_in: Option<u64>,
    /// The present half-step, and that of the least margin.
    half_step: u64,
    margin_in: u64,
    /// How far each limit is exceeded.
    excess: Excess,
    /// The drives in starts from a stand.
    overload: StartOverload,
    /// The largest share of its limit that any joint rate, torque or voltage of the present knot takes.
    load: f64,
}

/// The configured limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeasibilityParameters {
    /// Least distance of the planned ZMP to the edge of the sole (m).
    pub margin_min: f64,
    /// Least distance of the soles to each other (m).
    pub clearance_min: f64,
    /// Coefficient of friction of the ground that can be relied on (-).
    pub friction: f64,
}

/// Progress between which the margin counts: at a support change the ZMP moves from foot to foot.
const OFF_SUPPORT_CHANGES: std::ops::Range<f64> = 0.1..0.9;
/// Progress between which the swing sole must be off the ground.
const MID_SWING: std::ops::Range<f64> = 0.3..0.7;
/// Parts into which the time between two knots is divided around a support change, and after a velocity was asked for:
/// a millisecond each.
const PARTS_NEAR_SUPPORT_CHANGE: u32 = 10;
/// Knots after such a request within which the ZMP may move so fast that it overshoots.
const KNOTS_AFTER_CHANGE: usize = 6;
/// Parts into which it is divided where a drive comes near its limit.
const PARTS_NEAR_LIMIT: u32 = 4;
/// Ample distance of the ZMP to the edge of a sole at the knots, as a share of half of its width.
const AMPLE: f64 = 0.5;
/// The same between knots, where the ZMP overshoots for some milliseconds.
const AMPLE_BETWEEN_KNOTS: f64 = 0.25;
/// Share of its limit from which a drive comes near it.
const NEAR_LIMIT: f64 = 0.85;
/// Just before and after a support change, as a share of the time between two knots.
const AT_SUPPORT_CHANGE: f64 = 1e-6;

/// Checks motions of one robot. Never allocates after it is made.
#[derive(Clone, Debug)]
pub struct FeasibilityCheck {
    parameters: FeasibilityParameters,
    mechanism: Mechanism,
    proportions: PatternProportions,
    dynamics: ReferenceDynamics,
    friction: SoleFriction,
}

impl FeasibilityCheck {
    /// A check for a robot.
    ///
    /// * `dynamics` – of that robot; its state does not matter
    pub fn new(mechanism: &Mechanism, dynamics: ReferenceDynamics, parameters: FeasibilityParameters) -> Self {
        Self {
            parameters,
            mechanism: mechanism.clone(),
            proportions: PatternProportions::of(mechanism),
            dynamics,
            friction: SoleFriction::new(&mechanism.sole, parameters.friction),
        }
    }

    /// Whether a motion keeps every limit, and its ZMP stays about as far from the edge of the sole as in a walk that
    /// does not change.
    pub fn is_ample(&self, feasibility: &Feasibility) -> bool {
        let Sole { inside, outside, .. } = self.mechanism.sole;
        let half_width = 0.5 * (inside + outside);
        feasibility.violation.is_none()
            && feasibility.margin_at_knots >= AMPLE * half_width
            && feasibility.margin >= AMPLE_BETWEEN_KNOTS * half_width
    }

    /// Advances a generator knot by knot and checks the motion between them, as long as `goes_on` says so of the
    /// generator and the number of knots so far. What lies between its present knots is planned already and not
    /// checked.
    pub fn play(
        &mut self,
        generator: &mut PatternGenerator,
        goes_on: impl Fn(&PatternGenerator, usize) -> bool,
    ) -> Feasibility {
        let mut feasibility = Feasibility::default();
        for knots in 0.. {
            if !goes_on(generator, knots) {
                break;
            }
            generator.advance_to_next_knot();
            let is_sudden = knots < KNOTS_AFTER_CHANGE && generator.pace() != Pace::AtOnce;
            self.check_until_next_knot(generator, is_sudden, &mut feasibility);
        }
        let (margin, margin_min) = (feasibility.margin, self.parameters.margin_min);
        if margin < margin_min {
            feasibility.half_step = feasibility.margin_in;
            feasibility.note(Limit::Margin, margin, margin_min);
        }
        feasibility
    }

    /// Checks the motion from the present knot to the next one, and returns to the present knot.
    ///
    /// * `is_sudden` – whether the motion may change so fast that limits are exceeded between the knots
    fn check_until_next_knot(
        &mut self,
        generator: &mut PatternGenerator,
        is_sudden: bool,
        feasibility: &mut Feasibility,
    ) {
        if generator.is_leg_out_of_reach() {
            feasibility.half_step = generator.half_step().index;
            feasibility.note(Limit::LegReach, 0.0, 0.0);
            return;
        }
        feasibility.load = 0.0;
        if self.check(generator, feasibility) {
            feasibility.margin_at_knots = feasibility.margin_at_knots.min(self.dynamics.margin);
        }
        self.check_start(generator, feasibility);
        let parts = if is_sudden || generator.is_near_support_change() {
            PARTS_NEAR_SUPPORT_CHANGE
        } else if feasibility.load > NEAR_LIMIT {
            PARTS_NEAR_LIMIT
        } else {
            return;
        };
        let between = (1..parts).map(|part| f64::from(part) / f64::from(parts));
        let at_support_change = generator.share_at_support_change().into_iter();
        let at_support_change = at_support_change.flat_map(|at| [at - AT_SUPPORT_CHANGE, at + AT_SUPPORT_CHANGE]);
        for share in between.chain(at_support_change) {
            generator.seek(share);
            self.check(generator, feasibility);
        }
        generator.seek(0.0);
    }

    /// Checks the knot that was checked last as a part of a start from a stand, if it is one.
    fn check_start(&self, generator: &PatternGenerator, feasibility: &mut Feasibility) {
        let half_step = generator.half_step();
        let torques = generator.walk().mirror().to_physical(half_step.support, &self.dynamics.torques);
        feasibility.overload.note(&self.mechanism, half_step.index, generator.in_double_support(), &torques);
    }

    /// Checks the present instant. Returns whether its margin counts.
    fn check(&mut self, generator: &PatternGenerator, feasibility: &mut Feasibility) -> bool {
        let (tree, mirror) = (generator.tree(), generator.walk().mirror());
        let (half_step, in_double_support) = (generator.half_step(), generator.in_double_support());
        let motion = generator.motion();
        self.dynamics.update(tree, mirror, &motion, generator.contact());
        let is_swinging = !in_double_support && OFF_SUPPORT_CHANGES.contains(&half_step.progress);
        feasibility.half_step = half_step.index;
        if is_swinging {
            if self.dynamics.margin < feasibility.margin {
                (feasibility.margin, feasibility.margin_in) = (self.dynamics.margin, half_step.index);
            }
            self.check_clearance(half_step.progress, feasibility);
        }
        if is_swinging || in_double_support {
            self.check_friction(is_swinging, feasibility);
        }
        let motion = mirror.to_physical(half_step.support, &motion);
        let torques = mirror.to_physical(half_step.support, &self.dynamics.torques);
        // Between two knots around a support change the planned ZMP overshoots the soles. No ground gives an ankle such
        // a torque.
        let ground_holds = is_swinging || in_double_support || self.dynamics.margin >= 0.0;
        self.check_joints(&motion, &torques, ground_holds, feasibility);
        is_swinging
    }

    /// * `motion`, `torques` – of physical joints
    /// * `ground_holds` – whether the ground can give the ankles their torques
    fn check_joints(&self, motion: &Motion, torques: &JointVector, ground_holds: bool, feasibility: &mut Feasibility) {
        for joint in Joint::ALL {
            let link = &self.mechanism.links[joint];
            let Some(limits) = link.limits else { continue };
            let (angle, rate) = (motion.angles[joint], motion.rates[joint]);
            let bound = angle.clamp(limits.angle_min, limits.angle_max);
            if angle != bound {
                feasibility.note(Limit::JointRange(joint), angle, bound);
            }
            feasibility.bound(Limit::JointRate(joint), rate, limits.rate_max);
            let Some(motor) = link.motor.filter(|_| ground_holds || !ANKLES.contains(&joint)) else { continue };
            feasibility.bound(Limit::Torque(joint), torques[joint], motor.torque_max());
            if let Some(dc) = motor.dc() {
                let voltage = (torques[joint] + motor.back_emf_damping() * rate) / dc.torque_per_volt();
                feasibility.bound(Limit::Voltage(joint), voltage, dc.voltage_max);
            }
        }
    }

    /// Checks what the ground must hold by friction; the moment about the vertical only where one sole must hold it.
    fn check_friction(&self, is_swinging: bool, feasibility: &mut Feasibility) {
        let ground = self.dynamics.ground_on_sole();
        let slip = self.friction.slip(&ground);
        if slip > self.parameters.friction {
            feasibility.note(Limit::Friction, slip, self.parameters.friction);
        }
        if is_swinging && let Some(bound) = self.friction.exceeded_yaw_torque(&ground) {
            feasibility.note(Limit::YawTorque, ground.moment.z, bound);
        }
    }

    /// Checks the distance of the swing sole to the support sole and, in mid-swing, to the ground.
    fn check_clearance(&self, progress: f64, feasibility: &mut Feasibility) {
        let sole = &self.mechanism.sole;
        let swing_sole = self.dynamics.kinematics().sole_to_world(&self.mechanism, Side::Left);
        let (height, height_min) = (swing_sole.translation.z, self.proportions.swing_height_min);
        if MID_SWING.contains(&progress) && height < height_min {
            feasibility.note(Limit::SoleClearance, height, height_min);
            return;
        }
        let gap = sole.corners(Side::Left).into_iter().fold(f64::INFINITY, |gap, corner| {
            let point: Vector2<f64> = (swing_sole * Point3::from(corner)).coords.xy();
            let beside = Vector2::new(point.x.clamp(-sole.behind, sole.ahead), point.y.min(sole.inside));
            gap.min((point - beside).norm())
        });
        if gap < self.parameters.clearance_min {
            feasibility.note(Limit::SoleClearance, gap, self.parameters.clearance_min);
        }
    }
}

impl Default for Feasibility {
    /// No motion yet.
    fn default() -> Self {
        Self {
            margin: f64::INFINITY,
            margin_at_knots: f64::INFINITY,
            violation: None,
            violated_in: None,
            half_step: 0,
            margin_in: 0,
            excess: Excess::NONE,
            overload: StartOverload::default(),
            load: 0.0,
        }
    }
}

impl Feasibility {
    /// Whether every limit is kept, or exceeded no further than by another motion.
    pub fn is_no_worse_than(&self, other: &Feasibility) -> bool {
        self.violation.is_none() || self.excess.is_within(&other.excess)
    }

    /// The torque that a drive lacks in a start from a stand, and for so long that its joint would fall behind.
    pub fn overload(&self) -> Option<LimitViolation> {
        self.overload.violation()
    }

    /// Of two motions together: each limit as it is exceeded by either.
    #[must_use]
    pub fn and(mut self, other: &Feasibility) -> Self {
        self.margin = self.margin.min(other.margin);
        self.margin_at_knots = self.margin_at_knots.min(other.margin_at_knots);
        if self.violation.is_none() {
            (self.violation, self.violated_in) = (other.violation, other.violated_in);
        }
        self.excess = self.excess.max(&other.excess);
        if self.overload().is_none() {
            self.overload = other.overload;
        }
        self
    }

    /// Notes a violation.
    fn note(&mut self, limit: Limit, value: f64, bound: f64) {
        let violation = LimitViolation { limit, value, bound };
        self.excess.note(&violation);
        if self.violation.is_none() {
            (self.violation, self.violated_in) = (Some(violation), Some(self.half_step));
        }
    }

    /// Notes how near a value is to its limit, and a violation if it is beyond, either way.
    fn bound(&mut self, limit: Limit, value: f64, max: f64) {
        self.load = self.load.max(value.abs() / max);
        if value.abs() > max {
            self.note(limit, value, max.copysign(value));
        }
    }
}
