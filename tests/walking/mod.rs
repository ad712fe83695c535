//! Controller and plant together in one process.

mod a_broken_limit_excuses_no_other;
mod a_grant_does_not_depend_on_the_millisecond;
mod a_speed_request_takes_effect_at_once;
mod a_stop_waits_for_nothing;
mod a_tick_returns_for_every_period;
mod a_walk_keeps_its_bits;
mod admission_from_a_stand_is_that_of_the_walk;
#[cfg(feature = "command-line")]
mod another_body_gets_its_own_nominal_and_walks;
mod bad_measurements_never_reach_a_joint;
mod every_mode_answers_every_request;
mod holding_stands_on_both_feet;
mod lying_sensors_are_noticed;
mod reports_match_the_plan;
mod same_inputs_same_bits;
mod starts_and_stops_in_any_order;
mod steps_in_place;
mod the_controller_begins_where_the_robot_is;
mod the_preview_keeps_the_zmp_in_the_sole;
mod walks_by_every_extreme_of_what_is_granted;
mod walks_in_every_direction;
mod walks_on_after_pushes;
mod walks_on_floors_with_shape;
mod walks_on_slopes_and_with_payload;
mod walks_on_soles_that_are_shifted;
mod walks_on_uneven_ground;
mod walks_on_what_it_does_not_know;
mod walks_through_sensor_faults;
mod walks_to_destinations;
mod walks_without_falling;
mod weak_robots_start_and_stop;
mod what_is_accepted_is_walked;
