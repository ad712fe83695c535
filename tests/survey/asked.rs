//! What the surveys ask for: requests over the whole box of the acceptance runs, more than is granted, and their names.

use std::ops::RangeInclusive;

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
    GaitChange { turn: Some(turn_deg.to_radians()), speed: Some(speed), extension: Some(extension_deg.to_radians()) }
}

/// Any of the box.
pub(crate) fn any(random: &mut StdRng) -> GaitChange {
    let speed = random.random_range(SPEEDS);
    request(speed, random.random_range(TURNS_DEG), random.random_range(EXTENSIONS_DEG))
}

/// So many values, evenly over a range.
pub(crate) fn spread(range: &RangeInclusive<f64>, count: usize) -> impl Iterator<Item = f64> + Clone {
    let (start, step) = (*range.start(), (range.end() - range.start()) / (count - 1) as f64);
    (0..count).map(move |index| start + step * index as f64)
}

/// A command for people.
pub(crate) fn text(command: &Command) -> String {
    let Command { turn, speed, extension } = *command;
    format!("c {speed:.2} α {:.1}° β {:.1}°", turn.to_degrees(), extension.to_degrees())
}
