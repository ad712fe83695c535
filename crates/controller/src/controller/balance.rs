//! What feedback, landing compliance and steps make of the measured balance.

use dynamics::SupportPolygon;
use interface::Capturability;
use model::{ComState, Side};
use nalgebra::{Point3, Vector2};
use pattern::{BodyTilt, MeasuredBalance};
use stabilizer::{BalanceState, CaptureEvidence};

use super::Controller;

/// Least time for which measurements call for another step before one is made (s): a faulty sensor is noticed within
/// it.
const PUSH_SEEN_MIN: f64 = 0.005;

impl Controller {
    /// Updates feedback, landing compliance and step adjustment with the centre of mass, estimated or predicted.
    pub(super) fn balance(&mut self, com: Option<ComState>, dt: f64) {
        // On the way to a stand the robot balances on both feet.
        let balances = self.follows_walk() || self.state.is_recovering();
        if !balances {
            self.feedback.release();
        }
        let com = com.filter(|_| balances);
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

        self.judge_capturability(com.as_ref(), dt);
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

    /// Judges whether the robot can still be kept from falling. Where its centre of mass is not known, and in the air,
    /// only its tilt tells.
    fn judge_capturability(&mut self, com: Option<&ComState>, dt: f64) {
        let gait = self.pattern.gait();
        let (can_step, is_recovering) = (!gait.in_double_support(), self.feedback.is_recovering());
        let shortfall = com.and_then(|com| {
            let dcm = com.divergent_component();
            if !can_step {
                Some((-self.planned_support().margin(dcm)).max(0.0))
            } else if is_recovering {
                let zmp_bounds = self.feedback.zmp_bounds();
                gait.shortfall(&MeasuredBalance { dcm, zmp_bounds }).map(|shortfall| shortfall.norm())
            } else {
                Some(0.0)
            }
        });
        let evidence = CaptureEvidence { is_recovering, shortfall, can_step, tilt: self.tilt.norm() };
        self.capturability.update(&evidence, dt);
    }

    /// What it takes to keep the robot from falling; `None` while it holds a posture, whoever keeps it there.
    pub(super) fn capturability(&self) -> Option<Capturability> {
        if self.state.has_fallen() {
            return Some(Capturability::Lost);
        }
        self.follows_walk().then(|| self.capturability.capturability())
    }

    /// The polygon of both soles as planned.
    fn planned_support(&self) -> SupportPolygon {
        let corners = Side::BOTH.into_iter().flat_map(|side| {
            let sole = self.reference.kinematics().sole_to_world(&self.mechanism, side);
            self.mechanism.sole.corners(side).map(|corner| (sole * Point3::from(corner)).coords.xy())
        });
        SupportPolygon::hull(corners)
    }
}
