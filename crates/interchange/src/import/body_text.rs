//! Writes a body as keys of a mechanism file.

use crate::import::body::LumpedBody;
use crate::import::grid::{Grid, OnGrid};
use crate::import::toml_text::{FINE, Keys, array, digits, number};

/// Mass, centre of mass and inertia in the frame of a joint; nothing for a massless body.
pub(super) fn body(grid: &Grid, body: &LumpedBody, joint: OnGrid) -> Keys {
    if body.mass < LumpedBody::MASS_MIN {
        return Vec::new();
    }
    let inertia = &body.inertia;
    let greatest = inertia.amax();
    let part = |row: usize, column: usize| {
        let value = inertia[(row, column)];
        // Rounding of the frames' rotations is no product of inertia.
        if value.abs() < 1e-14 * greatest { 0.0 } else { value }
    };
    let mut moments: Vec<f64> = (0..3).map(|axis| part(axis, axis)).collect();
    let products = [part(0, 1), part(0, 2), part(1, 2)];
    if products.iter().any(|product| *product != 0.0) {
        moments.extend(products);
    }
    vec![
        ("mass_kg", number(body.mass, FINE)),
        ("com_m", joint.to(grid.at(body.com))),
        ("inertia_kg_m2", array(moments.into_iter().map(digits))),
    ]
}
