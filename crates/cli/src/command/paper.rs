//! `halfstep paper`: the paper's walking figures, reproduced.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use gait::RampKind;

use super::{print_json, print_line, write_pictures};
use crate::configuration::{ConfigOptions, Errors};
use crate::failure::{Failure, Outcome};
use crate::paper::{Figure, RAMPS, Reading, Row, Scenario, page, reproduce, table};
use crate::picture;

/// Reproduce the paper's walking figures: footprints, ZMP and verdict, beside what the paper says
#[derive(Clone, Debug, clap::Args)]
pub struct Paper {
    /// Only this figure
    #[arg(long, value_name = "N")]
    figure: Option<u64>,
    #[command(flatten)]
    config: ConfigOptions,
    /// How a turn grows through a half-step, if not as the folder's paper.toml says
    #[arg(long, value_name = "RAMP", value_parser = ramp())]
    turn_ramp: Option<RampKind>,
    /// How a step extension grows through a half-step, if not as the folder's paper.toml says
    #[arg(long, value_name = "RAMP", value_parser = ramp())]
    extension_ramp: Option<RampKind>,
    /// Draw the figures into this folder, and a page with all of them
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Paper {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let mut errors = Errors::default();
        let robot = self.config.robot(&mut errors);
        let reading = errors.note(Reading::load(&self.config.config.join("paper.toml")));
        let folder = self.config.config.join("scenarios");
        let mut scenarios = Scenario::load_all(&folder, &mut errors);
        if let Some(number) = self.figure {
            let numbers: Vec<String> = scenarios.iter().map(|scenario| scenario.figure.to_string()).collect();
            scenarios.retain(|scenario| scenario.figure == number);
            if scenarios.is_empty() {
                let there = numbers.join(", ");
                errors.0.push(format!("--figure {number}: {} has the figures {there}", folder.display()));
            }
        }
        let (robot, reading) = errors.finish(robot.zip(reading))?;
        let reading = Reading {
            turn: self.turn_ramp.unwrap_or(reading.turn),
            extension: self.extension_ramp.unwrap_or(reading.extension),
        };

        let figures = scenarios.iter().map(|scenario| reproduce(&robot, reading, scenario));
        let figures: Vec<Figure> = figures.collect::<Result<_, _>>().map_err(Failure::bad_input)?;
        if json {
            print_json(&figures.iter().map(Row::of).collect::<Vec<_>>())?;
        } else {
            print_line(table(&figures).trim_end())?;
        }
        let Some(out) = self.out else { return Ok(Outcome::Fine) };
        let pictures = figures.iter().map(|figure| picture::paper_figure(figure, &robot, reading));
        let pictures: Vec<String> = pictures.collect::<Result<_, _>>().map_err(Failure::bad_input)?;
        let names: Vec<String> =
            figures.iter().map(|figure| format!("figure_{:02}.svg", figure.scenario.figure)).collect();
        let page = page(&figures, &pictures);
        let files = names.iter().map(String::as_str).zip(pictures).chain([("index.html", page)]);
        write_pictures(&out, &files.collect::<Vec<_>>())?;
        if !json {
            print_line(format_args!("drawn: {}", out.join("index.html").display()))?;
        }
        Ok(Outcome::Fine)
    }
}

/// A ramp by its name.
fn ramp() -> impl TypedValueParser<Value = RampKind> {
    PossibleValuesParser::new(RAMPS.map(|(name, _)| name)).map(|name| {
        let found = RAMPS.into_iter().find(|(known, _)| *known == name);
        found.map_or_else(RampKind::default, |(_, kind)| kind)
    })
}
