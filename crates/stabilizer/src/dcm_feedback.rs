//! Feedback of the divergent component of motion (DCM) through the ankles: its error moves the desired ZMP, and small
//! angles of the support ankle move the ZMP. The swing ankle keeps its sole level while the body tilts, so that it does
//! not land on an edge.

use model::{Joint, Mechanism, Mirror, Mirrored, Motion};
use nalgebra::{Vector2, Vector3};
use signal::{LowPass, critically_damped_rate};

use crate::balance_state::BalanceState;
use crate::proportions::StabilizerProportions;

/// The joints of the support ankle.
const SUPPORT_ANKLE: [Joint; 2] = [Joint::RightAnkleRoll, Joint::RightAnklePitch];
/// The joints of the swing ankle.
const SWING_ANKLE: [Joint; 2] = [Joint::LeftAnkleRoll, Joint::LeftAnklePitch];

/// Time constant of the DCM error for step adjustments (s): a step must not answer the glitch of a sensor.
const ERROR_TIME_CONSTANT: f64 = 0.008;

/// Time for which steps answer a push, counted from the last large error: between the steps of a recovery errors may be
/// small for a moment (s).
const RECOVERY: f64 = 1.0;

/// Time constant with which the body is kept upright over a sole that tilts (s): as fast as the sole finds its place on
/// uneven ground.
const SOLE_TILT_TIME_CONSTANT: f64 = 0.03;

/// Tilt of a sole that joints and ground explain by yielding (rad).
const SOLE_TILT_OF_YIELDING: f64 = 0.02;

/// Rotation of the body over the support ankle, about x and y (rad).
pub type AnkleLean = Vector2<f64>;

/// Parameters of [`DcmFeedback`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedbackParameters {
    /// ZMP shift per error of the divergent component of motion (m/m); above 1 the error shrinks. 0 switches feedback
    /// off.
    pub gain: f64,
    /// Least distance of the desired ZMP to the edge of the sole (m).
    pub edge: f64,
    /// Time constant of foot damping control, which corrects the error of the measured ZMP (s).
    pub foot_damping_time_constant: f64,
    /// Time constant with which the support ankle follows the desired lean (s).
    pub support_ankle_time_constant: f64,
    /// Time constant with which the swing ankle levels its sole (s).
    pub swing_ankle_time_constant: f64,
}

/// Turns the error of the divergent component into ankle angles. The support ankle follows the desired lean, the swing
/// ankle levels its sole; the lean that it had as support ankle fades. Both are critically damped lags, so that angles
/// and rates stay continuous whatever happens.
#[derive(Clone, Debug)]
pub struct DcmFeedback {
    parameters: FeedbackParameters,
    proportions: StabilizerProportions,
    /// Lean per ZMP shift (rad/m): the moment that shifts the ZMP by a metre, over the stiffness of the ankle.
    lean_per_shift: f64,
    /// Axes of [`SUPPORT_ANKLE`].
    support_axes: [Vector3<f64>; 2],
    /// Axes of [`SWING_ANKLE`].
    swing_axes: [Vector3<f64>; 2],
    /// Filtered error of the divergent component that a step adjustment answers (m).
    step_error: LowPass<Vector2<f64>>,
    /// Time for which steps still answer the last large error (s).
    recovery_left: f64,
    /// Filtered tilt of the support sole, about x and y (rad).
    sole_tilt: LowPass<Vector2<f64>>,
    /// ZMP shift of foot damping control (m).
    foot_damping: Vector2<f64>,
    /// Angles and rates of the offsets, in support coordinates.
    offsets: Motion,
    /// The desired lean.
    lean: AnkleLean,
}

