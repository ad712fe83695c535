//! What the drives of a run yielded and took: peaks of each joint, and energy.

use model::{GRAVITY, Joint, LegReach, Mechanism, Motor, PerJoint};
use serde::Serialize;

use super::DriveRow;

/// Least way of the paper's robot that has a cost (m); others go in proportion.
const DISTANCE_MIN: f64 = 0.5;
/// Longest time that a row stands for (s): in a gap of the recording nothing is counted.
const LASTS_MAX: f64 = 0.05;

/// The greatest load on the drive of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointLoad {
    /// The joint.
    pub joint: Joint,
    /// Greatest torque at the joint, either way (N·m).
    pub peak_torque_n_m: f64,
    /// The torque over what the drive has at standstill (-).
    pub torque_share: f64,
    /// Greatest voltage over that of the supply (-): with the back-EMF of the rate, it is what bounds a DC motor.
    /// `None` for another drive.
    pub voltage_share: Option<f64>,
    /// Greatest current, either way (A); `None` for a drive other than a DC motor.
    pub peak_current_a: Option<f64>,
}

/// Energy over weight and distance (-): Collins, Ruina, Tedrake and Wisse, "Efficient bipedal robots based on
/// passive-dynamic walkers", Science 307 (2005).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CostOfTransport {
    /// Of the electrical energy that the drives take, `c_et`; `None` if a drive is no DC motor.
    pub electrical: Option<f64>,
    /// Of the positive mechanical work of the joints, `c_mt`.
    pub mechanical: f64,
}

/// Energy that the drives took and gave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DriveEnergy {
    /// Electrical energy that the drives took (J); `None` if a drive is no DC motor.
    pub electrical_j: Option<f64>,
    /// Positive mechanical work of the joints (J).
    pub mechanical_j: f64,
}

/// Sums and peaks over all rows of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct DriveAccount {
    peaks: PerJoint<Peak>,
    /// What the DC motors took, each without giving anything back (J).
    electrical: f64,
    /// Positive work of the joints (J).
    mechanical: f64,
    before: Option<f64>,
}

/// The greatest values of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Peak {
    torque: f64,
    current: f64,
    voltage: f64,
}

impl DriveAccount {
    /// Adds a row; rows come in order of time.
    pub(super) fn add(&mut self, mechanism: &Mechanism, row: &DriveRow) {
        let lasts = self.before.replace(row.time).map_or(0.0, |before| row.time - before);
        let lasts = if lasts <= LASTS_MAX { lasts } else { 0.0 };
        for joint in Joint::ALL {
            let (torque, rate) = (row.torques[joint], row.rates[joint]);
            let peak = &mut self.peaks[joint];
            // Of NaN and a number, `max` is the number.
            peak.torque = peak.torque.max(torque.abs());
            self.mechanical += (torque * rate).max(0.0) * lasts;
            if let Some(Motor::Dc(motor)) = &mechanism.links[joint].motor {
                let voltage = motor.voltage(row.currents[joint], rate);
                peak.current = peak.current.max(row.currents[joint].abs());
                peak.voltage = peak.voltage.max(voltage.abs());
                self.electrical += (voltage * row.currents[joint]).max(0.0) * lasts;
            }
        }
    }

    /// The loads of the joints that the robot has, in their order; none if nothing was measured.
    pub(super) fn loads(&self, mechanism: &Mechanism) -> Vec<JointLoad> {
        let load = |joint: Joint| {
            let (motor, peak) = (mechanism.links[joint].motor?, self.peaks[joint]);
            Some(JointLoad {
                joint,
                peak_torque_n_m: peak.torque,
                torque_share: peak.torque / motor.torque_max(),
                voltage_share: motor.dc().map(|dc| peak.voltage / dc.voltage_max),
                peak_current_a: motor.dc().map(|_| peak.current),
            })
        };
        if self.before.is_none() { Vec::new() } else { Joint::ALL.into_iter().filter_map(load).collect() }
    }

