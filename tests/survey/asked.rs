//! What the surveys ask for: requests over the whole box of the acceptance runs, more than is granted, and their names.

use std::ops::RangeInclusive;

use gait::Limits;
use interface::{Command, GaitChange};
use rand::{Rng, rngs::StdRng};

/// Of the speed factor `c`.
pub(crate) const SPEEDS: RangeInclusive<f64> = 0.5..=1.5;
/// Of the turn `α` (deg).
pub(crate) const TURNS_DEG: RangeInclusive<f64> = -30.0..=30.0;
/// Of the step extension `β` (deg).
pub(crate) const EXTENSIONS_DEG: RangeInclusive<f64> = -8.0..=12.0;

/// All three at once.
pub(crate) fn request(speed: f64, turn_deg: f64, extension_deg: f64) -> GaitChange {
    GaitChange {
        turn: Some(turn_deg.to_radians()),
        speed: Some(speed),
        extension: Some(extension_deg.to_radians()),
        ..GaitChange::NONE
    }
}

/// Any of the box.
pub(crate) fn any(random: &mut StdRng) -> GaitChange {
    let speed = random.random_range(SPEEDS);
    request(speed, random.random_range(TURNS_DEG), random.random_range(EXTENSIONS_DEG))
}

/// Any of the configured range: to every side, and backward.
pub(crate) fn any_direction(random: &mut StdRng, limits: &Limits) -> GaitChange {
    GaitChange {
        turn: Some(random.random_range(-limits.turn_max..=limits.turn_max)),
        speed: Some(random.random_range(limits.speed_min..=limits.speed_max)),
        extension: Some(random.random_range(limits.extension_min..=limits.extension_max)),
        sidestep: Some(random.random_range(-limits.sidestep_max..=limits.sidestep_max)),
    }
}

/// So many values, evenly over a range.
pub(crate) fn spread(range: &RangeInclusive<f64>, count: usize) -> impl Iterator<Item = f64> + Clone {
    let (start, step) = (*range.start(), (range.end() - range.start()) / (count - 1) as f64);
    (0..count).map(move |index| start + step * index as f64)
}

/// A command for people.
pub(crate) fn text(command: &Command) -> String {
    let Command { turn, speed, extension, sidestep } = *command;
    let [turn, extension, sidestep] = [turn, extension, sidestep].map(f64::to_degrees);
    format!("c {speed:.2} α {turn:.1}° β {extension:.1}° γ {sidestep:.1}°")
}
