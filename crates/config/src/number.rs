//! Numbers that have been found but not yet checked: the loader states which ones are right.

use crate::place::Place;

/// A number of the file, in the unit of its key, before the loader has stated which numbers are right. There is no
/// number without a range: what is finite but absurd is nearly always a mistake of unit.
///
/// Every method returns the value in SI units, or `NaN` after noting what is wrong. Bounds are in the unit of the key:
/// `angle("lean_max_deg").between(0.0, 10.0)` means degrees.
#[must_use]
pub struct Number<'d> {
    pub(crate) place: Place<'d>,
    /// As written; `NaN` when missing or wrong.
    pub(crate) written: f64,
    /// One unit of the key, in SI units.
    pub(crate) unit: f64,
}

impl Number<'_> {
    /// A number of the closed interval from `min` to `max`, in the unit of the key.
    pub fn between(self, min: f64, max: f64) -> f64 {
        self.that(|value| value >= min && value <= max, &format!("must lie between {min} and {max}"))
    }

    /// A number for which `right` holds; `must` states it in words: "must be odd".
    pub fn that(self, right: impl Fn(f64) -> bool, must: &str) -> f64 {
        if self.written.is_nan() {
            return f64::NAN;
        }
        if !right(self.written) {
            self.place.refuse(must);
            return f64::NAN;
        }
        self.written * self.unit
    }
}

/// `N` numbers of one array of the file, in the unit of its key, before the loader has stated which numbers are right.
///
/// Every method returns the values in SI units, all `NaN` after noting what is wrong.
#[must_use]
pub struct Numbers<'d, const N: usize> {
    pub(crate) place: Place<'d>,
    /// As written; all `NaN` when missing or wrong.
    pub(crate) written: [f64; N],
    /// One unit of the key, in SI units.
    pub(crate) unit: f64,
}

impl<const N: usize> Numbers<'_, N> {
    /// Numbers of the closed interval from `min` to `max`, in the unit of the key.
    pub fn between(self, min: f64, max: f64) -> [f64; N] {
        let right = |values: &[f64; N]| values.iter().all(|value| (min..=max).contains(value));
        self.that(right, &format!("each must lie between {min} and {max}"))
    }

    /// Numbers of the closed interval from `min` to `max`, of which each is greater than the one before.
    pub fn increasing_between(self, min: f64, max: f64) -> [f64; N] {
        let right = |values: &[f64; N]| {
            values.iter().all(|value| (min..=max).contains(value)) && values.is_sorted_by(|a, b| a < b)
        };
        self.that(right, &format!("each must lie between {min} and {max}, and be greater than the one before"))
    }

    /// Numbers for which `right` holds; `must` states it in words: "must be a unit vector".
    pub fn that(self, right: impl Fn(&[f64; N]) -> bool, must: &str) -> [f64; N] {
        if self.written.iter().any(|value| value.is_nan()) {
            return [f64::NAN; N];
        }
        if !right(&self.written) {
            self.place.refuse(must);
            return [f64::NAN; N];
        }
        self.written.map(|value| value * self.unit)
    }
}
