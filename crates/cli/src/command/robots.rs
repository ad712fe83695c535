//! `halfstep robots`: the robots in the box.

use config::Config;
use model::{LegReach, Mechanism};
use robots::ROBOTS;
use serde::Serialize;

use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// List the robots that come with the program: walk --robot NAME
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct RobotsArgs;

#[derive(Debug, Serialize)]
struct RobotJson {
    robot: &'static str,
    name: String,
    mass_kg: f64,
    leg_m: f64,
}

impl RobotsArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let robots: Result<Vec<RobotJson>, CliError> = ROBOTS
            .iter()
            .map(|robot| {
                let mechanism =
                    Mechanism::from_toml(robot.mechanism_text(), robot.name).map_err(CliError::bad_input)?;
                Ok(RobotJson {
                    robot: robot.name,
                    mass_kg: mechanism.mass(),
                    leg_m: LegReach::of(&mechanism).length(),
                    name: mechanism.name,
                })
            })
            .collect();
        let robots = robots?;
        if json {
            print_json(&robots)?;
        } else {
            for RobotJson { robot, name, mass_kg, leg_m } in robots {
                print_line(format_args!("{robot:<10}{mass_kg:6.1} kg, legs of {leg_m:.2} m  {name}"))?;
            }
        }
        Ok(Status::Success)
    }
}
