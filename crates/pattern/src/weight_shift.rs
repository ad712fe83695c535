//! The weight shift: how the weight moves between the feet of a robot that stands, before its first half-step and after
//! its last one.

use signal::smooth_step;

use crate::knot::KNOT;

/// A weight shift, and how much of it is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WeightShift {
    manner: Manner,
    /// Knots that all of it takes.
    knots: u32,
    /// Knots until it is over.
    knots_left: u32,
    /// Knots of a nominal half-step.
    half_step: u32,
}

/// How the weight moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Manner {
    /// From both feet to the support foot, so slowly that the centre of mass nearly comes to rest over it before the
    /// other foot is lifted. The robot must be able to stand on one foot.
    AtLeisure,
    /// From both feet first to the other foot, for about a half-step, and then over to the support foot: the centre of
    /// mass swings as in a walk, and turns round before it is over a foot.
    BySwaying,
    /// The same backward: from the foot that has landed, on which it stays for as long as a half-step, to both feet.
    AfterLanding,
}

/// Knots of a shift at leisure: 0.8 s, more than two time constants of the pendulum.
const KNOTS_AT_LEISURE: u32 = 80;
// How a robot sways that cannot stand on one foot, in half-steps. Chosen by trial with the two robots in the box that
// cannot. With a tenth of a half-step less on one foot, or on the way there, some of their starts and stops failed.
/// Time from both feet to one (half-steps).
const FROM_BOTH: f64 = 0.65;
/// Time on one foot (half-steps): longer than in a walk, since the centre of mass begins to swing at rest.
const ON_ONE: f64 = 1.3;
/// Time from one foot to the other one (half-steps).
const FROM_FOOT_TO_FOOT: f64 = 0.1;
/// Share of the weight on a foot meanwhile: the other one stays on the ground and helps to balance (-).
const ON_ONE_FOOT: f64 = 0.9;

impl WeightShift {
    /// A shift for a robot that can stand on one foot.
    pub(crate) const AT_LEISURE: Self = Self {
        manner: Manner::AtLeisure,
        knots: KNOTS_AT_LEISURE,
        knots_left: KNOTS_AT_LEISURE,
        half_step: KNOTS_AT_LEISURE,
    };

    /// A shift for a robot that cannot, with half-steps of this duration (s).
    pub(crate) fn by_swaying(half_step: f64) -> Self {
        Self::new(Manner::BySwaying, (half_step / KNOT).round() as u32, FROM_BOTH + ON_ONE + FROM_FOOT_TO_FOOT)
    }

    /// The shift with which a robot comes to a stand after its last half-step, if it does not stand at once.
    ///
    /// * `self` – that with which it starts
    pub(crate) fn after_landing(self) -> Option<Self> {
        (self.manner == Manner::BySwaying).then(|| Self::new(Manner::AfterLanding, self.half_step, ON_ONE + FROM_BOTH))
    }

    fn new(manner: Manner, half_step: u32, half_steps: f64) -> Self {
        let knots = ((half_steps * f64::from(half_step)).round() as u32).max(1);
        Self { manner, knots, knots_left: knots, half_step }
    }

    /// The shift one knot later; `None` when it is over.
    pub(crate) fn advanced(self) -> Option<Self> {
        (self.knots_left > 1).then(|| Self { knots_left: self.knots_left - 1, ..self })
    }

    /// The shift one knot earlier, as it is taken back; `None` when it is back where it began.
    pub(crate) fn taken_back(self) -> Option<Self> {
        (self.knots_left + 1 < self.knots).then(|| Self { knots_left: self.knots_left + 1, ..self })
    }

    /// Progress, linear in time, 0 to 1.
    pub(crate) fn progress(self) -> f64 {
        1.0 - f64::from(self.knots_left) / f64::from(self.knots)
    }

    /// Share of the weight on the support foot: 0.5 on both feet, 1 when it carries all.
    pub(crate) fn support_share(self) -> f64 {
        let half_steps = f64::from(self.knots - self.knots_left) / f64::from(self.half_step);
        let part = |from: f64, duration: f64| smooth_step(((half_steps - from) / duration).clamp(0.0, 1.0));
        match self.manner {
            Manner::AtLeisure => 0.5 + 0.5 * smooth_step(self.progress()),
            Manner::BySwaying => {
                let to_other = (ON_ONE_FOOT - 0.5) * part(0.0, FROM_BOTH);
                0.5 - to_other + ON_ONE_FOOT * part(FROM_BOTH + ON_ONE, FROM_FOOT_TO_FOOT)
            }
            Manner::AfterLanding => ON_ONE_FOOT - (ON_ONE_FOOT - 0.5) * part(ON_ONE, FROM_BOTH),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All of a shift, from its first knot on.
    fn all(shift: WeightShift) -> Vec<WeightShift> {
        std::iter::successors(Some(shift), |shift| shift.advanced()).collect()
    }

    #[test]
    fn a_shift_that_is_taken_back_returns_by_the_way_it_came() {
        let swaying = WeightShift::by_swaying(0.5426);
        for shift in [WeightShift::AT_LEISURE, swaying, swaying.after_landing().unwrap()] {
            let all = all(shift);
            assert_eq!(all.len(), shift.knots as usize);
            for pair in all.windows(2) {
                assert_eq!(pair[1].taken_back().unwrap_or(shift), pair[0]);
            }
        }
        assert_eq!(WeightShift::AT_LEISURE.after_landing(), None);
    }

    #[test]
    fn a_sway_carries_the_weight_to_the_other_foot_first() {
        let shares: Vec<f64> = all(WeightShift::by_swaying(0.5)).into_iter().map(WeightShift::support_share).collect();
        assert_eq!(shares.len(), 103);
        assert!((shares[0] - 0.5).abs() < 1e-12);
        assert!(shares[33..97].iter().all(|share| (share - 0.1).abs() < 1e-9), "{shares:?}");
        assert!(*shares.last().unwrap() > 0.9);
        // Between two knots it moves by less than the whole weight.
        assert!(shares.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.4));
    }

    #[test]
    fn after_a_landing_the_weight_stays_for_a_half_step() {
        let landed = WeightShift::by_swaying(0.5).after_landing().unwrap();
        let shares: Vec<f64> = all(landed).into_iter().map(WeightShift::support_share).collect();
        assert_eq!(shares.len(), 98);
        assert!(shares[..65].iter().all(|share| *share == 0.9), "{shares:?}");
        assert!((shares.last().unwrap() - 0.5).abs() < 0.01);
    }
}
