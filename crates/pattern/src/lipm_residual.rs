//! What the linear inverted pendulum mode (LIPM) of the cart-table model leaves out: the ZMP of the real half-step less
//! that of its centre of mass alone, at any speed, from the nominal table. The `c²` law gives it without any dynamics.

use dynamics::{Kinematics, Tree, zmp};
use gait::NominalTable;
use nalgebra::Vector2;

use crate::knot::KNOT;

/// Centre of mass and ground wrench of the nominal half-step, row by row.
#[derive(Clone, Debug)]
pub(crate) struct LipmResidual {
    rows: Vec<Row>,
    /// z/g of the centre of mass, its mean over the half-step (s²).
    pub height_over_gravity: f64,
}

#[derive(Clone, Copy, Debug)]
struct Row {
    /// Projection of the centre of mass, in support coordinates (m).
    com: Vector2<f64>,
    /// Its acceleration at nominal speed (m/s²).
    com_acceleration: Vector2<f64>,
    /// The part of the ground wrench that carries the weight.
    gravity: model::Wrench,
    /// The part that the motion needs at nominal speed.
    dynamic: model::Wrench,
}

impl LipmResidual {
    /// Reads a table that was made for the mechanism of `tree`.
    pub(crate) fn new(tree: &Tree, table: &NominalTable) -> Self {
        let coms = table.rows.iter().map(|row| Kinematics::fixed_base(tree, &row.motion.angles).com(tree));
        let height = coms.clone().map(|com| com.z).sum::<f64>() / table.rows.len() as f64;
        let rows = table.rows.iter().zip(coms).map(|(row, com)| Row {
            com: com.xy(),
            com_acceleration: row.ground_dynamic.force.xy() / tree.mass,
            gravity: row.ground_gravity,
            dynamic: row.ground_dynamic,
        });
        Self { rows: rows.collect(), height_over_gravity: height / model::GRAVITY }
    }

    /// Growth of an error of the divergent component from knot to knot, `e^(ω·knot)` (-). It calls no mathematical
    /// library of the system, which would round differently elsewhere.
    pub(crate) fn growth_per_knot(&self) -> f64 {
        let x = KNOT / self.height_over_gravity.sqrt();
        1.0 + x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0)))
    }

    /// `ZMP − (c − z/g·c̈)` at a progress and a speed factor, in support coordinates (m).
    pub(crate) fn at(&self, progress: f64, speed: f64) -> Vector2<f64> {
        let place = progress.clamp(0.0, 1.0) * (self.rows.len() - 1) as f64;
        let index = (place as usize).min(self.rows.len() - 2);
        let share = place - index as f64;
        let [start, end] = [&self.rows[index], &self.rows[index + 1]].map(|row| self.at_row(row, speed));
        start * (1.0 - share) + end * share
    }

    fn at_row(&self, row: &Row, speed: f64) -> Vector2<f64> {
        let c2 = speed * speed;
        let pendulum = row.com - row.com_acceleration * (c2 * self.height_over_gravity);
        zmp(&(row.gravity + row.dynamic * c2)).map_or_else(Vector2::zeros, |zmp| zmp - pendulum)
    }
}
