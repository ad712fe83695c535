//! What feedback, landing compliance and steps make of the measured balance.

use model::ComState;
use nalgebra::Vector2;
use pattern::{BodyTilt, MeasuredBalance};
use stabilizer::BalanceState;

use super::Controller;

/// Least time for which measurements call for another step before one is made (s): a faulty sensor is noticed within
/// it.
const PUSH_SEEN_MIN: f64 = 0.005;

impl Controller {
    /// Updates feedback, landing compliance and step adjustment with the centre of mass, estimated or predicted.
    pub(super) fn balance(&mut self, com: Option<ComState>, dt: f64) {
        let follows_walk = self.follows_walk();
        if !follows_walk {
            self.feedback.release();
        }
        let com = com.filter(|_| follows_walk);
        let in_double_support = self.pattern.gait().in_double_support();
        let is_changing_support = self.pattern.gait().is_changing_support();

        // A foot that bears alone says where the ground pushes.
        let zmp = self.contact.zmp.filter(|_| self.contact.in_contact == [true, false] && !is_changing_support);
        let measured = com.map(|com| BalanceState { com, tilt: self.tilt, zmp, foot: self.support_foot });
        self.feedback.update(&BalanceState::planned(&self.reference), measured.as_ref(), in_double_support, dt);

        // On both feet the weight moves to and fro as the robot comes to rest.
        let complies = !in_double_support && !is_changing_support && !self.feedback.is_error_large();
        let loads = com.filter(|_| complies).map(|_| self.contact.loads);
        self.landing.update(loads, dt);

        let gait = self.pattern.gait_mut();
        let tilt = if com.is_some() && !in_double_support { self.tilt } else { Vector2::zeros() };
        gait.set_tilt(BodyTilt { tilt, in_recovery: self.feedback.is_recovering() });
        if com.is_none() || in_double_support || !self.feedback.is_recovering() {
            self.push_seen_for = 0.0;
            return;
        }
        let dcm = self.reference.com.divergent_component() + self.feedback.step_error();
        let choice = gait.choose_step(&MeasuredBalance { dcm, zmp_bounds: self.feedback.zmp_bounds() });
        // A period without a new sample is no reason to wait longer.
        let is_seen = choice.is_some() && !self.has_sensor_fault;
        self.push_seen_for = if is_seen { self.push_seen_for + dt } else { 0.0 };
        if let Some(choice) = choice.filter(|_| self.push_seen_for > PUSH_SEEN_MIN) {
            gait.adjust_step(choice);
        }
    }
}
