//! The step choice: where and when the swing foot lands, chosen anew from the measured divergent component of motion
//! (after Khadiv, Herzog, Moosavian and Righetti 2020, "Walking control based on step timing adaptation").
//!
//! Until touchdown the divergent component runs away from the ZMP: `ξ(t) = p + (ξ − p)·e^(ωt)`. The ankle holds the ZMP
//! anywhere in the sole. What it cannot correct until then, a landing off its planned place must, and an earlier
//! touchdown leaves less of it. Times are whole knots: for each the best landing has a closed form, and the cheapest of
//! some dozens is the choice.

use nalgebra::Vector2;

/// Where and when the swing foot lands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepChoice {
    /// Offset of the landing from its planned place, in support coordinates (m).
    pub offset: Vector2<f64>,
    /// Knots from the change of the plan until touchdown; `None` leaves the time as it is.
    pub knots: Option<u32>,
}

/// What a step is chosen from. Places are in support coordinates (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepProblem {
    /// The measured divergent component.
    pub dcm: Vector2<f64>,
    /// Where it should be at touchdown, for a landing at the planned place.
    pub dcm_at_touchdown: Vector2<f64>,
    /// The planned ZMP.
    pub zmp: Vector2<f64>,
    /// The ZMP farthest back and to the right, and farthest ahead and to the left, that the ankle can hold.
    pub zmp_bounds: [Vector2<f64>; 2],
    /// Growth of an error of the divergent component from knot to knot, `e^(ω·knot)` (-).
    pub growth: f64,
    /// Knots until a changed plan is played.
    pub lead: u32,
    /// Knots from then on until the touchdown that is planned at present.
    pub planned: u32,
    /// The earliest and the latest touchdown in knots.
    pub knots: [u32; 2],
    /// The offset of the landing that is planned at present.
    pub offset: Vector2<f64>,
    /// Offsets farthest back and to the right, and farthest ahead and to the left.
    pub offset_bounds: [Vector2<f64>; 2],
    /// Largest change of the offset per knot (m).
    pub offset_change_max: f64,
    /// Error at touchdown that is left to the next ankle (m).
    pub left_to_next_ankle: Vector2<f64>,
    /// How large an offset costs as much as another touchdown by a knot (m).
    pub cost_of_knot: f64,
}

/// Knots before touchdown in which the foot only comes down.
const COMING_DOWN: u32 = 3;
/// Share of the sole that is counted on, ahead and aside: an ankle that pushes at the side edge tips the sole.
const SHARE_OF_SOLE: Vector2<f64> = Vector2::new(1.0, 0.8);
/// Cost of the error that no step corrects, against that of an equal offset.
const COST_OF_REST: f64 = 30.0;

impl StepProblem {
    /// The cheapest step.
    pub(crate) fn solve(&self) -> StepChoice {
        let as_planned = self.step_at(self.planned);
        let mut best = (self.planned, as_planned);
        // Without an error at the planned time there is nothing to gain.
        if as_planned.0 > 0.0 {
            for knots in self.knots[0]..=self.knots[1] {
                let step = self.step_at(knots);
                if step.0 < best.1.0 {
                    best = (knots, step);
                }
            }
        }
        let (knots, (_, offset)) = best;
        StepChoice { offset, knots: (knots != self.planned).then_some(knots) }
    }

    /// The best landing after so many knots: its cost (m²) and its offset (m).
    fn step_at(&self, knots: u32) -> (f64, Vector2<f64>) {
        let reachable = self.offset_change_max * f64::from(knots.saturating_sub(COMING_DOWN));
        let mut cost = (f64::from(knots.abs_diff(self.planned)) * self.cost_of_knot).powi(2);
        let wanted = self.uncorrected_error(knots);
        let offset = Vector2::from_fn(|axis, _| {
            let [least, most] = self.offset_bounds.map(|bound| bound[axis]);
            let now = self.offset[axis];
            // Where offset and rest together cost least.
            let cheapest = wanted[axis] * (COST_OF_REST / (1.0 + COST_OF_REST));
            let offset = cheapest.max(least).min(most).max(now - reachable).min(now + reachable);
            cost += offset * offset + COST_OF_REST * (wanted[axis] - offset).powi(2);
            offset
        });
        (cost, offset)
    }

    /// The error of the divergent component at touchdown that the best step leaves, beyond what the next ankle corrects
    /// (m).
    pub(crate) fn shortfall(&self) -> Vector2<f64> {
        let mut least = self.rest_at(self.planned);
        for knots in self.knots[0]..=self.knots[1] {
            let rest = self.rest_at(knots);
            if rest.norm_squared() < least.norm_squared() {
                least = rest;
            }
        }
        least
    }

    /// What is left of the error after so many knots, however far the landing may go (m).
    fn rest_at(&self, knots: u32) -> Vector2<f64> {
        let reachable = self.offset_change_max * f64::from(knots.saturating_sub(COMING_DOWN));
        let wanted = self.uncorrected_error(knots);
        Vector2::from_fn(|axis, _| {
            let [least, most] = self.offset_bounds.map(|bound| bound[axis]);
            let now = self.offset[axis];
            wanted[axis] - wanted[axis].max(least).min(most).max(now - reachable).min(now + reachable)
        })
    }

