//! Where the robot is: at the start, when it comes back, and before a reset.
//!
//! The joints must not jump to where the controller would have them. A robot that is where the gait begins walks or
//! stands at once. One that stands is taken over as it stands. Any other holds its posture until it is put in a stand.

use interface::{Fault, Rejection, Sensor};
use model::{Joint, JointVector};
use stabilizer::GroundSlopeFilter;

use super::Controller;
use crate::pattern::Pattern;
use crate::recovery::Recovery;

/// Largest difference of a joint from its first setpoint with which a gait begins (rad): drives yield to the weight.
const START_TOLERANCE: f64 = 0.05;
/// Largest difference of a joint of a leg or the waist from its angle in a stand from which a robot on its feet can
/// move to that stand (rad): its feet slide by a few centimetres at most. Arms may be anywhere: their place depends on
/// the step after which the robot stopped.
pub(super) const STAND_TOLERANCE: f64 = 0.12;

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

    /// The joint of a leg or the waist that is farthest from its angle in a stand, and by how much (rad).
    pub(super) fn distance_from_stand(&self, measured: &JointVector) -> (Joint, f64) {
        largest_difference(measured, &self.rest.physical_motion().angles, |joint| !joint.is_in_arm())
    }

    fn is_near_stand(&self, measured: &JointVector) -> bool {
        matches!(self.pattern, Pattern::Planned(_)) && self.distance_from_stand(measured).1 <= STAND_TOLERANCE
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
