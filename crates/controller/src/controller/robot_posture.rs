//! Where the robot is: at the start, when it comes back, and before a reset.
//!
//! The joints must not jump to where the controller would have them. A robot that is where the gait begins walks or
//! stands at once. One that stands is taken over as it stands. Any other holds its posture until it is put in a stand.

use interface::{ActiveLimit, Fault, Objection, Reason, Rejection, Sensor};
use model::{Joint, JointVector, LegReach, Motion, Side};
use nalgebra::Vector3;
use stabilizer::GroundSlopeFilter;

use super::Controller;
use crate::pattern::Pattern;
use crate::recovery::Recovery;

/// Largest difference of a joint from its first setpoint with which a gait begins (rad): drives yield to the weight.
const START_TOLERANCE: f64 = 0.05;
/// Largest difference of a joint of a leg or the waist from its angle in a stand from which a robot on its feet can
/// move to that stand (rad): its feet slide by a few centimetres at most. Arms may be anywhere: their place depends on
/// the step after which the robot stopped.
const STAND_TOLERANCE: f64 = 0.12;
/// Largest tilt of the trunk from which a robot can move to a stand (rad): on the steepest floor that it can walk on,
/// with every joint off by as much as it may be, it leans less.
pub(super) const STAND_TILT_MAX: f64 = 0.2;
/// Least distance of the centre of mass, seen from above, from the edges of both soles together with which a robot on
/// its feet can move to a stand (m), for the paper's leg.
const COM_MARGIN_MIN: f64 = 0.01;
/// Largest angle between both soles (rad), and difference of their heights (m, for the paper's leg), with which both
/// bear on the same floor.
const SOLE_TILT_MAX: f64 = 0.04;
const SOLE_HEIGHT_MAX: f64 = 0.012;

impl Controller {
    /// Takes note of a robot that sends its first measurement, or the first one since another robot was lost.
    ///
    /// * `measured` – its joint angles (rad)
    pub(super) fn find_robot(&mut self, measured: &JointVector) {
        let (joint, difference) = largest_difference(measured, &self.limiter.hold().angles, |_| true);
        if difference <= START_TOLERANCE {
            return;
        }
        self.limiter.start_at(measured);
        if self.state.latched().is_none() && self.is_near_stand(measured) {
            self.recover(measured);
        } else {
            let rejection = Rejection { fault: Fault::UnexpectedPosture, sensor: Sensor::JointAngle(joint) };
            self.unexpected_posture = Some(rejection);
            self.state.hold_posture(Fault::UnexpectedPosture);
        }
    }

    /// Why a robot on its feet with these joint angles (rad) cannot move to a stand; `None` if it can.
    pub(super) fn objection_to_posture(&mut self, measured: &JointVector) -> Option<Objection> {
        let wanted = self.rest.physical_motion().angles;
        let (joint, value) = largest_difference(measured, &wanted, |joint| !joint.is_in_arm());
        if value > STAND_TOLERANCE {
            let limit = ActiveLimit { joint: Some(joint), value, limit: STAND_TOLERANCE };
            return Some(Objection { reason: Reason::NotInStand, active_limit: Some(limit) });
        }
        let gait = self.pattern.gait();
        let angles = gait.walk().mirror().to_support(gait.half_step().support, &Motion::at_rest(*measured)).angles;
        self.kinematics.compute_fixed_base(&self.tree, &angles);
        let other = self.kinematics.sole_to_world(&self.mechanism, Side::Left);
        let scale = LegReach::of(&self.mechanism).scale();
        let tilt = (other.rotation * Vector3::z()).xy().norm();
        if tilt > SOLE_TILT_MAX || other.translation.z.abs() > SOLE_HEIGHT_MAX * scale {
            return Some(Objection { reason: Reason::NotInStand, active_limit: None });
        }
        let (value, limit) = (self.com_over_soles(other.translation.y), COM_MARGIN_MIN * scale);
        let active_limit = Some(ActiveLimit { joint: None, value, limit });
        (value < limit).then_some(Objection { reason: Reason::Margin, active_limit })
    }

    /// Distance of the centre of mass, seen from above, from the edges of two soles that stand side by side (m),
    /// negative beyond them.
    ///
    /// * `across` – distance between the middles of the feet (m)
    fn com_over_soles(&self, across: f64) -> f64 {
        let com = self.kinematics.com(&self.tree);
        let sole = &self.mechanism.sole;
        let edges = [sole.ahead - com.x, com.x + sole.behind, com.y + sole.outside, across + sole.outside - com.y];
        edges.into_iter().fold(f64::INFINITY, f64::min)
    }

    fn is_near_stand(&mut self, measured: &JointVector) -> bool {
        matches!(self.pattern, Pattern::Planned(_)) && self.objection_to_posture(measured).is_none()
    }

    /// Moves slowly from these joint angles (rad) to a stand, if the gait is planned.
    pub(super) fn recover(&mut self, from: &JointVector) {
        let Pattern::Planned(generator) = &mut self.pattern else { return };
        generator.clone_from(&self.rest);
        self.limiter.start_at(from);
        self.unexpected_posture = None;
        // It may stand elsewhere.
        self.ground_slope = GroundSlopeFilter::new(&self.mechanism);
        self.state.recover(Recovery::begin(from, &generator.physical_motion().angles));
    }
}

/// The joint with a motor that differs most, among those that `counts` selects, and by how much (rad).
fn largest_difference(measured: &JointVector, wanted: &JointVector, counts: fn(Joint) -> bool) -> (Joint, f64) {
    Joint::ALL
        .into_iter()
        .filter(|&joint| joint.is_powered() && counts(joint))
        .map(|joint| (joint, (measured[joint] - wanted[joint]).abs()))
        .fold((Joint::FIRST_POWERED, 0.0), |largest, next| if next.1 > largest.1 { next } else { largest })
}
