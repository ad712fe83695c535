//! Messages that exist in recordings only.

use model::Joint;
use wire::wire_layout;

/// The inputs of a tick of the controller that no other message carries; with them the tick can be replayed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct TickMessage {
    /// Number of the tick: periods since the start.
    pub tick: u64,
    /// Number of periods that the tick covered: more than 1 if some were missed.
    pub periods: u64,
    /// Length of the tick, as passed to the controller (s).
    pub dt: f64,
    /// Number of the request that was passed to the controller before the tick; 0 for none.
    pub request: u32,
    /// A `controller::AdmissionTiming` as a number: whether the result of an admission was returned to the controller
    /// before the tick.
    pub returned: u32,
    /// Commanded speed factor `c` (-); the report has the present one, on its ramp.
    pub speed_in_force: f64,
}

/// What the simulated robot really was.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct TruthMessage {
    /// Number of the tick: periods since the start.
    pub tick: u64,
    /// Pose of the right sole: position x y z (m) and unit quaternion w x y z; maps sole coordinates to world
    /// coordinates.
    pub right_sole: [f64; 7],
    /// Angles of the physical joints (rad).
    pub angles: [f64; Joint::COUNT],
    /// Force of the floor on the right and on the left foot, normal to it (N).
    pub loads: [f64; 2],
    /// Centre of mass in the world (m).
    pub com: [f64; 3],
    /// Zero-moment point of the whole ground reaction, in the world (m); NaN in the air.
    pub zmp: [f64; 2],
    /// Angle of the trunk against the vertical (rad).
    pub trunk_tilt: f64,
    /// 1 if the robot has fallen, else 0.
    pub fallen: u64,
}

/// A push on the simulated robot that was asked for while it ran. It has the numbers of a `[[push]]` of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct PushMessage {
    /// Number of the plant's tick before which it began.
    pub tick: u64,
    /// Number of the joint that carries the pushed link.
    pub link: u64,
    /// When it began, since the plant's start (s).
    pub start: f64,
    /// How long it lasts (s).
    pub duration: f64,
    /// Force times duration, in world axes (N·s).
    pub impulse: [f64; 3],
}

wire_layout!(TickMessage as "halfstep.Tick.v1", { tick, periods, dt, request, returned, speed_in_force });
wire_layout!(TruthMessage as "halfstep.Truth.v1", { tick, right_sole, angles, loads, com, zmp, trunk_tilt, fallen });
wire_layout!(PushMessage as "halfstep.Push.v1", { tick, link, start, duration, impulse });
