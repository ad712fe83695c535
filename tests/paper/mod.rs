//! The paper's figures and statements, reproduced.

mod bad_scenarios_are_refused;
mod slowed_walks_approach_the_centre_of_mass;
mod the_computed_lean_is_the_best;
mod the_papers_figures_come_out;
mod the_search_finds_a_better_body;