impl DcmFeedback {
    /// No error, no lean.
    pub fn new(mechanism: &Mechanism, parameters: FeedbackParameters) -> Self {
        let proportions = StabilizerProportions::of(mechanism);
        let axis = |joint| mechanism.links[joint].axis.into_inner();
        // The moment on the ground per angle of the ankle.
        let ankle_stiffness = mechanism.servos.of(SUPPORT_ANKLE[0]).stiffness;
        Self {
            lean_per_shift: proportions.weight / ankle_stiffness,
            support_axes: SUPPORT_ANKLE.map(axis),
            swing_axes: SWING_ANKLE.map(axis),
            step_error: LowPass::new(ERROR_TIME_CONSTANT, Vector2::zeros()),
            recovery_left: 0.0,
            sole_tilt: LowPass::new(SOLE_TILT_TIME_CONSTANT, Vector2::zeros()),
            foot_damping: Vector2::zeros(),
            offsets: Motion::default(),
            lean: Vector2::zeros(),
            parameters,
            proportions,
        }
    }

    /// Compares the balance of the robot with the planned one, and advances the offsets.
    ///
    /// * `estimated` – `None` if no good measurement is known
    /// * `in_double_support` – whether the other foot carries weight, too, so that the ZMP may leave the support sole
    /// * `dt` – time since the last update (s)
    pub fn update(
        &mut self,
        planned: &BalanceState,
        estimated: Option<&BalanceState>,
        in_double_support: bool,
        dt: f64,
    ) {
        let zmp_planned = planned.zmp.unwrap_or_default();
        let mut level = Vector3::zeros();
        let mut step_error = Vector2::zeros();
        if let Some(estimated) = estimated {
            let error = estimated.com.divergent_component() - planned.com.divergent_component();
            let shift = if in_double_support {
                let max = self.proportions.double_support_zmp_shift_max;
                (error * self.parameters.gain).map(|shift| shift.clamp(-max, max))
            } else {
                level = -Vector3::new(estimated.tilt.x, estimated.tilt.y, 0.0);
                step_error = error.cap_magnitude(self.proportions.dcm_error_max);
                self.zmp_shift(error, zmp_planned)
            };
            let zmp_error = estimated.zmp.map(|zmp| self.inside_sole(zmp_planned + shift) - zmp);
            self.damp_foot(zmp_error, dt);
            let foot = estimated.foot.filter(|_| !in_double_support).unwrap_or_default();
            // A push tips the sole, too: turning the ankle further would only tip it more.
            if foot.is_flat || !self.is_recovering() {
                self.sole_tilt.update(foot.tilt, dt);
            }
            // The body stays upright, however the ground tilts the sole.
            self.lean = self.lean_that_shifts(shift + self.foot_damping) - self.sole_tilt.value().map(beyond_yielding);
        }
        self.step_error.update(step_error, dt);
        let is_push = self.step_error.value().amax() > self.proportions.dcm_error_of_push;
        self.recovery_left = if is_push { RECOVERY } else { (self.recovery_left - dt).max(0.0) };
        let lean = Vector3::new(self.lean.x, self.lean.y, 0.0);
        for (joint, axis) in SUPPORT_ANKLE.into_iter().zip(self.support_axes) {
            self.follow(joint, axis.dot(&lean), self.parameters.support_ankle_time_constant, dt);
        }
        // The kinematic chain runs down the left leg: its ankle rotates the foot, the support ankle the body.
        for (joint, axis) in SWING_ANKLE.into_iter().zip(self.swing_axes) {
            self.follow(joint, axis.dot(&level), self.parameters.swing_ankle_time_constant, dt);
        }
    }

    /// The lean that shifts the ZMP (m): to push the ground further ahead (+x) the body leans back (−y), to push it
    /// further left (+y) it leans right (+x).
    fn lean_that_shifts(&self, zmp: Vector2<f64>) -> AnkleLean {
        Vector2::new(zmp.y, -zmp.x) * self.lean_per_shift
    }

