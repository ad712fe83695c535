//! What the walk asks: nominal table, half-step, turn, step extension, speed, request.

mod table;

pub use table::{NominalRow, NominalTable};
