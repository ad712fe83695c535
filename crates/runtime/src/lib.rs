//! When: deadlines, scheduling, journal.
