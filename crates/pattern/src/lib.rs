//! Walking-pattern generator: plans the centre of mass over the feet of the coming half-steps, and the joints that
//! realise it (Kajita et al. 2003).
//!
//! The data flow in this order; each stage has a file of its own:
//!
//! 1. `gait_state`: whether the robot walks, steps in place, starts, stops or stands.
//! 2. `footstep_plan`: which half-steps come and where they put the feet (`step_geometry`, `walk_velocity`;
//!    `course`, `step_bounds` and `footstep_check` on the way to a destination).
//! 3. `zmp_reference`: the reference of the zero-moment point (ZMP) over the coming 1.8 s.
//! 4. `preview_controller`: the centre of mass of the cart-table model that tracks this reference.
//! 5. `foot_trajectory`: swing sole, pelvis and hip height (`swing_path`, `step_adjustment`, `hip_height`). After a
//!    push `step_choice` says where and when to land.
//! 6. `whole_body_ik`: the joint angles that realise feet and centre of mass.
//! 7. `dynamics_filter`: corrects the centre of mass by the dynamics of the whole body over the coming second.
//! 8. `playback`: interpolates the planned knots.
//!
//! [`PatternGenerator`] owns a `plan`, which another one can replace as a whole, and its `execution`, which cannot.
//! [`FeasibilityCheck`] plays a copy ahead and checks it against the limits of the robot.
//!
//! Vocabulary:
//! * **walk frame**: on the floor, origin and heading where the walk began.
//! * **knot**: an instant at which the motion is planned, every [`KNOT`] seconds; between knots joints are
//!   interpolated.
//! * **newest knot**: the last planned one. It lies one to two knots after the present, so that the present has planned
//!   neighbours on both sides.

mod course;
mod dynamics_filter;
mod execution;
mod feasibility;
mod feet;
mod foot_trajectory;
mod footprint;
mod footstep_check;
mod footstep_plan;
mod gait;
mod gait_phase;
mod gait_state;
mod hip_height;
mod incremental_replan;
mod knot;
mod limit;
mod lipm_residual;
mod modified_half_step;
mod one_foot_stand;
mod pace;
mod pattern_generator;
mod pattern_model;
mod plan;
mod planned_slope;
mod playback;
mod preview_controller;
mod proportions;
mod sole_friction;
mod sole_spacing;
mod speed_override;
mod start_overload;
mod step_adjustment;
mod step_bounds;
mod step_choice;
mod step_geometry;
mod stop_in_stride;
mod swing_clearance;
mod swing_path;
mod uncompensated_gait;
mod walk_velocity;
mod weight_shift;
mod whole_body_ik;
mod zmp_reference;

pub use feasibility::{Feasibility, FeasibilityCheck, FeasibilityParameters};
pub use foot_trajectory::MeasuredBalance;
pub use footstep_check::{FootstepFault, FootstepProblem};
pub use gait_phase::GaitPhase;
pub use gait_state::{GaitState, Goal, Stance};
pub use knot::KNOT;
pub use limit::{Limit, LimitViolation};
pub use pace::Pace;
pub use pattern_generator::{Departure, PatternGenerator};
pub use step_choice::StepChoice;
pub use swing_clearance::BodyTilt;
pub use uncompensated_gait::UncompensatedGait;
pub use walk_velocity::VelocityMap;
pub use weight_shift::WeightShift;

pub use crate::gait::Gait;
