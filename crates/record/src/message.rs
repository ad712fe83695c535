//! What is recorded beside that which crossed the wire.

use model::Joint;
use wire::laid_out;

/// What the controller's loop did in a tick, so far as no message tells: what it takes to do it again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct TickMessage {
    /// Periods since the start.
    pub tick: u64,
    /// How many periods it was for: more than 1 if some were missed.
    pub periods: u64,
    /// Its length as the controller was told [s].
    pub dt: f64,
    /// The number of the request that was put to the controller before the tick; 0 is none.
    pub request: u32,
    /// A [`Returned`]: whether an inquiry was given back to the controller before the tick.
    pub returned: u32,
    /// `c` in force, where the report has the speed of this instant, on its ramp.
    pub speed_in_force: f64,
}

/// When a settled inquiry was given back to the controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Returned {
    /// There was none.
    #[default]
    No = 0,
    /// Before the tick's request was put to it.
    BeforeRequest = 1,
    /// After that.
    AfterRequest = 2,
}

/// What the simulated robot really was.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct TruthMessage {
    /// Periods since the start.
    pub tick: u64,
    /// Place x y z [m] and unit quaternion w x y z of the right sole: takes sole coordinates to world coordinates.
    pub right_sole: [f64; 7],
    /// Of the physical joints [rad].
    pub angles: [f64; Joint::COUNT],
    /// Force of the floor on the right and on the left foot, normal to it [N].
    pub loads: [f64; 2],
    /// Centre of mass in the world [m].
    pub com: [f64; 3],
    /// Where the whole ground reaction acts on the floor, in the world [m]; NaN in the air.
    pub zmp: [f64; 2],
    /// Angle of the trunk against the vertical [rad].
    pub trunk_tilt: f64,
    /// 1 if the robot has fallen.
    pub fallen: u64,
}

laid_out!(TickMessage as "halfstep.Tick.v1", { tick, periods, dt, request, returned, speed_in_force });
laid_out!(TruthMessage as "halfstep.Truth.v1", { tick, right_sole, angles, loads, com, zmp, trunk_tilt, fallen });