    /// The energy; `None` if nothing was measured.
    pub(super) fn energy(&self, mechanism: &Mechanism) -> Option<DriveEnergy> {
        let is_known = mechanism.links.0.iter().filter_map(|link| link.motor).all(|motor| motor.dc().is_some());
        let (electrical_j, mechanical_j) = (is_known.then_some(self.electrical), self.mechanical);
        self.before.map(|_| DriveEnergy { electrical_j, mechanical_j })
    }

    /// The cost of a way (m); `None` if nothing was measured, or the robot hardly went anywhere.
    pub(super) fn cost_of_transport(&self, mechanism: &Mechanism, distance: f64) -> Option<CostOfTransport> {
        let energy = self.energy(mechanism).filter(|_| distance > LegReach::of(mechanism).scale() * DISTANCE_MIN)?;
        let weight_times_way = mechanism.mass() * GRAVITY * distance;
        Some(CostOfTransport {
            electrical: energy.electrical_j.map(|taken| taken / weight_times_way),
            mechanical: energy.mechanical_j / weight_times_way,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{drives_at, mechanism};
    use super::*;

    #[test]
    fn energy_is_heat_and_work_and_nothing_comes_back() {
        let mechanism = mechanism();
        let mut account = DriveAccount::default();
        for tick in 0..=1000 {
            let mut row = drives_at(f64::from(tick) * 1e-3, &mechanism, |_| 0.0);
            // One joint drives, another one brakes.
            let knees = [(Joint::RightKnee, 3.0), (Joint::LeftKnee, -3.0)];
            for (knee, rate) in knees {
                (row.currents[knee], row.torques[knee], row.rates[knee]) = (2.0, 9.34, rate);
            }
            account.add(&mechanism, &row);
        }
        // 0.608 Ω × (2 A)² of heat, and 9.34 N·m × 3 rad/s of work; the braking one would give back more than its heat.
        let energy = account.energy(&mechanism).unwrap();
        assert!((energy.mechanical_j - 28.02).abs() < 1e-6, "{energy:?}");
        assert!((energy.electrical_j.unwrap() - (2.432 + 28.02)).abs() < 1e-6, "{energy:?}");
        let cost = account.cost_of_transport(&mechanism, 2.0).unwrap();
        assert!((cost.mechanical * mechanism.mass() * 9.80665 * 2.0 - 28.02).abs() < 0.01, "{cost:?}");
        assert_eq!(account.cost_of_transport(&mechanism, 0.1), None);

        let loads = account.loads(&mechanism);
        let knee = loads.iter().find(|load| load.joint == Joint::LeftKnee).unwrap();
        assert_eq!((loads.len(), knee.peak_torque_n_m, knee.peak_current_a), (18, 9.34, Some(2.0)));
        // 48 V over 0.608 Ω yield 368.7 N·m at standstill.
        assert!((knee.torque_share - 9.34 / 368.684).abs() < 1e-5, "{knee:?}");
        // Braking, the back-EMF of 4.67 V/(rad/s) × 3 rad/s is against the 1.216 V of the resistance.
        assert!((knee.voltage_share.unwrap() - (14.01 - 1.216) / 48.0).abs() < 1e-9, "{knee:?}");
    }

    #[test]
    fn a_gap_costs_nothing_and_missing_values_count_as_none() {
        let mechanism = mechanism();
        let mut account = DriveAccount::default();
        assert_eq!((account.energy(&mechanism), account.loads(&mechanism).len()), (None, 0));
        for time in [0.0, 10.0, 10.001] {
            let mut row = drives_at(time, &mechanism, |_| 1.0);
            row.rates[Joint::RightKnee] = f64::NAN;
            account.add(&mechanism, &row);
        }
        let resistances = 13.0 * 0.608 + 4.0 * 1.16;
        let taken = account.energy(&mechanism).unwrap().electrical_j.unwrap();
        assert!((taken - resistances * 0.001).abs() < 1e-9, "a millisecond of seventeen motors: {taken}");
    }
}