    /// The error of the divergent component at a touchdown at the planned place that neither this ankle nor the next
    /// one can correct (m).
    fn uncorrected_error(&self, knots: u32) -> Vector2<f64> {
        let growth = self.growth.powi((self.lead + knots) as i32);
        Vector2::from_fn(|axis, _| {
            let error = self.zmp[axis] + (self.dcm[axis] - self.zmp[axis]) * growth - self.dcm_at_touchdown[axis];
            let edge = self.zmp_bounds[usize::from(error > 0.0)][axis];
            let correctable = (edge - self.zmp[axis]).abs() * SHARE_OF_SOLE[axis] * (growth - 1.0);
            (error.abs() - correctable - self.left_to_next_ankle[axis]).max(0.0) * error.signum()
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const KNOT: f64 = 0.01;
    const OMEGA: f64 = 3.2;

    /// Halfway through a step of 0.25 m, from a sole of 0.28 m × 0.08 m.
    fn problem(dcm: Vector2<f64>) -> StepProblem {
        let dcm_at_touchdown = Vector2::new(0.28, 0.165);
        StepProblem {
            dcm,
            dcm_at_touchdown,
            zmp: Vector2::zeros(),
            zmp_bounds: [Vector2::new(-0.065, -0.035), Vector2::new(0.205, 0.035)],
            growth: (OMEGA * KNOT).exp(),
            lead: 3,
            planned: 27,
            knots: [14, 27],
            offset: Vector2::zeros(),
            offset_bounds: [Vector2::new(-0.5, -0.1), Vector2::new(0.2, 0.2)],
            offset_change_max: 0.008,
            left_to_next_ankle: Vector2::new(0.05, 0.03),
            cost_of_knot: 0.002,
        }
    }

    /// The divergent component from which the planned touchdown is met without any ankle.
    fn undisturbed() -> Vector2<f64> {
        problem(Vector2::zeros()).dcm_at_touchdown * (-OMEGA * 0.3).exp()
    }

    /// The cost of a step by integrating the pendulum, with the best ZMP of many.
    fn cost(problem: &StepProblem, knots: u32, offset: Vector2<f64>) -> f64 {
        let mut cost = (f64::from(knots.abs_diff(problem.planned)) * problem.cost_of_knot).powi(2);
        for axis in 0..2 {
            let [low, high] = problem.zmp_bounds.map(|bound| bound[axis] * SHARE_OF_SOLE[axis]);
            let rest = (0..=200).map(|share| low + (high - low) * f64::from(share) / 200.0).map(|zmp| {
                let mut dcm = problem.dcm[axis];
                for _ in 0..(problem.lead + knots) * 10 {
                    // The midpoint rule.
                    let half = dcm + (dcm - zmp) * OMEGA * KNOT / 20.0;
                    dcm += (half - zmp) * OMEGA * KNOT / 10.0;
                }
                let error = (dcm - problem.dcm_at_touchdown[axis] - offset[axis]).abs();
                (error - problem.left_to_next_ankle[axis]).max(0.0)
            });
            let rest = rest.fold(f64::INFINITY, f64::min);
            cost += offset[axis] * offset[axis] + COST_OF_REST * rest * rest;
        }
        cost
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

        /// The oracle: many other steps, their outcome integrated.
        #[test]
        fn no_other_step_is_cheaper(
            push in prop::array::uniform2(-0.15..0.15),
            others in prop::collection::vec((14_u32..28, -0.25..0.2, -0.1..0.2), 20),
        ) {
            let problem = problem(undisturbed() + Vector2::from(push));
            let choice = problem.solve();
            let knots = choice.knots.unwrap_or(problem.planned);
            let chosen = cost(&problem, knots, choice.offset);
            for (knots, x, y) in others {
                let reachable = problem.offset_change_max * f64::from(knots - COMING_DOWN);
                let offset = Vector2::new(x, y).map(|value: f64| value.clamp(-reachable, reachable));
                let other = cost(&problem, knots, offset);
                prop_assert!(chosen <= other + 2e-4, "{choice:?} costs {chosen}, {knots} {offset} only {other}");
            }
        }
    }

    #[test]
    fn a_walk_as_planned_is_left_alone() {
        assert_eq!(problem(undisturbed()).solve(), StepChoice { offset: Vector2::zeros(), knots: None });
    }

    #[test]
    fn a_push_makes_the_foot_land_earlier_and_further_that_way() {
        for push in [Vector2::new(0.25, 0.0), Vector2::new(-0.3, 0.0), Vector2::new(0.0, 0.06)] {
            let StepChoice { offset, knots } = problem(undisturbed() + push).solve();
            assert!(offset.dot(&push) > 0.0 && knots.is_some_and(|knots| knots < 27), "{push}: {offset} {knots:?}");
        }
    }

    #[test]
    fn nothing_is_asked_beyond_the_bounds() {
        let problem = problem(Vector2::new(3.0, -2.0));
        let StepChoice { offset, knots } = problem.solve();
        let knots = knots.unwrap_or(problem.planned);
        assert!((problem.knots[0]..=problem.knots[1]).contains(&knots));
        let [least, most] = problem.offset_bounds;
        assert!((0..2).all(|axis| (least[axis]..=most[axis]).contains(&offset[axis])), "{offset}");
    }
}
