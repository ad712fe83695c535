//! The name of a side, as the names of its joints, links and geometries begin.

use model::Side;

/// `right` or `left`.
pub(crate) const fn side_name(side: Side) -> &'static str {
    match side {
        Side::Right => "right",
        Side::Left => "left",
    }
}