    /// Foot damping control (Kajita et al. 2010): a sole on uneven ground tilts the ankle, whose drive then pushes
    /// elsewhere; the integral of the ZMP error takes that back.
    fn damp_foot(&mut self, zmp_error: Option<Vector2<f64>>, dt: f64) {
        // Without DCM feedback the ZMP would be held while the centre of mass runs away from it.
        let Some(error) = zmp_error.filter(|_| self.parameters.gain > 0.0) else { return };
        let max = self.proportions.foot_damping_zmp_shift_max;
        // However long the period was, the error is taken back once.
        let damping = self.foot_damping + error * (dt / self.parameters.foot_damping_time_constant).min(1.0);
        self.foot_damping = damping.map(|shift| shift.clamp(-max, max));
    }

    /// Expresses everything in support coordinates of the other foot, which supports from now on: the offsets of the
    /// support ankle are now those of the swing ankle.
    ///
    /// * `heading` – of the new support foot against the former one: a unit vector in its coordinates
    pub fn change_support(&mut self, mirror: &Mirror, heading: Vector2<f64>) {
        self.offsets = self.offsets.mirrored(mirror);
        self.release();
        let aside = Vector2::new(-heading.y, heading.x);
        self.step_error = self.step_error.map(|error| Vector2::new(heading.dot(&error), -aside.dot(&error)));
    }

    /// Lets the lean fade, and forgets the ground under the support foot: another foot bears, none does, or no good
    /// measurement is known.
    pub fn release(&mut self) {
        self.lean = Vector2::zeros();
        self.foot_damping = Vector2::zeros();
        self.sole_tilt = LowPass::new(SOLE_TILT_TIME_CONSTANT, Vector2::zeros());
    }

    /// The shift of the desired ZMP (m): proportional to the error, and never beyond the sole.
    fn zmp_shift(&self, error: Vector2<f64>, zmp_planned: Vector2<f64>) -> Vector2<f64> {
        // A plan outside the sole is not dragged inside by feedback alone: only errors move the ZMP.
        let shift = self.inside_sole(zmp_planned + error * self.parameters.gain) - zmp_planned;
        shift.zip_map(&error, |shift, error| {
            let allowed = error * self.parameters.gain;
            shift.min(allowed.max(0.0)).max(allowed.min(0.0))
        })
    }

    /// The nearest point of the sole that keeps its distance to the edge (m).
    fn inside_sole(&self, zmp: Vector2<f64>) -> Vector2<f64> {
        let StabilizerProportions { sole_half_size, sole_centre, .. } = self.proportions;
        let room = (sole_half_size - Vector2::repeat(self.parameters.edge)).map(|size| size.max(0.0));
        (zmp - sole_centre).zip_map(&room, |zmp, room| zmp.min(room).max(-room)) + sole_centre
    }

    /// The filtered error of the divergent component, which a step answers, in support coordinates (m).
    pub fn step_error(&self) -> Vector2<f64> {
        self.step_error.value()
    }

    /// Whether the robot recovers from a push, so that its steps answer it. Else the ankles suffice.
    pub fn is_recovering(&self) -> bool {
        self.recovery_left > 0.0
    }

    /// The ZMP farthest back and to the right, and farthest ahead and to the left, that the ankle can hold, in support
    /// coordinates (m).
    pub fn zmp_bounds(&self) -> [Vector2<f64>; 2] {
        let StabilizerProportions { sole_half_size, sole_centre, .. } = self.proportions;
        let edge = (sole_half_size - Vector2::repeat(self.parameters.edge)).map(|size| size.max(0.0));
        [sole_centre - edge, sole_centre + edge]
    }

    /// Advances the offset of a joint as a critically damped lag.
    fn follow(&mut self, joint: Joint, target: f64, time_constant: f64, dt: f64) {
        let (angle, rate) = (self.offsets.angles[joint], self.offsets.rates[joint]);
        let pull = (target - angle) * dt / (time_constant * time_constant);
        let next = critically_damped_rate(rate, pull, time_constant, dt);
        self.offsets.accelerations[joint] = (next - rate) / dt;
        self.offsets.rates[joint] = next;
        self.offsets.angles[joint] = angle + next * dt;
    }

