//! What controller, plant and operators exchange, each concept defined once.
//!
//! | value | from → to | what it is |
//! |---|---|---|
//! | [`Setpoint`] | controller → plant | joint angles, rates, feed-forward torques for the end of a period |
//! | [`Measurement`] | plant → controller | one sample of all sensors; nothing in it is trusted |
//! | [`Request`] | operator → controller | new gait parameters or [`Intent`], from a [`Source`], for its [`Lifetime`] |
//! | [`Reply`] | controller → operator | the [`Verdict`] on a request, what was granted, the [`Reason`] if less |
//! | [`PushRequest`] | anyone → simulated plant | a push; [`PushReply`] tells whether it is given |
//! | [`Report`] | controller → anyone | the state of the controller after a period: [`Mode`], ZMP, [`Faults`] |
//!
//! These are values only: how they travel is the crate `wire`'s affair. All quantities are SI (m, rad, N, s). Joints
//! are physical: joints 3 to 8 belong to the right leg, whichever foot supports the robot. Points and vectors are
//! expressed in the support foot's sole frame: origin under the ankle, x forward along the foot, y to the left, z up.
//! Nothing that leaves the controller is mirrored.

mod capturability;
pub mod code;
mod command;
mod destination;
mod fault;
mod half_step;
mod intent;
mod lifetime;
mod measurement;
mod mode;
mod period_timing;
mod push_request;
mod rate;
mod reason;
mod reply;
mod report;
mod request;
mod sensor;
mod sensor_group;
mod setpoint;
mod setpoint_hash;
mod source;
mod verdict;
mod walk_pose;

pub use capturability::Capturability;
pub use command::{Command, GaitChange};
pub use destination::{
    Destination, DestinationProgress, Footstep, PLACES_MAX, PlaceFrame, PlaceList, Places, Waypoint,
};
pub use fault::{Fault, Faults, LatchedFault};
pub use half_step::HalfStep;
pub use intent::Intent;
pub use lifetime::{COMMAND_TIMEOUT_MAX, COMMAND_TIMEOUT_MIN, Lifetime};
pub use measurement::Measurement;
pub use mode::Mode;
pub use period_timing::PeriodTiming;
pub use push_request::{PushOutcome, PushReply, PushRequest};
pub use rate::Rate;
pub use reason::Reason;
pub use reply::{ActiveLimit, ControlAuthority, Objection, Reply};
pub use report::{AddedAngles, Report, StateEstimate};
pub use request::Request;
pub use sensor::{Rejection, Sensor};
pub use sensor_group::{SensorGroup, SensorGroups};
pub use setpoint::Setpoint;
pub use setpoint_hash::SetpointHash;
pub use source::Source;
pub use verdict::Verdict;
pub use walk_pose::{Odometry, SteadyWalk, WalkPose, WalkVelocity};
