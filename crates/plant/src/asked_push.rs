//! Pushes that are asked for while the robot is simulated.

use interface::{PushOutcome, PushRequest};
use model::Mechanism;
use nalgebra::{UnitQuaternion, Vector3};

use crate::{Plant, Push};

/// Shortest and longest push (s).
const DURATION: [f64; 2] = [1e-3, 10.0];
/// Largest impulse (N·s), far more than fells any robot.
const IMPULSE_MAX: f64 = 1e4;

impl Plant {
    /// Begins a push now, and returns it as a script would have it. Allocates nothing if
    /// [`Disturbances::make_room`](crate::Disturbances::make_room) was called.
    ///
    /// # Errors
    /// Why there is no push.
    pub fn begin_push(&mut self, asked: &PushRequest) -> Result<Push, PushOutcome> {
        let PushRequest { link, impulse, duration } = *asked;
        if !((DURATION[0]..=DURATION[1]).contains(&duration) && impulse.norm() <= IMPULSE_MAX) {
            return Err(PushOutcome::OutOfRange);
        }
        // As the trunk faces: turned about the vertical only.
        let trunk = self.robot.kinematics(&self.tree).link_to_world(Mechanism::TRUNK).rotation;
        let ahead = trunk * Vector3::x();
        let facing = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), dynamics::atan2(ahead.y, ahead.x));
        let push = Push { link, impulse: facing * impulse, start: self.time(), duration };
        if self.disturbances.add(push) { Ok(push) } else { Err(PushOutcome::TooMany) }
    }
}
