//! The numbers that the paper leaves open, with the range in which each is plausible.

use std::ops::RangeInclusive;

/// A number of body or walk that the paper does not state. Values are counted in grains, so that each is a short
/// decimal and text keeps its bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenNumber {
    /// Name with its unit, as in configuration files.
    pub name: &'static str,
    /// Grains in one unit.
    pub grains_per_unit: i32,
    /// Least plausible value, in grains.
    pub min: i32,
    /// Greatest plausible value, in grains.
    pub max: i32,
    /// Why the range is plausible.
    pub basis: &'static str,
    /// Whether a search varies it without being told to.
    pub is_searched: bool,
}

/// Number of open numbers.
pub(super) const OPEN_COUNT: usize = 16;

/// Which open number: the place in [`OPEN_NUMBERS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Open {
    Heel,
    Toe,
    Inside,
    Outside,
    Duration,
    StepLength,
    Extension,
    PelvisSway,
    PelvisSetback,
    Clearance,
    Stature,
    HipDistance,
    TrunkMass,
    LegMass,
    ArmMass,
    HipHeight,
}

/// The open numbers, those of the sole first: no path of the ZMP depends on them.
pub const OPEN_NUMBERS: [OpenNumber; OPEN_COUNT] = [
    number("heel_m", 2000, 100, 200, "ankle to heel of adults, bare or in a shoe"),
    number("toe_m", 1000, 170, 230, "ankle to toe of adults, bare or in a shoe"),
    number("inside_m", 1000, 35, 55, "half the width of a sole, towards the other foot"),
    number("outside_m", 1000, 35, 55, "half the width of a sole, outward"),
    number("duration_s", 200, 100, 160, "75 to 120 half-steps a minute"),
    number("step_length_m", 500, 90, 200, "slow to comfortable steps of robot or man"),
    number("extension_deg", 2, 6, 16, "the paper's \"extended\" step, whose angle it does not state"),
    number("pelvis_sway_m", 1000, 20, 50, "sway of a walking man"),
    number("pelvis_setback_m", 1000, 0, 50, "from an upright trunk to one that leans back 20°"),
    number("clearance_m", 200, 4, 16, "height of a swing foot"),
    number("stature_share", 100, 90, 110, "1.57 to 1.92 m, the adults of the tables"),
    number("hip_distance_m", 200, 32, 42, "distance between adult hip joints"),
    number("trunk_mass_share", 100, 90, 110, "spread of trunk masses between published tables"),
    left_alone("leg_mass_share", 100, 90, 110, "spread of leg masses between published tables"),
    left_alone("arm_mass_share", 100, 80, 120, "spread of arm masses between published tables"),
    left_alone("hip_height_share", 100, 92, 102, "from well bent to almost stretched knees"),
];

/// Number of the open numbers that describe the sole.
pub(super) const SOLE_COUNT: usize = 4;

const fn number(name: &'static str, grains_per_unit: i32, min: i32, max: i32, basis: &'static str) -> OpenNumber {
    OpenNumber { name, grains_per_unit, min, max, basis, is_searched: true }
}

/// A number that a search leaves as it is unless it is told to vary it: others have nearly the same effect.
const fn left_alone(name: &'static str, grains_per_unit: i32, min: i32, max: i32, basis: &'static str) -> OpenNumber {
    OpenNumber { is_searched: false, ..number(name, grains_per_unit, min, max, basis) }
}

impl OpenNumber {
    /// The value of so many grains.
    pub fn value(&self, grains: i32) -> f64 {
        f64::from(grains) / f64::from(self.grains_per_unit)
    }

    /// The plausible number of grains nearest to a value.
    pub fn nearest(&self, value: f64) -> i32 {
        ((value * f64::from(self.grains_per_unit)).round() as i32).clamp(self.min, self.max)
    }

    /// The values that are worth a look, in grains: beyond the plausible range by half of it at either end, but no
    /// length or time of nothing.
    pub fn reach(&self) -> RangeInclusive<i32> {
        let beyond = (self.max - self.min) / 2;
        (self.min - beyond).max(self.min.min(1))..=self.max + beyond
    }

    /// The least and the greatest of these values.
    pub fn reach_of_values(&self) -> [f64; 2] {
        let reach = self.reach();
        [*reach.start(), *reach.end()].map(|grains| self.value(grains))
    }

    /// The number of grains nearest to a value, if that is worth a look.
    pub fn within_reach(&self, value: f64) -> Option<i32> {
        // A number that is none, or too great, is at no end of any reach.
        let grains = (value * f64::from(self.grains_per_unit)).round() as i32;
        Some(grains).filter(|grains| value.is_finite() && self.reach().contains(grains))
    }

    /// The least and the greatest plausible value.
    pub fn range(&self) -> [f64; 2] {
        [self.min, self.max].map(|grains| self.value(grains))
    }
}
