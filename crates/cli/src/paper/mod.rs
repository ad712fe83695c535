//! The paper's walking figures: each a scenario file, all with one robot, one nominal and one reading.

mod figure;
mod half_step;
mod page;
mod reading;
mod scenario;
mod table;

pub use figure::{BestLean, Figure, reproduce};
pub use half_step::{Footing, HalfStep};
pub use page::page;
pub use reading::{RAMPS, Reading};
pub use scenario::{PaperVerdict, Scenario};
pub use table::{Row, summary, table};