    /// Whether the robot is so far off balance that its legs must not yield: a foot that lands early props it up.
    pub fn is_error_large(&self) -> bool {
        self.step_error.value().amax() > self.proportions.dcm_error_large
    }

    /// The desired lean of the body over the support ankle.
    pub fn lean(&self) -> AnkleLean {
        self.lean
    }

    /// The offsets of the ankles at present: angles with their rates, in support coordinates.
    pub fn offsets(&self) -> &Motion {
        &self.offsets
    }
}

/// The part of a sole's tilt beyond what yields in every walk (rad).
fn beyond_yielding(tilt: f64) -> f64 {
    tilt - tilt.clamp(-SOLE_TILT_OF_YIELDING, SOLE_TILT_OF_YIELDING)
}

#[cfg(test)]
mod tests {
    use config::Config;
    use model::ComState;

    use super::*;
    use crate::balance_state::SupportFoot;

    fn mechanism() -> Mechanism {
        Mechanism::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml")).unwrap()
    }

    fn feedback() -> DcmFeedback {
        let parameters = FeedbackParameters {
            gain: 3.0,
            edge: 0.005,
            foot_damping_time_constant: 0.03,
            support_ankle_time_constant: 0.01,
            swing_ankle_time_constant: 0.05,
        };
        DcmFeedback::new(&mechanism(), parameters)
    }

    /// A resting centre of mass at `x`, `y`, 0.9 m high.
    fn at(x: f64, y: f64) -> BalanceState {
        let com = ComState { position: Vector3::new(x, y, 0.9), velocity: Vector3::zeros() };
        BalanceState { com, tilt: Vector2::zeros(), zmp: None, foot: None }
    }

    /// The body rotated by a small angle: the swing ankle rotates the foot back.
    #[test]
    fn swing_sole_of_a_tilted_body_stays_level() {
        let mut feedback = feedback();
        for _ in 0..1000 {
            let tilted = BalanceState { tilt: Vector2::new(0.02, 0.03), ..at(0.0, 0.0) };
            feedback.update(&at(0.0, 0.0), Some(&tilted), false, 1e-3);
        }
        let mechanism = mechanism();
        let tree = dynamics::Tree::new(&mechanism);
        let mut angles = feedback.offsets().angles;
        [angles[Joint::FootRoll], angles[Joint::FootPitch]] = [0.02, 0.03];
        let sole = dynamics::Kinematics::fixed_base(&tree, &angles).sole_to_world(&mechanism, model::Side::Left);
        let up = sole.rotation * Vector3::z();
        assert!(up.xy().norm() < 1e-3, "{up}");
    }

    /// The oracle: an ankle drive as stiff as the feedback takes it to be, on a sole that a bump under its edge tilts.
    /// The ground pushes where it should again, however far the tilt shifted the ZMP.
    #[test]
    fn foot_damping_takes_back_the_zmp_shift_of_an_uneven_sole() {
        let mut feedback = feedback();
        let shifted = Vector2::new(0.2, -0.1);
        let mut zmp = shifted;
        for _ in 0..300 {
            feedback.update(&at(0.0, 0.0), Some(&BalanceState { zmp: Some(zmp), ..at(0.0, 0.0) }), false, 1e-3);
            let offsets = feedback.offsets().angles;
            let lean = Vector2::new(offsets[Joint::RightAnkleRoll], offsets[Joint::RightAnklePitch]);
            let lean = Vector2::new(feedback.support_axes[0].x * lean.x, feedback.support_axes[1].y * lean.y);
            zmp = shifted + Vector2::new(-lean.y, lean.x) / feedback.lean_per_shift;
        }
        assert!(zmp.norm() < 1e-3, "{zmp}");
    }

    #[test]
    fn foot_damping_takes_an_error_back_once_however_long_the_period() {
        let mut feedback = feedback();
        let zmp = Vector2::new(-0.1, 0.03);
        for dt in [0.03, 0.1, 1.0] {
            feedback.release();
            feedback.update(&at(0.0, 0.0), Some(&BalanceState { zmp: Some(zmp), ..at(0.0, 0.0) }), false, dt);
            let shift = Vector2::new(-feedback.lean().y, feedback.lean().x) / feedback.lean_per_shift;
            assert!((shift + zmp).norm() < 1e-9, "{dt} s: {shift}");
        }
    }

