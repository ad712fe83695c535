//! The nominal half-step and its online modifications: turn, sidestep, step extension, speed.
//!
//! One nominal half-step is a [`NominalTable`]. A [`Walk`] repeats it from foot to foot and modifies it online: turn,
//! sidestep and step extension are offsets on a few joints, functions of the progress through the half-step; speed only
//! changes how fast the progress runs. So every combination is a plain sum (DESIGN §4).
//!
//! * **progress** `s`: share of the half-step that is completed, 0 to 1.
//! * **nominal time** `τ = s·T`: the time of that progress at nominal speed; motions "at nominal speed" are derived by
//!   it.
//! * **canonical**: expressed as if the robot stood on its right foot. **Physical**: joints 3–8 are the right leg's.

mod deflection;
mod error;
mod hermite;
mod parameters;
mod ramp;
mod range_check;
mod robot;
mod sidestep;
mod speed;
mod step_extension;
mod table;
mod table_csv;
mod turn;
mod walk;

pub use deflection::{Deflection, DeflectionPhase};
pub use error::WalkError;
pub use hermite::interpolate;
pub use parameters::{GaitParameters, Limits};
pub use ramp::{Ramp, RampKind, RampState};
pub use range_check::{Quantity, RangeCheck};
pub use robot::Robot;
pub use speed::{Speed, at_speed};
pub use step_extension::StepExtension;
pub use table::{NominalRow, NominalTable, TableError};
pub use table_csv::TableFileError;
pub use walk::{LegOffsets, Start, Walk};
