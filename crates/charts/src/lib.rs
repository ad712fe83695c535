//! Charts as SVG, from which all pictures are made: of runs (`plots`), of the paper's figures (`paper`), of benchmarks.
//!
//! * [`chart`]: lines and filled polygons with axes, as panels over each other or as maps to scale.
//! * [`sole_outline`]: soles on the floor.
//! * [`colours`]: one for each meaning.
//! * [`html`]: pages with pictures.

pub mod chart;
pub mod colours;
pub mod html;
pub mod sole_outline;