    /// The oracle: statics of a rigid body on an ankle. A sole turned by a stone turns the body with it; once the ankle
    /// has turned back by as much, the body is upright.
    #[test]
    fn body_over_a_sole_that_a_stone_tilts_stays_upright() {
        let mut feedback = feedback();
        let tilt = Vector2::new(0.05, -0.03);
        for _ in 0..1000 {
            let foot = Some(SupportFoot { tilt, is_flat: true });
            let state = BalanceState { foot, zmp: Some(Vector2::zeros()), ..at(0.0, 0.0) };
            feedback.update(&BalanceState { zmp: Some(Vector2::zeros()), ..at(0.0, 0.0) }, Some(&state), false, 1e-3);
        }
        let offsets = feedback.offsets().angles;
        let at_ankle: Vector2<f64> =
            std::iter::zip(SUPPORT_ANKLE, feedback.support_axes).map(|(joint, axis)| axis.xy() * offsets[joint]).sum();
        // Less what is left to the yielding of joints.
        let left = (at_ankle + tilt).norm();
        assert!(left < 1.5 * SOLE_TILT_OF_YIELDING && left < tilt.norm() / 2.0, "{at_ankle}");
    }

    /// A push tips the sole over its edge, with the whole body on it: the ankle must not turn it further.
    #[test]
    fn ankle_leaves_a_sole_alone_that_a_push_tips() {
        let lean = |foot| {
            let mut feedback = feedback();
            for _ in 0..200 {
                let pushed = BalanceState { foot, ..at(0.0, -0.1) };
                feedback.update(&at(0.0, 0.0), Some(&pushed), false, 1e-3);
                if feedback.is_recovering() {
                    break;
                }
            }
            for _ in 0..200 {
                feedback.update(&at(0.0, 0.0), Some(&BalanceState { foot, ..at(0.0, -0.1) }), false, 1e-3);
            }
            feedback.lean()
        };
        let tipped = Some(SupportFoot { tilt: Vector2::new(0.3, 0.0), is_flat: false });
        let on_ground = Some(SupportFoot { tilt: Vector2::new(0.3, 0.0), is_flat: true });
        assert!((lean(tipped) - lean(None)).norm() < 0.1);
        assert!((lean(on_ground) - lean(None)).norm() > 0.25);
    }

    #[test]
    fn released_feedback_keeps_no_lean() {
        let mut feedback = feedback();
        let zmp = Some(Vector2::new(-0.1, 0.03));
        feedback.update(&at(0.0, 0.0), Some(&BalanceState { zmp, ..at(0.0, 0.0) }), false, 1e-3);
        feedback.release();
        assert_eq!(feedback.lean(), Vector2::zeros());
        feedback.update(&at(0.0, 0.0), Some(&at(0.0, 0.0)), false, 1e-3);
        assert_eq!(feedback.lean(), Vector2::zeros());
    }

    /// The oracle: the same vector of the floor, seen from a right foot, and from a left one that has landed turned.
    #[test]
    fn error_keeps_its_direction_over_a_support_change_onto_a_turned_foot() {
        let mut feedback = feedback();
        for _ in 0..1000 {
            feedback.update(&at(0.0, 0.0), Some(&at(0.08, 0.02)), false, 1e-3);
        }
        let before = feedback.step_error.value();
        let turn = nalgebra::Rotation2::new(0.5);
        feedback.change_support(&Mirror::new(&mechanism()).unwrap(), turn * Vector2::x());
        let after = feedback.step_error.value();
        let seen_from_the_left = Vector2::new(after.x, -after.y);
        assert!((turn * seen_from_the_left - before).norm() < 1e-12, "{before} {after}");
    }
}
