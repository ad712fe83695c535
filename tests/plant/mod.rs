//! The simulated robot by itself: contact, friction, disturbances, sensors.

mod a_dropped_robot_settles_at_its_weight;
mod a_push_changes_momentum_by_its_impulse;
mod a_slope_tilts_nothing_but_gravity;
mod an_unstable_simulation_is_noticed;
mod friction_holds_below_the_cone_and_slips_above;
mod held_joints_yield_to_gravity;
mod sensor_faults_follow_the_script;
mod sensors_err_as_configured;
mod smaller_steps_err_less;
mod the_ground_carries_soles_by_its_shape;
mod the_ground_is_made_of_its_parts;
mod the_plant_may_differ_from_its_mechanism;
mod the_plant_stands_still;
