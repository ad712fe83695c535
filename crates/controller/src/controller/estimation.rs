//! What a measurement says about the robot: the contacts of its feet, its tilt, and its centre of mass.

use interface::{Fault, Faults, Measurement};
use model::ComState;
use nalgebra::Vector2;
use pattern::GaitPhase;
use stabilizer::{BalanceState, ComPrediction, SupportFoot, SupportFrameMeasurement, estimate_com};

use super::Controller;
use crate::sensor_consistency::{Expectation, ExpectedSupport};

/// With the measured ZMP this far inside a sole (m), the whole sole is on the ground.
const FLAT_MARGIN: f64 = 0.005;
/// Share of a half-step at both of its ends in which either foot may carry the robot: the swing sole is lower than a
/// fifth of its clearance, and on uneven ground lands early or late.
const EITHER_FOOT: f64 = 0.18;

impl Controller {
    /// Absorbs a measurement and returns the measured centre of mass; `None` without a valid measurement, and in the
    /// air.
    pub(super) fn estimate(
        &mut self,
        measurement: Option<&Measurement>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<ComState> {
        // A robot that has fallen is moved by others.
        let followed = self.last_setpoint.filter(|_| self.state.plays_gait());
        let support = self.expected_support();
        let expected = followed.as_ref().map(|setpoint| Expectation { setpoint, yielding: &self.yielding, support });
        let valid = self.validator.update(measurement, expected.as_ref(), dt, faults);
        if self.validator.is_stale() && self.state.latched().is_none() {
            self.latch(Fault::MeasurementStale);
        }
        if self.validator.has_fallen() {
            faults.insert(Fault::Fallen);
            self.state.fall();
        }
        let support = self.pattern.gait().half_step().support;
        let Some((measurement, up_in_trunk)) = valid else {
            self.odometry.update(support, self.reference.kinematics(), None, dt);
            return None;
        };
        self.measured_angles = Some(measurement.angles);
        if self.validator.has_found_robot() {
            self.find_robot(&measurement.angles);
        }
        let gait = self.pattern.gait_mut();
        let mut measured = SupportFrameMeasurement::new(support, gait.walk().mirror(), measurement, up_in_trunk);
        // An orientation that is known to be askew still serves to come to a stand.
        if let Some(askew) = self.gravity.askew(support) {
            measured.up_in_trunk = (measured.up_in_trunk + askew.push(0.0)).normalize();
        }
        self.kinematics.compute_fixed_base(&self.tree, &measured.angles);
        self.odometry.update(support, &self.kinematics, Some(&measurement.orientation), dt);
        self.contact = self.zmp_estimator.update(&measured, &self.kinematics, &self.mechanism, dt);
        if self.contact.zmp.is_none() {
            faults.insert(Fault::InTheAir);
            self.feedback.release();
            self.com_prediction = ComPrediction::default();
            return None;
        }
        // A sole that is not on an edge lies flat; bearing alone, it leans as the floor does.
        let is_flat = self.contact.margin > FLAT_MARGIN;
        let up = measured.up_over_sole(&self.kinematics).xy();
        if is_flat && !self.contact.in_contact[1] {
            gait.update_ground_slope(up, dt);
        }
        self.support_foot = self.contact.in_contact[0].then(|| {
            // Under the first sole the slope is not known yet: the plan leans first.
            let is_known = gait.half_step().index > 0;
            let beyond = if is_known { up - self.reference.vertical() } else { Vector2::zeros() };
            SupportFoot { tilt: Vector2::new(beyond.y, -beyond.x), is_flat }
        });
        self.tilt = self.reference.tilt(&measured.up_in_trunk, gait.sensed_vertical());
        let com = estimate_com(&self.tree, &self.kinematics, &measured, &self.contact);
        self.com_prediction.absorb(&com, &self.reference.com, dt);
        Some(com)
    }

    /// Latches a fault if the measured vertical is not the one by which the robot moves.
    pub(super) fn check_gravity(&mut self, com: Option<&ComState>, dt: f64, faults: &mut Faults) {
        let gait = self.pattern.gait();
        let stands = self.follows_walk() && gait.in_double_support();
        let Some(&com) = com.filter(|_| stands) else { return self.gravity.interrupt() };
        let measured = BalanceState { com, tilt: self.tilt, zmp: self.contact.zmp, foot: self.support_foot };
        let planned = BalanceState::planned(&self.reference);
        if self.gravity.update(&measured, &planned, gait.half_step().support, dt) {
            faults.insert(Fault::OrientationAskew);
            self.latch(Fault::OrientationAskew);
        }
    }

    /// What must carry the robot now; `None` where anything may.
    fn expected_support(&self) -> Option<ExpectedSupport> {
        let gait = self.pattern.gait();
        let progress = gait.half_step().progress;
        if !self.follows_walk() || matches!(gait.phase(), GaitPhase::Standing(_) | GaitPhase::Starting) {
            None
        } else if gait.in_double_support() || progress.min(1.0 - progress) < EITHER_FOOT {
            Some(ExpectedSupport::AnyFoot)
        } else {
            Some(ExpectedSupport::OneFoot(gait.half_step().support))
        }
    }
}
