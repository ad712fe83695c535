//! The dials of the instrument: every number and choice with its value in our reading.

use serde::Serialize;

use crate::{Candidate, OPEN_NUMBERS, RAMPS, Reading, Scenario};

/// Everything that can be turned, and the figures that can be drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dials {
    /// The numbers, all of which the paper leaves open.
    pub numbers: Vec<NumberDial>,
    /// What is one of several.
    pub choices: Vec<ChoiceDial>,
    /// All figures.
    pub figures: Vec<FigureName>,
}

/// A number that can be turned.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NumberDial {
    /// Its name with its unit, as in configuration files.
    pub name: &'static str,
    /// The value in our reading, in the unit of the name.
    pub value: f64,
    /// Least and greatest value, in the unit of the name.
    pub reach: [f64; 2],
    /// Least difference of two values, in the unit of the name.
    pub grain: f64,
    /// The range in which it is plausible, in the unit of the name.
    pub plausible: [f64; 2],
    /// Why that range is plausible.
    pub basis: &'static str,
}

/// One of several.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChoiceDial {
    /// The name in a [`Question`](super::Question).
    pub name: &'static str,
    /// The choice of our reading.
    pub value: String,
    /// All choices.
    pub choices: Vec<String>,
    /// The choice that the paper states, if it states one.
    pub stated: Option<&'static str>,
}

/// A figure that can be drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureName {
    /// Its number in the paper.
    pub figure: u64,
    /// What walks in it.
    pub title: String,
}

/// The ramp of the paper: equal increments.
const STATED_RAMP: &str = RAMPS[0].0;

impl Dials {
    /// The dials of an instrument.
    ///
    /// * `as_read` – our reading
    /// * `axes` – names of the mechanisms' files
    pub(super) fn new(as_read: &Candidate, axes: &[&str], scenarios: &[Scenario]) -> Self {
        let numbers = OPEN_NUMBERS.iter().zip(as_read.grains).map(|(number, grains)| NumberDial {
            name: number.name,
            value: number.value(grains),
            reach: number.reach_of_values(),
            grain: number.value(1),
            plausible: number.range(),
            basis: number.basis,
        });
        let Reading { turn, extension } = as_read.reading;
        let ramps = [("turn_ramp", turn), ("extension_ramp", extension)].map(|(name, kind)| {
            let is_it = RAMPS.iter().filter(|(_, known)| *known == kind);
            ChoiceDial {
                name,
                value: is_it.map(|(known, _)| *known).collect(),
                choices: RAMPS.map(|(known, _)| known.to_owned()).into(),
                stated: Some(STATED_RAMP),
            }
        });
        let axes = ChoiceDial {
            name: "axes",
            value: axes.get(as_read.mechanism).copied().unwrap_or_default().to_owned(),
            choices: axes.iter().map(|file| (*file).to_owned()).collect(),
            // It states both.
            stated: None,
        };
        let name = |scenario: &Scenario| FigureName { figure: scenario.figure, title: scenario.title.clone() };
        Self {
            numbers: numbers.collect(),
            choices: ramps.into_iter().chain([axes]).collect(),
            figures: scenarios.iter().map(name).collect(),
        }
    }
}
