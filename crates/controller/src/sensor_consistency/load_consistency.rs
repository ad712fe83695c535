//! The forces on the feet against the weight, and against the foot that carries the robot.

use interface::{Fault, Rejection, Sensor};

use super::expectation::ExpectedSupport;

/// Time over which the mean load is formed (s): impacts are shorter.
const TIME_CONSTANT: f64 = 0.1;
/// Largest share of the weight on a foot that does not carry the robot (-).
const UNLOADED: f64 = 0.07;
/// Least share of the weight on a foot that does (-).
const CARRYING: f64 = 0.3;
/// Longest time for which the other foot may carry the robot (s): on uneven ground the weight changes late.
const OTHER_FOOT_MAX: f64 = 0.01;

/// Finds force sensors that are dead, saturated or exchanged. Only in a walk: a robot that stands may be lifted.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LoadConsistency {
    /// Mean of the force on both feet, less the weight, as a share of the weight (-).
    excess: f64,
    /// How long the other foot has carried the robot (s).
    on_other_foot: f64,
}

impl LoadConsistency {
    /// Absorbs the forces on the right and on the left foot, as shares of the weight.
    ///
    /// * `share` – least and largest mean share on both
    pub(super) fn update(
        &mut self,
        feet: [f64; 2],
        support: Option<ExpectedSupport>,
        share: [f64; 2],
        dt: f64,
    ) -> Option<Rejection> {
        let Some(support) = support else {
            *self = Self::default();
            return None;
        };
        self.excess += (feet[0] + feet[1] - 1.0 - self.excess) * dt / (TIME_CONSTANT + dt);
        let is_off = !(share[0]..=share[1]).contains(&(1.0 + self.excess));
        let is_other_foot = match support {
            ExpectedSupport::AnyFoot => false,
            ExpectedSupport::OneFoot(side) => {
                let [carrying, swinging] = side.support_first(feet);
                carrying < UNLOADED && swinging > CARRYING
            }
        };
        self.on_other_foot = if is_other_foot { self.on_other_foot + dt } else { 0.0 };
        (is_off || self.on_other_foot > OTHER_FOOT_MAX)
            .then_some(Rejection { fault: Fault::MeasurementInconsistent, sensor: Sensor::Feet })
    }
}

#[cfg(test)]
mod tests {
    use model::Side;

    use super::*;

    fn rejected_after(feet: [f64; 2], support: Option<ExpectedSupport>) -> Option<u32> {
        let mut loads = LoadConsistency::default();
        (0..1000).find(|_| loads.update(feet, support, [0.6, 1.5], 1e-3).is_some())
    }

    #[test]
    fn feet_that_carry_nothing_or_twice_the_weight_in_a_walk_are_named() {
        let walking = Some(ExpectedSupport::OneFoot(Side::Right));
        assert_eq!(rejected_after([1.0, 0.0], walking), None);
        assert!((30..60).contains(&rejected_after([0.0, 0.0], walking).unwrap()));
        assert!((50..90).contains(&rejected_after([1.0, 1.0], walking).unwrap()));
        assert_eq!(rejected_after([0.0, 0.0], None), None, "a robot that stands may be lifted");
    }

    #[test]
    fn feet_that_are_exchanged_are_named() {
        let after = rejected_after([0.0, 1.0], Some(ExpectedSupport::OneFoot(Side::Right)));
        assert!((9..=11).contains(&after.unwrap()), "after {after:?} ms");
        assert_eq!(rejected_after([0.0, 1.0], Some(ExpectedSupport::AnyFoot)), None);
    }
}
