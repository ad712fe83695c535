//! The paper as an instrument, with the robot and the reading in the box.

use lockstep::WalkableRobot;
use paper::{
    Dials, FileText, Instrument, InstrumentAnswer, Question, built_in_other_axes, built_in_reading, built_in_scenarios,
};
use robots::BuiltInRobot;
use serde::Serialize;

/// A message to the page.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PaperNews {
    /// What can be turned.
    Dials(Dials),
    /// What comes out.
    Answer(InstrumentAnswer),
    /// There is no answer, in words.
    Problem(String),
}

impl PaperNews {
    /// The message as a text.
    pub fn text(&self) -> String {
        // Nothing in it could fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// The paper as an instrument.
#[derive(Clone, Debug)]
pub struct PaperInstrument(Instrument);

impl PaperInstrument {
    /// The instrument as our reading has it.
    ///
    /// # Errors
    /// A file in the box is wrong, in words.
    pub fn new() -> Result<Self, String> {
        let paper = BuiltInRobot::of_the_paper();
        let walkable = WalkableRobot::in_the_box(paper.name).map_err(|error| error.to_string())?;
        let mechanism = FileText { name: "mechanism.toml".to_owned(), text: paper.mechanism_text().to_owned() };
        let mechanisms = vec![mechanism, built_in_other_axes()];
        let instrument = Instrument::new(mechanisms, &walkable.robot, built_in_reading(), &built_in_scenarios());
        instrument.map(Self).map_err(|error| error.to_string())
    }

    /// What can be turned.
    pub fn dials(&self) -> PaperNews {
        PaperNews::Dials(self.0.dials())
    }

    /// Answers a [`Question`], as JSON.
    pub fn answer(&mut self, question: &[u8]) -> PaperNews {
        let question = serde_json::from_slice::<Question>(question).map_err(|error| error.to_string());
        let answer = question.and_then(|question| self.0.answer(&question).map_err(|error| error.to_string()));
        answer.map_or_else(PaperNews::Problem, PaperNews::Answer)
    }
}
