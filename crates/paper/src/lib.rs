//! The paper's walking figures: each a scenario file, all with one robot, one nominal half-step and one reading.

mod figure;
mod half_step_zmp;
mod instrument;
mod page;
mod paper_lean;
mod picture;
mod reading;
mod scenario;
mod search;
mod steady_half_step;
mod table;

pub use figure::{BestLean, Figure, reproduce};
pub use half_step_zmp::{GroundSplit, ZmpExtents, zmp_by_newton_euler, zmp_by_speed_law};
pub use instrument::{
    ChoiceDial, Dials, DrawnFigure, FigureName, Instrument, InstrumentAnswer, InstrumentError, NumberDial, Question,
    VerdictRow, built_in_other_axes, built_in_reading, built_in_scenarios,
};
pub use page::page;
pub use paper_lean::{LeanAt, PaperLean};
pub use picture::paper_figure;
pub use reading::{RAMPS, Reading};
pub use scenario::{PaperVerdict, Scenario};
pub use search::{
    Candidate, FileText, FoundFiles, Freedom, OPEN_NUMBERS, Open, OpenNumber, SearchBase, SearchError, SearchOptions,
    SearchReport, search,
};
pub use steady_half_step::{Footing, SteadyHalfStep};
pub use table::{TableRow, summary, table};
