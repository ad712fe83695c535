//! What a measurement says about the robot: the contacts of its feet, its tilt, and its centre of mass.

use interface::{Fault, Faults, Measurement, SensorGroup};
use model::{ComState, GRAVITY, JointVector, Mechanism, Side};
use nalgebra::{Vector2, Vector3};
use pattern::GaitPhase;
use stabilizer::{
    AccelerationEvidence, BalanceState, ContactEstimate, SupportFoot, SupportFrameMeasurement, estimate_com,
    level_specific_force,
};

use super::Controller;
use crate::measurement_validator::UsableSample;
use crate::sensor_consistency::{Expectation, ExpectedSupport};

/// With the measured ZMP this far inside a sole (m), the whole sole is on the ground.
const FLAT_MARGIN: f64 = 0.005;
/// Share of a half-step at both of its ends in which either foot may carry the robot: the swing sole is lower than a
/// fifth of its clearance, and on uneven ground lands early or late.
const EITHER_FOOT: f64 = 0.18;

impl Controller {
    /// Absorbs what arrived within a period, and returns the centre of mass as a new sample has it; `None` without one,
    /// and in the air.
    pub(super) fn estimate(
        &mut self,
        measurement: Option<&Measurement>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<ComState> {
        // A robot that has fallen is moved by others.
        let followed = self.last_setpoint.filter(|_| self.state.plays_gait());
        let support = self.expected_support();
        let expected = followed.as_ref().map(|setpoint| Expectation {
            setpoint,
            yielding: &self.yielding,
            deflection: self.deflection.angles(),
            support,
        });
        let usable = self.validator.update(measurement, expected.as_ref(), dt, faults);
        if self.validator.is_stale() && self.state.latched().is_none() {
            self.latch(Fault::MeasurementStale);
        }
        if self.validator.has_fallen() {
            faults.insert(Fault::Fallen);
            self.state.fall();
        }
        self.com_filter.advance(dt);
        self.since_sample += dt;
        let had_fault = std::mem::replace(&mut self.has_sensor_fault, self.validator.rejection().is_some());
        if self.has_sensor_fault && !had_fault {
            self.com_filter.distrust();
            self.ground_slope.distrust();
        }
        let Some(sample) = usable else {
            let support = self.pattern.gait().half_step().support;
            self.odometry.update(support, self.reference.kinematics(), None, dt);
            return None;
        };
        if self.validator.has_found_robot() {
            self.find_robot(&sample.measurement.angles);
        }
        let since_sample = std::mem::take(&mut self.since_sample);
        self.absorb(&sample, since_sample, faults)
    }

    /// Absorbs what can be used of a sample.
    ///
    /// * `dt` – time since the sample before (s)
    fn absorb(&mut self, sample: &UsableSample, dt: f64, faults: &mut Faults) -> Option<ComState> {
        let UsableSample { mut measurement, unusable } = *sample;
        self.measured_angles = Some(measurement.angles);
        let usable = |group| !unusable.contains(group);
        let orientation = usable(SensorGroup::Orientation).then_some(&measurement.orientation);
        let rate = usable(SensorGroup::AngularRate).then_some(&measurement.angular_rate);
        self.attitude.update(orientation, rate, dt);
        measurement.angular_rate -= self.attitude.gyro_bias();

        let up_in_trunk = self.attitude.up_in_trunk();
        let gait = self.pattern.gait_mut();
        let (support, mirror) = (gait.half_step().support, gait.walk().mirror());
        let up = up_in_trunk.unwrap_or_else(Vector3::z);
        let mut measured = SupportFrameMeasurement::new(support, mirror, &measurement, up, unusable);
        self.kinematics.compute_fixed_base(&self.tree, &measured.angles);
        if up_in_trunk.is_none() {
            // Nothing tells the vertical but a sole that lies flat.
            let vertical = gait.sensed_vertical().push(1.0).normalize();
            measured.up_in_trunk = self.kinematics.rotation[Mechanism::TRUNK].tr_mul(&vertical);
        }
        // An orientation that is known to be askew still serves to come to a stand.
        if let Some(askew) = self.gravity.askew(support) {
            measured.up_in_trunk = (measured.up_in_trunk + askew.push(0.0)).normalize();
        }
        let heading = self.attitude.attitude().filter(|_| usable(SensorGroup::Orientation));
        self.odometry.update(support, &self.kinematics, heading.as_deref(), dt);
        // Forces that cannot be used, which may be NaN, are those of the plan.
        let torques_beyond;
        (self.contact, torques_beyond) = if Side::BOTH.into_iter().all(|side| usable(SensorGroup::of_foot(side))) {
            let feet = [measured.support_foot, measured.swing_foot];
            let contact = self.zmp_estimator.update(&measured, &self.kinematics, &self.mechanism, dt);
            (contact, self.reference.torques_beyond(&self.tree, &self.mechanism, feet))
        } else {
            (ContactEstimate::unknown(self.tree.mass * GRAVITY), JointVector::ZERO)
        };
        self.deflection.update(&mirror.to_physical(support, &torques_beyond), dt);
        if self.contact.in_contact == [false, false] {
            faults.insert(Fault::InTheAir);
            self.feedback.release();
            self.com_filter.restart();
            return None;
        }
        // A sole that is not on an edge lies flat; bearing alone, it leans as the floor does.
        let is_flat = self.contact.margin > FLAT_MARGIN;
        let up = measured.up_over_sole(&self.kinematics).xy();
        let tells_ground =
            [SensorGroup::Joints, SensorGroup::Orientation, SensorGroup::RightFoot, SensorGroup::LeftFoot];
        if tells_ground.into_iter().all(usable) {
            self.ground_slope.update(&self.mechanism, &measured, &self.kinematics, is_flat, self.contact.in_contact);
        }
        gait.update_ground_slope(self.ground_slope.vertical(), dt);
        self.support_foot = self.contact.in_contact[0].then(|| {
            // Under the first sole the slope is not known yet: the plan leans first.
            let is_known = gait.half_step().index > 0;
            let beyond = if is_known { up - self.reference.vertical() } else { Vector2::zeros() };
            SupportFoot { tilt: Vector2::new(beyond.y, -beyond.x), is_flat }
        });
        self.tilt = self.reference.tilt(&measured.up_in_trunk, gait.sensed_vertical());
        let com = estimate_com(&self.tree, &self.kinematics, &measured, &self.contact);
        let planned_force = self.reference.specific_force_of_trunk();
        let force = level_specific_force(&self.kinematics, &measured);
        let evidence = AccelerationEvidence {
            zmp: self.contact.zmp.map(|zmp| zmp - self.reference.zmp),
            acceleration: force.map(|force| (force - planned_force).xy()),
            is_flat,
        };
        self.com_filter.absorb(&com, &self.reference.com, &evidence);
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use config::Config;
    use gait::{NominalTable, Start};
    use interface::SensorGroups;
    use model::Wrench;
    use nalgebra::Quaternion;

    use super::*;
    use crate::Parameters;

    /// Forces that are no numbers leave no trace: joints are then expected where the plan has them.
    #[test]
    fn forces_that_are_no_numbers_deflect_no_drive() {
        let file = |name: &str| format!("{}/../../config/{name}", env!("CARGO_MANIFEST_DIR"));
        let mechanism = Mechanism::load(file("mechanism.toml")).unwrap();
        let table = Arc::new(NominalTable::read_csv(file("nominal_half_step.csv").as_ref()).unwrap());
        let parameters = Parameters::load(file("controller.toml")).unwrap();
        let mut controller = Controller::new(&mechanism, table, &parameters, Start::default()).unwrap();
        let weight = Wrench { force: Vector3::new(0.0, 0.0, mechanism.mass() * GRAVITY), moment: Vector3::zeros() };
        let mut deflections = Vec::new();
        for sample in 0..30 {
            let setpoint = controller.last_setpoint.unwrap_or_default();
            let mut feet = [weight, Wrench::ZERO];
            if sample == 10 {
                feet[0].force.x = f64::NAN;
                feet[1].moment.y = f64::INFINITY;
            }
            let measurement = Measurement {
                sample,
                angles: setpoint.angles,
                rates: setpoint.rates,
                feet,
                orientation: Quaternion::identity(),
                angular_rate: Vector3::zeros(),
                specific_force: Vector3::z() * GRAVITY,
                currents: JointVector::ZERO,
                missing: SensorGroups::NONE,
            };
            controller.tick(1e-3, Some(&measurement));
            deflections.push(*controller.deflection.angles());
        }
        let is_finite = |angles: &JointVector| angles.0.iter().all(|angle| angle.is_finite());
        assert!(deflections.iter().all(is_finite));
        assert!(deflections[29].0.iter().any(|angle| *angle != 0.0), "the forces before and after count");
    }
}
