//! The paper as an instrument: other numbers of body, walk and reading, and at once what becomes of its verdicts.

mod answer;
mod built_in;
mod dials;
mod error;
mod question;

pub use answer::{DrawnFigure, InstrumentAnswer, VerdictRow};
pub use built_in::{built_in_other_axes, built_in_reading, built_in_scenarios};
pub use dials::{ChoiceDial, Dials, FigureName, NumberDial};
pub use error::InstrumentError;
pub use question::Question;

use config::Config;
use gait::Robot;

use crate::{Candidate, FileText, Reading, Scenario, SearchBase, paper_figure, reproduce, summary};

/// The paper's figures with numbers that can be turned.
#[derive(Clone, Debug)]
pub struct Instrument {
    base: SearchBase,
    /// All scenarios, also those of which the paper states no verdict.
    scenarios: Vec<Scenario>,
    /// The body of the last answer, and what it walks: mostly the next question differs in sole or reading only.
    last: Option<(Candidate, Robot)>,
}

impl Instrument {
    /// An instrument that begins with our reading.
    ///
    /// * `mechanisms` – the mechanism's file, then other readings of the axes
    /// * `robot` – the robot of the first of them
    /// * `reading`, `scenarios` – files as in `config/`
    ///
    /// # Errors
    /// A file is wrong, or the robot cannot walk.
    pub fn new(
        mechanisms: Vec<FileText>,
        robot: &Robot,
        reading: FileText,
        scenarios: &[FileText],
    ) -> Result<Self, InstrumentError> {
        let as_read = Reading::from_toml(&reading.text, &reading.name)?;
        let scenarios = scenarios.iter().map(|file| Scenario::from_toml(&file.text, &file.name));
        let scenarios: Vec<Scenario> = scenarios.collect::<Result<_, _>>()?;
        let base = SearchBase::new(mechanisms, robot, as_read, reading.text, scenarios.clone())?;
        Ok(Self { base, scenarios, last: None })
    }

    /// Everything that can be turned, as in our reading.
    pub fn dials(&self) -> Dials {
        Dials::new(self.base.nearest(), &self.base.axes(), &self.scenarios)
    }

    /// The stated verdicts with the numbers of a question, and the figure that it asks for.
    ///
    /// # Errors
    /// A number or name of the question is wrong, or the body cannot walk with its numbers.
    pub fn answer(&mut self, question: &Question) -> Result<InstrumentAnswer, InstrumentError> {
        let candidate = question.candidate(*self.base.nearest(), &self.base.axes())?;
        let robot = self.robot(&candidate)?;
        let verdicts = self.base.verdicts_of(&robot, &candidate)?;
        let drawn = question.figure.map(|figure| self.draw(figure, &robot, &candidate)).transpose()?;
        Ok(InstrumentAnswer::new(self.base.scenarios(), &verdicts, drawn))
    }

    /// The robot of a candidate.
    fn robot(&mut self, candidate: &Candidate) -> Result<Robot, InstrumentError> {
        let body = candidate.with_sole_and_reading_of(self.base.nearest());
        let mut robot = match self.last.take().filter(|(last, _)| *last == body) {
            Some((_, robot)) => robot,
            None => self.base.robot(&body)?,
        };
        robot.mechanism.sole = self.base.sole(candidate);
        self.last = Some((body, robot.clone()));
        Ok(robot)
    }

    fn draw(&self, figure: u64, robot: &Robot, candidate: &Candidate) -> Result<DrawnFigure, InstrumentError> {
        let scenario = self.scenarios.iter().find(|scenario| scenario.figure == figure);
        let scenario = candidate.scenario(scenario.ok_or(InstrumentError::UnknownFigure(figure))?);
        let figure = reproduce(robot, candidate.reading, &scenario)?;
        Ok(DrawnFigure {
            figure: scenario.figure,
            summary: summary(&figure),
            note: scenario.note,
            margin_mm: figure.extents.margin * 1e3,
            svg: paper_figure(&figure, robot, candidate.reading)?,
        })
    }
}
