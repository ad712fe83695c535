//! The dynamics of any motion: kinematics, Newton–Euler, articulated bodies, mass matrix, ZMP, support polygon, time
//! scaling.
//!
//! Every algorithm works in world axes about one common origin (O for the robot on flat ground, the right sole for the
//! floating robot), so that nothing is transformed from link to link: the inertia of a subtree is a plain sum. Nothing
//! allocates: a [`Tree`] is read-only, and results live in structs that are created once and filled in stages, as in
//! Pinocchio's model and data.

mod articulated_body;
mod atan2;
mod batch;
mod composite;
mod energy;
mod ground_torques;
mod held_bodies;
mod held_body;
mod held_kinematics;
mod held_tree;
mod inverse_kinematics;
mod joint_axis;
mod kinematics;
mod lanes;
mod leg_chain;
mod leg_geometry;
mod leg_solver;
mod mass_matrix;
mod newton_euler;
mod reference_dynamics;
mod sin_cos;
mod spatial;
mod support_polygon;
mod time_scaling;
mod tree;
mod twist;
mod upper_body;
mod walk_pose;
mod zmp;
mod zmp_jacobian;

pub use articulated_body::{Accelerations, ArticulatedBody, LinkLoad};
pub use atan2::atan2;
pub use batch::Batch;
pub use energy::{kinetic_energy, potential_energy};
pub use ground_torques::ground_torques;
pub use held_body::HeldJointDrive;
pub use held_kinematics::FloatingRates;
pub use held_tree::{HeldPose, HeldPoses};
pub use inverse_kinematics::{Unreachable, solve_leg};
pub use kinematics::Kinematics;
pub use lanes::LANES;
pub use leg_solver::LegSolver;
pub use mass_matrix::{MassMatrix, mass_matrix};
pub use newton_euler::{BaseMotion, NewtonEuler};
pub use reference_dynamics::{PlannedContact, ReferenceDynamics};
pub use sin_cos::sin_cos;
pub use support_polygon::SupportPolygon;
pub use time_scaling::{wrench_at_speed, zmp_at_speed};
pub use tree::Tree;
pub use twist::Twist;
pub use upper_body::UpperBody;
pub use walk_pose::{arc_between, pose_seen_from, poses_in_frame_of};
pub use zmp::zmp;
pub use zmp_jacobian::ZmpJacobian;
