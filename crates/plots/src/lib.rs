//! Analysis of recorded runs: the log of a run with its measures and falls, and plots of it as SVG.
//!
//! * [`run_log`]: rows of plant and controller over time, footprints, falls, and the run in a few numbers.
//! * [`picture`]: the plots of a run and of the nominal half-step, and the charts from which they are made.
//! * [`run_summary`] and [`run_page`]: a run in words, and all of it as a page.
//! * [`comparison`]: two runs over each other.
//! * [`html`]: pages with pictures.

pub mod comparison;
pub mod picture;
pub mod run_log;
pub mod run_page;
pub mod run_summary;

pub use charts::html;
