//! How far the measured zero-moment point is from the planned one.

use nalgebra::Vector2;

use super::ControllerRow;

impl ControllerRow {
    /// The measured less the planned zero-moment point (m); `None` near a support change, at which both move from foot
    /// to foot, after a fall or a fault that stopped the robot, and where one of them is unknown.
    pub fn zmp_error(&self) -> Option<Vector2<f64>> {
        let pair =
            self.zmp_measured.zip(self.zmp_planned).filter(|_| self.is_off_support_changes() && self.is_balancing());
        pair.map(|(measured, planned)| measured - planned)
    }
}

/// Sum of the errors' squares over the rows of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ZmpErrorSum {
    squares: f64,
    rows: u64,
}

impl ZmpErrorSum {
    /// Adds a row.
    pub(super) fn add(&mut self, row: &ControllerRow) {
        if let Some(error) = row.zmp_error() {
            self.squares += error.norm_squared();
            self.rows += 1;
        }
    }

    /// The root of the mean square (m); `None` without any error.
    pub(super) fn rms(&self) -> Option<f64> {
        (self.rows > 0).then(|| (self.squares / self.rows as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::log;
    use super::*;

    #[test]
    fn the_error_is_that_of_single_support_and_of_both_axes() {
        let mut log = log(4, 0.0);
        let mut sum = ZmpErrorSum::default();
        assert_eq!(sum.rms(), None);
        for row in &mut log.controller {
            // Near a support change it does not count.
            let off = if row.is_off_support_changes() { Vector2::new(0.003, 0.004) } else { Vector2::new(0.2, 0.0) };
            row.zmp_planned = row.zmp_measured.map(|measured| measured - off);
            sum.add(row);
        }
        assert!((sum.rms().unwrap() - 0.005).abs() < 1e-12, "{:?}", sum.rms());
    }
}
