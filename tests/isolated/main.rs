//! Statements that need an allocator of their own or the machine for themselves: real time, and what is measured.
//!
//! Each test takes [`alone`], so that they run one at a time; Cargo runs no other test binary meanwhile.

#[cfg(feature = "command-line")]
mod a_loop_that_stalls_comes_to_a_stand;
#[cfg(feature = "command-line")]
mod a_period_of_the_loops_allocates_nothing;
#[cfg(feature = "command-line")]
mod benches_measure_what_they_name;
#[cfg(feature = "command-line")]
mod python_exchanges_the_same_messages;
mod tick_never_allocates;

use std::sync::{Mutex, MutexGuard, PoisonError};

use halfstep_tests::counting::Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Waits until no other test runs; none begins before the guard is dropped.
fn alone() -> MutexGuard<'static, ()> {
    static MACHINE: Mutex<()> = Mutex::new(());
    // A test that failed leaves nothing behind that the next one could trip over.
    MACHINE.lock().unwrap_or_else(PoisonError::into_inner)
}
