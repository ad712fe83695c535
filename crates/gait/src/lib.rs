//! What the walk asks: nominal table, half-step, turn, step extension, speed, request.
//!
//! One nominal half-step is a [`NominalTable`]. A [`Walk`] repeats it from foot to foot and bends it while it runs: turn
//! and step extension are offsets on a few joints, functions of the progress through the half-step; speed only moves the
//! progress faster. So every combination is just the sum (DESIGN §4).
//!
//! * **progress** `s`: how far through the half-step, 0 to 1.
//! * **nominal time** `τ = s·T`: the time at which the nominal would be there; motions "at nominal speed" are derived by it.
//! * **canonical**: told as if the robot stood on its right foot. **Physical**: joints 3–8 are the right leg's.

mod half_step;
mod hermite;
mod parameters;
mod ramp;
mod request;
mod speed;
mod step_extension;
mod table;
mod table_csv;
mod turn;
mod walk;

pub use half_step::HalfStep;
pub use hermite::interpolate;
pub use parameters::{GaitParameters, Limits};
pub use ramp::{Ramp, RampKind, RampState};
pub use request::{Admission, Command, Quantity, Reason, Request, Verdict};
pub use speed::{Speed, at_speed};
pub use step_extension::StepExtension;
pub use table::{NominalRow, NominalTable, TableError};
pub use table_csv::TableFileError;
pub use turn::{Turn, TurnPhase};
pub use walk::{Start, Walk, WalkError};
