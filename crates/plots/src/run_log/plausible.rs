//! Which rows can be measured and drawn: those whose numbers are finite, and not so large that something must have gone
//! wrong before they were recorded.

use interface::DestinationProgress;
use nalgebra::Vector2;

use super::{ControllerRow, PlantRow};

/// Largest coordinate (m): a walk of weeks.
const FAR: f64 = 1e6;
/// Largest angle (rad), factor or speed of anything that is drawn.
const LARGE: f64 = 1e3;
/// Largest load of a foot (N).
const HEAVY: f64 = 1e9;

impl PlantRow {
    /// The row, if it can be drawn; without its zero-moment point where that alone cannot.
    pub(super) fn plausible(mut self) -> Option<Self> {
        let pose = &self.right_sole_to_world;
        let turn = pose.rotation.coords.norm();
        let is_plausible = within(FAR, pose.translation.vector.iter())
            && (turn - 1.0).abs() < 0.1
            && within(LARGE, self.angles.0.iter())
            && within(HEAVY, self.loads.iter())
            && within(FAR, self.com_in_world.iter())
            && within(LARGE, [&self.trunk_tilt]);
        self.zmp_in_world = near(self.zmp_in_world);
        self.com_velocity = self.com_velocity.filter(|velocity| within(LARGE, velocity.iter()));
        is_plausible.then_some(self)
    }
}

impl ControllerRow {
    /// The row, if it can be drawn; without the quantities that alone cannot.
    pub(super) fn plausible(mut self) -> Option<Self> {
        let commands = [self.turn_command, self.speed_command, self.extension_command, self.sidestep_command];
        let state = [self.progress, self.speed, self.lean_roll, self.lean_pitch];
        let is_plausible = within(LARGE, commands.iter().chain(&state));
        self.zmp_measured = near(self.zmp_measured);
        self.zmp_planned = near(self.zmp_planned);
        self.margin = self.margin.filter(|margin| within(FAR, [margin]));
        self.added = self.added.filter(|added| within(LARGE, added.ankle.iter().chain(added.waist.iter())));
        let near_goal = |goal: &DestinationProgress| within(FAR, [&goal.distance]) && within(LARGE, [&goal.turn]);
        self.destination = self.destination.filter(near_goal);
        for com in [&mut self.com_planned, &mut self.com_measured] {
            *com = com.filter(|com| within(FAR, com.position.iter().chain(com.velocity.iter())));
        }
        is_plausible.then_some(self)
    }
}

fn near(point: Option<Vector2<f64>>) -> Option<Vector2<f64>> {
    point.filter(|point| within(FAR, point.iter()))
}

/// Whether all values lie between `-max` and `max`; NaN does not.
fn within<'v>(max: f64, values: impl IntoIterator<Item = &'v f64>) -> bool {
    values.into_iter().all(|value| value.abs() <= max)
}
