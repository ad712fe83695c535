//! Falls, and the moment from which they were unavoidable.
//!
//! A robot that stands still can come to rest without a step as long as its capture point (the divergent component of
//! motion) lies in the convex hull of the soles on the ground; walking, it leaves that hull in every half-step and the
//! next foot catches it. So a fall counts as **unavoidable** from the first instant after which the true capture point
//! stayed outside the soles on the ground and never came back inside until the fall. A step that is not in the log
//! might have caught it for a little longer.

use dynamics::Tree;
use model::Mechanism;
use serde::Serialize;

use super::RunLog;

/// The first fall of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fall {
    /// When the robot had fallen (s).
    pub time_s: f64,
    /// From when on the fall was unavoidable (s); `None` if the capture point stayed over the soles to the end, as when
    /// the legs give way.
    pub unavoidable_s: Option<f64>,
    /// The half-step in which the robot fell, counted from 0.
    pub half_step: u64,
}

impl RunLog {
    /// The first fall, if there is one.
    pub fn first_fall(&self, mechanism: &Mechanism) -> Option<Fall> {
        let tree = Tree::new(mechanism);
        let fell = self.plant.iter().position(|row| row.fallen)?;
        let is_outside = |row: &usize| {
            let support = self.plant[*row].support_polygon(mechanism, &tree);
            self.divergent_component(*row).is_some_and(|capture_point| support.margin(capture_point) < 0.0)
        };
        let left_for_good = (0..=fell).rev().take_while(is_outside).last();
        let time_s = self.plant[fell].time;
        let under_way = self.controller.partition_point(|row| row.time <= time_s).saturating_sub(1);
        Some(Fall {
            time_s,
            unavoidable_s: left_for_good.map(|row| self.plant[row].time),
            half_step: self.controller.get(under_way).map_or(0, |row| row.half_step),
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::super::synthetic::{log, mechanism};
    use super::*;

    /// A robot on its right foot, whose centre of mass is at `x` in each tick.
    fn standing(x: impl Fn(usize) -> f64) -> RunLog {
        let mut log = log(5, 0.0);
        let stands = log.plant[0].right_sole_to_world;
        for (tick, row) in log.plant.iter_mut().enumerate() {
            row.right_sole_to_world = stands;
            row.loads = [700.0, 0.0];
            row.com_in_world = Vector3::new(x(tick), 0.0, 0.9);
        }
        log
    }

    #[test]
    fn fall_is_unavoidable_from_when_the_capture_point_leaves_the_sole_for_good() {
        // The toe is at 0.21 m. Out at ticks 5 to 7, back at 8 to 11, then 0.01 m further in each tick of 0.1 s: the
        // capture point is 0.1 m/s × √(0.9/g) = 0.0303 m ahead.
        let mut log = standing(|tick| match tick {
            5..=7 => 0.5,
            12.. => 0.1 + 0.01 * (tick - 11) as f64,
            _ => 0.1,
        });
        log.plant[25..].iter_mut().for_each(|row| row.fallen = true);
        let fall = log.first_fall(&mechanism()).unwrap();
        // 0.1 + 0.01 n + 0.0303 > 0.21 from n = 8 on, tick 19.
        assert_eq!(fall.unavoidable_s, Some(log.plant[19].time));
        assert_eq!((fall.time_s, fall.half_step), (log.plant[25].time, 4));
    }

    #[test]
    fn fall_is_not_unavoidable_while_a_foot_can_catch_the_capture_point() {
        // Out of the right sole sideways from the beginning, but from tick 10 to 14 the left foot bears, too.
        let mut log = standing(|_| 0.0);
        log.plant.iter_mut().for_each(|row| row.com_in_world.y = 0.1);
        log.plant[10..15].iter_mut().for_each(|row| row.loads = [350.0, 350.0]);
        log.plant[20].fallen = true;
        assert_eq!(log.first_fall(&mechanism()).unwrap().unavoidable_s, Some(log.plant[15].time));
    }

    #[test]
    fn run_without_a_fall_and_fall_over_the_soles() {
        let mut log = standing(|_| 0.0);
        assert_eq!(log.first_fall(&mechanism()), None);
        log.plant[9].fallen = true;
        let fall = log.first_fall(&mechanism()).unwrap();
        assert_eq!((fall.time_s, fall.unavoidable_s, fall.half_step), (log.plant[9].time, None, 1));
    }
}
