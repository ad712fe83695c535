//! What to do this tick: tick, modes, limits, faults; no clock, no I/O, no allocation.
