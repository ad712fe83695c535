//! SVG pictures of a run and of the nominal half-step. Each is a function that returns the file's text.
//!
//! One colour has one meaning in all of them: right blue, left orange, the zero-moment point black, the centre of mass
//! green, what was planned grey (Okabe and Ito 2008: told apart by colour-blind readers and on grey paper).

mod chart;
mod footprints;
mod nominal_footprints;
mod nominal_stick;
mod paper_figure;
mod sole_outline;
mod stick_walk;
mod sticks;
mod thinning;
mod zmp_in_sole;
mod zmp_over_time;

use model::Side;

pub use footprints::footprints;
pub use nominal_footprints::nominal_footprints;
pub use nominal_stick::nominal_stick;
pub use paper_figure::paper_figure;
pub use stick_walk::stick_walk;
pub use zmp_in_sole::zmp_in_sole;
pub use zmp_over_time::zmp_over_time;

const RIGHT: &str = "#0072B2";
const LEFT: &str = "#D55E00";
const ZMP: &str = "#000000";
const PLANNED: &str = "#8C8C8C";
const COM: &str = "#009E73";
const EDGE: &str = "#999999";
const FALL: &str = "#CC0000";

/// The colour of a side's foot.
const fn colour(side: Side) -> &'static str {
    match side {
        Side::Right => RIGHT,
        Side::Left => LEFT,
    }
}
