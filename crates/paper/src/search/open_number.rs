//! The numbers that the paper leaves open, with the range in which each is plausible.

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
}

/// Number of open numbers.
pub(super) const OPEN_COUNT: usize = 13;

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
];

/// Number of the open numbers that describe the sole.
pub(super) const SOLE_COUNT: usize = 4;

const fn number(name: &'static str, grains_per_unit: i32, min: i32, max: i32, basis: &'static str) -> OpenNumber {
    OpenNumber { name, grains_per_unit, min, max, basis }
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

    /// The least and the greatest plausible value.
    pub fn range(&self) -> [f64; 2] {
        [self.min, self.max].map(|grains| self.value(grains))
    }
}
