//! The `halfstep` command as people use it: controller, plant, streams, recordings. Each test has its own folder and
//! its own instance; nearly all walk in lockstep, so that a busy machine only makes them slower.

mod a_bad_line_spoils_itself_only;
mod a_disturbance_script_is_played;
mod a_fault_that_stops_a_walk_is_named;
mod a_full_disk_is_told_at_once;
mod a_full_shared_memory_is_told_and_stops_no_stop;
mod a_halted_lockstep_run_goes_on;
mod a_kill_at_any_instant_leaves_nothing;
mod a_killed_run_can_be_read;
mod a_recording_holds_the_run;
mod a_recording_is_never_overwritten;
mod a_replay_gives_the_same_bits;
mod a_script_of_any_length_gives_the_same_bits;
mod a_second_controller_is_refused;
mod a_silent_stream_stops_the_walk;
mod a_simulation_that_becomes_unstable_is_told;
mod a_stop_is_heard_through_any_flood;
mod a_stream_changes_the_walk_while_it_runs;
mod a_stream_follows_its_newest_line;
mod bad_configuration_is_refused_with_every_error;
mod both_sides_agree_on_clock_and_start;
mod every_error_is_the_pinned_text;
mod nobody_else_gets_in;
mod output_that_nobody_reads_ends_nothing;
mod recordings_of_other_tools_are_read;
mod requests_expire_and_carry_their_id;
mod send_finds_its_controller_or_names_the_others;
mod the_committed_nominal_regenerates_bit_for_bit;
mod the_first_commands_of_the_import_guide_walk;
mod the_next_start_cleans_up_after_a_killed_process;
mod two_processes_walk_in_lockstep;
