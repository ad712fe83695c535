//! What people type: the commands of `halfstep`.
