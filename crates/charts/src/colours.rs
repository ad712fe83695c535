//! Colours: one for each meaning, the same in all pictures.
//!
//! Colour-blind readers, and readers of a print in grey, can tell them apart (Okabe and Ito 2008).

use model::Side;

/// The right foot.
pub const RIGHT: &str = "#0072B2";
/// The left foot.
pub const LEFT: &str = "#D55E00";
/// What was planned of the right side.
pub const RIGHT_PALE: &str = "#A9CFE6";
/// What was planned of the left side.
pub const LEFT_PALE: &str = "#F3C6A2";
/// The zero-moment point.
pub const ZMP: &str = "#000000";
/// Planned values.
pub const PLANNED: &str = "#8C8C8C";
/// The centre of mass.
pub const COM: &str = "#009E73";
/// The planned centre of mass.
pub const COM_PLANNED: &str = "#8FD8C2";
/// The divergent component of motion, and the feedback on it.
pub const DIVERGENT: &str = "#A8317F";
/// The planned divergent component of motion.
pub const DIVERGENT_PLANNED: &str = "#E6AFD2";
/// The edges of a sole, and other lines for orientation.
pub const EDGE: &str = "#999999";
/// The first of two runs over each other.
pub const FIRST_RUN: &str = "#333333";
/// The second one.
pub const SECOND_RUN: &str = "#2E9BDA";
/// A fall.
pub const FALL: &str = "#CC0000";

/// The colour of a foot.
pub const fn colour(side: Side) -> &'static str {
    match side {
        Side::Right => RIGHT,
        Side::Left => LEFT,
    }
}
