//! `halfstep paper`: the paper's walking figures, reproduced.

use std::path::PathBuf;

use ::paper::{Figure, RAMPS, Reading, Scenario, TableRow, page, paper_figure, reproduce, table};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use config::Config;
use gait::{RampKind, Robot};
use node::configuration::Errors;

use super::config_options::ConfigOptions;
use super::paper_files::PaperFiles;
use super::paper_search::SearchArgs;
use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::output_folder::OutputFolder;
use crate::status::Status;

/// Reproduce the paper's walking figures: footprints, ZMP and verdict, beside the paper's
#[derive(Clone, Debug, clap::Args)]
pub(super) struct PaperArgs {
    /// Only this figure
    #[arg(long, value_name = "N")]
    figure: Option<u64>,
    #[command(flatten)]
    config: ConfigOptions,
    /// Ramp of a turn within a half-step [default: paper.toml of the folder]
    #[arg(long, value_name = "RAMP", value_parser = ramp())]
    turn_ramp: Option<RampKind>,
    /// Ramp of a step extension within a half-step [default: paper.toml of the folder]
    #[arg(long, value_name = "RAMP", value_parser = ramp())]
    extension_ramp: Option<RampKind>,
    /// Draw the figures into this folder, and a page with all of them
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace other files in the folder
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    search: SearchArgs,
}

/// Name of the page with all figures.
const PAGE: &str = "index.html";

impl PaperArgs {
    pub(super) fn run(mut self, json: bool) -> Result<Status, CliError> {
        self.config.resolve()?;
        let mut errors = Errors::default();
        let files = self.config.files();
        let robot = files.robot(&mut errors);
        let texts = errors.note(PaperFiles::of(&files.folder, &files.mechanism_file()));
        let reading =
            texts.as_ref().and_then(|texts| errors.note(Reading::from_toml(&texts.reading.text, &texts.reading.name)));
        let scenarios = texts.as_ref().and_then(|texts| errors.note(Scenario::read_all(&texts.scenarios)));
        let mut scenarios = scenarios.unwrap_or_default();
        if let Some(number) = self.figure {
            let numbers: Vec<String> = scenarios.iter().map(|scenario| scenario.figure.to_string()).collect();
            scenarios.retain(|scenario| scenario.figure == number);
            if scenarios.is_empty() {
                errors.0.push(format!("--figure {number}: there are the figures {}", numbers.join(", ")));
            }
        }
        let ((robot, reading), texts) = errors.finish(robot.zip(reading).zip(texts))?;
        if self.search.search {
            return self.search.run(&files, texts, (&robot, reading), scenarios, self.out.as_deref(), json);
        }
        let reading = Reading {
            turn: self.turn_ramp.unwrap_or(reading.turn),
            extension: self.extension_ramp.unwrap_or(reading.extension),
        };

        let out = self.out.as_deref().map(|out| OutputFolder::open(out, self.force)).transpose()?;
        let figures = scenarios.iter().map(|scenario| reproduce(&robot, reading, scenario));
        let figures: Vec<Figure> = figures.collect::<Result<_, _>>().map_err(CliError::bad_input)?;
        if let Some(out) = &out {
            draw(out, &figures, &robot, reading)?;
        }
        if json {
            print_json(&figures.iter().map(TableRow::of).collect::<Vec<_>>())?;
            return Ok(Status::Success);
        }
        print_line(table(&figures).trim_end())?;
        if let Some(out) = &out {
            print_line(format_args!("drawn: {}", out.join(PAGE).display()))?;
        }
        Ok(Status::Success)
    }
}

/// Draws the figures, and a page with all of them.
fn draw(out: &OutputFolder, figures: &[Figure], robot: &Robot, reading: Reading) -> Result<(), CliError> {
    let pictures = figures.iter().map(|figure| paper_figure(figure, robot, reading));
    let pictures: Vec<String> = pictures.collect::<Result<_, _>>().map_err(CliError::bad_input)?;
    let names: Vec<String> = figures.iter().map(|figure| format!("figure_{:02}.svg", figure.scenario.figure)).collect();
    let page = page(figures, &pictures);
    let files = names.iter().map(String::as_str).zip(pictures).chain([(PAGE, page)]);
    out.write(&files.collect::<Vec<_>>())
}

/// A ramp by its name.
fn ramp() -> impl TypedValueParser<Value = RampKind> {
    PossibleValuesParser::new(RAMPS.map(|(name, _)| name)).map(|name| {
        let found = RAMPS.into_iter().find(|(known, _)| *known == name);
        found.map_or_else(RampKind::default, |(_, kind)| kind)
    })
}
