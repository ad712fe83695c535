//! The `halfstep` binary.

fn main() {}
