//! Where a walk ended: as the controller estimates it, and in truth.

use std::f64::consts::TAU;

use dynamics::{Tree, pose_seen_from};
use interface::WalkPose;
use model::{Mechanism, Side};
use serde::Serialize;

use super::{PlantRow, RunLog};

/// The middle between both soles in the walk frame: origin in their middle at the start, x ahead, y to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EndPose {
    /// Along x (m).
    pub x_m: f64,
    /// Along y (m).
    pub y_m: f64,
    /// Mean heading of both soles (deg), positive to the left, full circles included.
    pub heading_deg: f64,
}

impl From<WalkPose> for EndPose {
    fn from(pose: WalkPose) -> Self {
        Self { x_m: pose.x, y_m: pose.y, heading_deg: pose.heading.to_degrees() }
    }
}

impl RunLog {
    /// Where the controller believes to be at the end; the origin if it reported nothing.
    pub(super) fn estimated_end(&self) -> EndPose {
        self.controller.last().map_or(EndPose::default(), |row| row.walk_pose.into())
    }

    /// Where the robot is at the end; `None` if nothing was recorded of it.
    ///
    /// * `turned` – change of heading (rad), full circles included, to half a circle
    pub(super) fn true_end(&self, mechanism: &Mechanism, turned: f64) -> Option<EndPose> {
        let (first, last) = self.plant.first().zip(self.plant.last())?;
        let tree = Tree::new(mechanism);
        let [start, end] = [first, last].map(|row| middle_of_soles(row, mechanism, &tree));
        let seen = pose_seen_from(&start, &end);
        let circles = ((turned - seen.heading) / TAU).round();
        Some(WalkPose { heading: seen.heading + circles * TAU, ..seen }.into())
    }
}

/// The middle between both soles in the world.
fn middle_of_soles(row: &PlantRow, mechanism: &Mechanism, tree: &Tree) -> WalkPose {
    let [right, left] = Side::BOTH.map(|side| row.footprint(mechanism, tree, side));
    let between = |one: f64, other: f64| (one + other) / 2.0;
    let [one, other] = [&right, &left].map(|foot| foot.sole_to_world.translation.vector);
    // The feet never point apart by half a circle.
    let apart = (left.heading() - right.heading() + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
    WalkPose { x: between(one.x, other.x), y: between(one.y, other.y), heading: right.heading() + apart / 2.0 }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{log, mechanism};

    #[test]
    fn the_end_is_seen_from_the_middle_of_the_feet_at_the_start() {
        let run = log(8, 0.0);
        let end = run.measures(&mechanism()).truth.unwrap();
        assert!(end.x_m > 1.0 && end.y_m.abs() < 0.2 && end.heading_deg.abs() < 1e-9, "{end:?}");
        let circling = log(45, 10_f64.to_radians()).measures(&mechanism()).truth.unwrap();
        assert!((circling.heading_deg - 445.0).abs() < 10.0, "full circles count: {circling:?}");
    }
}
