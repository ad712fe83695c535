//! Dynamics against other formulas, symmetries, energy, and Pinocchio.

mod a_resting_robots_zmp_is_under_its_centre_of_mass;
mod energy_is_kept_by_a_free_robot;
mod forward_dynamics_undoes_inverse_dynamics;
mod held_joints_obey_the_same_laws;
mod mass_matrix_columns_are_newton_eulers;
mod pinocchio_agrees;
mod robots_of_any_structure_obey_the_same_laws;
mod torques_follow_the_square_of_the_speed;
mod zmp_by_two_ways_agrees;
