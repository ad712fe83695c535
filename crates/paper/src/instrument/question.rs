//! A question: numbers, ramps and axes that differ from our reading, and the figure to draw.

use std::collections::BTreeMap;

use gait::RampKind;
use serde::Deserialize;

use super::error::InstrumentError;
use crate::{Candidate, OPEN_NUMBERS, RAMPS};

/// What is asked. Whatever it leaves out is as in our reading.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Question {
    /// Values by the names of [`OPEN_NUMBERS`], in the units of these names (m, s, °, or a share).
    pub numbers: BTreeMap<String, f64>,
    /// Ramp of a turn, by its name in files.
    pub turn_ramp: Option<String>,
    /// Ramp of a step extension, by its name in files.
    pub extension_ramp: Option<String>,
    /// Which way joints turn: the mechanism's file.
    pub axes: Option<String>,
    /// The figure to draw.
    pub figure: Option<u64>,
}

impl Question {
    /// The candidate that it describes.
    ///
    /// * `as_read` – our reading
    /// * `axes` – names of the mechanisms' files
    ///
    /// # Errors
    /// The first name that is unknown, or number out of reach.
    pub(super) fn candidate(&self, as_read: Candidate, axes: &[&str]) -> Result<Candidate, InstrumentError> {
        let mut candidate = as_read;
        for (name, value) in &self.numbers {
            let Some(open) = OPEN_NUMBERS.iter().position(|number| number.name == name) else {
                let known = OPEN_NUMBERS.map(|number| number.name).into();
                return Err(InstrumentError::UnknownNumber { name: name.clone(), known });
            };
            let number = OPEN_NUMBERS[open];
            let grains = number.within_reach(*value).ok_or_else(|| InstrumentError::OutOfReach {
                name: number.name,
                value: *value,
                reach: number.reach_of_values(),
            })?;
            candidate = candidate.with(open, grains);
        }
        if let Some(chosen) = &self.turn_ramp {
            candidate.reading.turn = ramp("turn_ramp", chosen)?;
        }
        if let Some(chosen) = &self.extension_ramp {
            candidate.reading.extension = ramp("extension_ramp", chosen)?;
        }
        if let Some(chosen) = &self.axes {
            let place = axes.iter().position(|known| known == chosen);
            candidate.mechanism = place.ok_or_else(|| unknown("axes", chosen, axes))?;
        }
        Ok(candidate)
    }
}

fn ramp(name: &'static str, chosen: &str) -> Result<RampKind, InstrumentError> {
    let found = RAMPS.iter().find(|(known, _)| *known == chosen);
    found.map(|(_, kind)| *kind).ok_or_else(|| unknown(name, chosen, &RAMPS.map(|(known, _)| known)))
}

fn unknown(name: &'static str, chosen: &str, known: &[&str]) -> InstrumentError {
    let known = known.iter().map(|known| format!("\"{known}\"")).collect();
    InstrumentError::UnknownChoice { name, chosen: chosen.to_owned(), known }
}
