//! Measures: a run in a few numbers.

use std::f64::consts::{PI, TAU};

use model::Mechanism;
use nalgebra::Vector2;
use serde::Serialize;

use super::{CostOfTransport, DriveEnergy, EndPose, Fall, FootPlacement, JointLoad, LeastMargin, RunLog};

/// A run in numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measures {
    /// Half-steps completed.
    pub half_steps: u64,
    /// Walked distance (m): the length of the line through the middles between consecutive footprints. So the sway of
    /// the body from foot to foot does not count, and a half-step of the nominal counts its step length.
    pub distance_m: f64,
    /// Where the controller estimates to have come.
    #[serde(flatten)]
    pub estimated: EndPose,
    /// Where the robot has come; `None` if its true states were not recorded.
    #[serde(rename = "true")]
    pub truth: Option<EndPose>,
    /// Least margin of the measured ZMP (mm) away from support changes, at which it moves from foot to foot; `None` if
    /// it was never measured.
    pub min_margin_mm: Option<f64>,
    /// The same with its place in the walk.
    pub least_margin: Option<LeastMargin>,
    /// Root of the mean square of the distance between the measured and the planned ZMP (mm), away from support
    /// changes; `None` if it was never measured.
    pub zmp_error_rms_mm: Option<f64>,
    /// Energy of the drives; `None` if they were not recorded.
    pub energy: Option<DriveEnergy>,
    /// Energy over weight and distance; `None` if the drives were not recorded, or the robot hardly went anywhere.
    pub cost_of_transport: Option<CostOfTransport>,
    /// The greatest loads on the drives, joint by joint; empty if they were not recorded.
    pub joint_loads: Vec<JointLoad>,
    /// Number of falls.
    pub falls: usize,
    /// The first fall; absent in JSON if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fall: Option<Fall>,
}

impl RunLog {
    /// Computes the measures of the run.
    pub fn measures(&self, mechanism: &Mechanism) -> Measures {
        let prints = self.footprints(mechanism);
        // A reset after a fall begins to count anew.
        let done = self.controller.windows(2).map(|rows| rows[1].half_step.saturating_sub(rows[0].half_step));
        let distance_m = distance(&prints);
        let (least_margin, drives) = (self.least_margin(), &self.totals.drives);
        Measures {
            half_steps: done.sum(),
            distance_m,
            estimated: self.estimated_end(),
            truth: if self.is_estimated { None } else { self.true_end(mechanism, heading_change(&prints)) },
            min_margin_mm: least_margin.map(|least| least.margin_mm),
            least_margin,
            zmp_error_rms_mm: self.totals.zmp_error.rms().map(|error| error * 1e3),
            energy: drives.energy(mechanism),
            cost_of_transport: drives.cost_of_transport(mechanism, distance_m),
            joint_loads: drives.loads(mechanism),
            falls: self.falls().count(),
            fall: self.first_fall(mechanism),
        }
    }

    /// Times of the falls (s).
    pub fn falls(&self) -> impl Iterator<Item = f64> {
        let begins_fallen = self.plant.first().filter(|row| row.fallen).map(|row| row.time);
        let falls = self.plant.windows(2).filter(|pair| !pair[0].fallen && pair[1].fallen).map(|pair| pair[1].time);
        begins_fallen.into_iter().chain(falls)
    }
}

/// Length of the line through the middles between consecutive footprints (m).
fn distance(prints: &[FootPlacement]) -> f64 {
    let place = |print: &FootPlacement| print.sole_to_world.translation.vector.xy();
    let middles: Vec<Vector2<f64>> = prints.windows(2).map(|pair| (place(&pair[0]) + place(&pair[1])) / 2.0).collect();
    middles.windows(2).fold(0.0, |sum, pair| sum + (pair[1] - pair[0]).norm())
}

/// Change of the mean heading of two consecutive footprints, from the first pair to the last (rad): a half-finished
/// turn counts half.
fn heading_change(prints: &[FootPlacement]) -> f64 {
    // No foot turns by half a circle from one footprint to the next.
    let turns: Vec<f64> = prints.windows(2).map(|pair| to_half_circle(pair[1].heading() - pair[0].heading())).collect();
    turns.windows(2).fold(0.0, |sum, pair| sum + (pair[0] + pair[1]) / 2.0)
}

/// The same angle between −π and π.
fn to_half_circle(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{log, mechanism};

    #[test]
    fn distance_of_a_straight_walk_is_the_sum_of_its_steps() {
        let measures = log(8, 0.0).measures(&mechanism());
        // The first middle lies between both feet at rest, the second half a step ahead, the others a step apart.
        assert!((measures.distance_m - (0.125 + 7.0 * 0.25)).abs() < 1e-12, "{measures:?}");
        assert_eq!((measures.half_steps, measures.falls), (8, 0));
        assert!(measures.truth.is_some_and(|end| end.heading_deg.abs() < 1e-9));
        assert!(measures.min_margin_mm.is_some_and(|margin| (margin - 20.0).abs() < 1e-12));
    }

    #[test]
    fn a_margin_at_a_support_change_does_not_count() {
        let mut log = log(3, 0.0);
        let change = log.controller.iter_mut().find(|row| !row.is_off_support_changes()).unwrap();
        change.margin = Some(-0.001);
        let off = log.controller.iter_mut().find(|row| row.is_off_support_changes()).unwrap();
        off.margin = Some(0.012);
        assert!(log.measures(&mechanism()).min_margin_mm.is_some_and(|margin| (margin - 12.0).abs() < 1e-12));
    }

    #[test]
    fn heading_counts_beyond_a_full_circle_to_either_side() {
        for turn_deg in [10.0_f64, -10.0] {
            let heading = super::heading_change(&log(45, turn_deg.to_radians()).footprints(&mechanism())).to_degrees();
            // From the mean of the first two prints, 0° and 0°, to that of the last two, 440° and 450°.
            assert!((heading - 44.5 * turn_deg).abs() < 1e-9, "{heading}");
        }
    }

    #[test]
    fn measures_count_each_fall_once() {
        let mut log = log(3, 0.0);
        for tick in [4, 5, 6, 12, 13] {
            log.plant[tick].fallen = true;
        }
        assert_eq!(log.falls().collect::<Vec<_>>(), [log.plant[4].time, log.plant[12].time]);
    }

    #[test]
    fn measures_of_an_empty_log_are_zero() {
        let measures = super::RunLog::default().measures(&mechanism());
        assert_eq!((measures.half_steps, measures.distance_m, measures.min_margin_mm), (0, 0.0, None));
    }
}
