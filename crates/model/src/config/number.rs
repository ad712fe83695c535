//! Numbers that have been found but not yet judged: the loader says which ones are right.

use super::Table;

/// A number of the file [in the unit of its key], waiting for the loader to say what it must be.
///
/// Every method gives the value in SI units, or `NaN` after noting what is wrong. Bounds are in the unit of the key:
/// `angle("lean_max_deg").between(0.0, 10.0)` means degrees.
#[must_use]
pub struct Number<'d> {
    pub(super) table: &'d Table<'d>,
    pub(super) key: &'d str,
    /// As written; `NaN` when missing or wrong.
    pub(super) written: f64,
    /// What one unit of the key is in SI units.
    pub(super) unit: f64,
}

impl Number<'_> {
    /// Any finite number.
    pub fn any(self) -> f64 {
        self.written * self.unit
    }

    /// A number greater than 0.
    pub fn positive(self) -> f64 {
        self.that(|value| value > 0.0, "must be greater than 0")
    }

    /// A number that is not below 0.
    pub fn not_negative(self) -> f64 {
        self.that(|value| value >= 0.0, "must be at least 0")
    }

    /// A number of a closed interval.
    pub fn between(self, min: f64, max: f64) -> f64 {
        self.that(|value| value >= min && value <= max, &format!("must lie between {min} and {max}"))
    }

    /// A number for which `right` holds; `must` says what that means: "must be odd".
    pub fn that(self, right: impl Fn(f64) -> bool, must: &str) -> f64 {
        if self.written.is_nan() {
            return f64::NAN;
        }
        if !right(self.written) {
            self.table.refuse(self.key, must);
            return f64::NAN;
        }
        self.any()
    }
}

/// `N` numbers of the file in one array [in the unit of its key], waiting for the loader to say what they must be.
///
/// Every method gives the values in SI units, all `NaN` after noting what is wrong.
#[must_use]
pub struct Numbers<'d, const N: usize> {
    pub(super) table: &'d Table<'d>,
    pub(super) key: &'d str,
    pub(super) written: [f64; N],
    pub(super) unit: f64,
}

impl<const N: usize> Numbers<'_, N> {
    /// Any finite numbers.
    pub fn any(self) -> [f64; N] {
        self.written.map(|value| value * self.unit)
    }

    /// Numbers for which `right` holds; `must` says what that means: "must be a unit vector".
    pub fn that(self, right: impl Fn(&[f64; N]) -> bool, must: &str) -> [f64; N] {
        if self.written.iter().any(|value| value.is_nan()) {
            return [f64::NAN; N];
        }
        if !right(&self.written) {
            self.table.refuse(self.key, must);
            return [f64::NAN; N];
        }
        self.any()
    }

    /// Each greater than 0.
    pub fn positive(self) -> [f64; N] {
        self.that(|values| values.iter().all(|&value| value > 0.0), "each must be greater than 0")
    }

    /// Each greater than the one before.
    pub fn increasing(self) -> [f64; N] {
        self.that(|values| values.is_sorted_by(|a, b| a < b), "each must be greater than the one before")
    }
}
