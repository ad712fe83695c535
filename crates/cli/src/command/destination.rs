//! The destinations of `halfstep send`: a goal pose, or footsteps from a file.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use dialogue::place_json::read_footsteps;
use interface::{Destination, GaitChange, PlaceFrame, PlaceList, Places, Request, Source, Waypoint};

use super::options::number;
use crate::error::CliError;

/// Walk to a goal and stand there, feet side by side; stop cancels it
#[derive(Clone, Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct GotoArgs {
    /// Metres ahead, in the frame in which the controller started: origin in the middle between the feet
    #[arg(value_parser = number)]
    x: f64,
    /// Metres to the left, likewise
    #[arg(value_parser = number)]
    y: f64,
    /// Heading at the goal in degrees, positive to the left [default: any]
    #[arg(value_parser = number)]
    heading: Option<f64>,
    #[command(flatten)]
    way: WayOptions,
}

/// Walk by given footsteps and stand as the last two have landed; stop cancels it
#[derive(Clone, Debug, clap::Args)]
#[command(allow_negative_numbers = true)]
pub(super) struct FootstepsArgs {
    /// JSON file with an array of up to 24 footsteps, right and left in turn, such as
    /// {"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}; - is stdin
    file: String,
    #[command(flatten)]
    way: WayOptions,
}

/// How to walk to a destination.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct WayOptions {
    /// Seen from the robot, where it is when the request is evaluated
    #[arg(long)]
    relative: bool,
    /// Speed as a multiple of the nominal speed
    #[arg(long, value_name = "C", value_parser = number)]
    speed: Option<f64>,
    /// Tell the distance left once a second, and end when the robot is there: with exit code 1 if it was cancelled or
    /// the robot fell
    #[arg(long)]
    pub wait: bool,
}

/// Longest file of footsteps (bytes): a longer one is none.
const LONGEST: u64 = 1 << 20;
const EXAMPLE: &str = r#"write e.g. [{"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}]"#;

impl GotoArgs {
    pub(super) fn way(&self) -> WayOptions {
        self.way
    }

    pub(super) fn request(&self) -> Request {
        let goal = Waypoint { x: self.x, y: self.y, heading: self.heading.map(f64::to_radians) };
        self.way.request(PlaceList::new(&[goal]).map(Places::Waypoints))
    }
}

impl FootstepsArgs {
    pub(super) fn way(&self) -> WayOptions {
        self.way
    }

    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read, or is no array of footsteps.
    pub(super) fn request(&self) -> Result<Request, CliError> {
        let (name, source): (_, Box<dyn Read>) = if self.file == "-" {
            ("stdin", Box::new(io::stdin()))
        } else {
            let path = Path::new(&self.file);
            (self.file.as_str(), Box::new(File::open(path).map_err(CliError::input_file(path))?))
        };
        let mut text = String::new();
        source.take(LONGEST).read_to_string(&mut text).map_err(CliError::input_file(Path::new(name)))?;
        Ok(self.way.request(Some(footsteps(name, &text)?)))
    }
}

impl WayOptions {
    fn request(self, places: Option<Places>) -> Request {
        let frame = if self.relative { PlaceFrame::Robot } else { PlaceFrame::Walk };
        Request {
            gait: GaitChange { speed: self.speed, ..GaitChange::NONE },
            destination: places.map(|places| Destination { frame, places }),
            ..Request::new(Source::Console)
        }
    }
}

/// The footsteps of a text; what is wrong is told with its line and column.
fn footsteps(name: &str, text: &str) -> Result<Places, CliError> {
    read_footsteps(text).map_err(|error| {
        let (problem, line, column) = (error.to_string(), error.line(), error.column());
        let problem = problem.split(" at line ").next().unwrap_or_default();
        CliError::bad_input(format!("{name}:{line}:{column}: {problem}; {EXAMPLE}"))
    })
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    enum Typed {
        Goto(GotoArgs),
    }

    fn goto(words: &str) -> Request {
        let Typed::Goto(args) = Typed::try_parse_from(words.split(' ')).expect("a good command line");
        args.request()
    }

    #[test]
    fn a_goal_is_typed_in_metres_and_degrees_and_may_be_negative() {
        let goal = |heading| {
            let places = PlaceList::new(&[Waypoint { x: -1.5, y: -0.25, heading }]).map(Places::Waypoints);
            places.expect("one place")
        };
        let plain = Destination { frame: PlaceFrame::Walk, places: goal(None) };
        assert_eq!(goto("send goto -1.5 -0.25"), Request { destination: Some(plain), ..Request::new(Source::Console) });
        let turned = goto("send goto -1.5 -0.25 -180 --relative --speed 1.2");
        let places = goal(Some(-std::f64::consts::PI));
        assert_eq!(turned.destination, Some(Destination { frame: PlaceFrame::Robot, places }));
        assert_eq!(turned.gait, GaitChange { speed: Some(1.2), ..GaitChange::NONE });
        assert!(Typed::try_parse_from(["send", "goto", "1"]).is_err(), "y is missing");
    }

    #[test]
    fn a_wrong_file_is_told_with_its_line_and_place() {
        let text = "[\n{\"side\":\"left\",\"x_m\":0.2,\"y_m\":0.1,\"heading_deg\":0},\n{\"side\":\"left\"}\n]";
        let told = footsteps("steps.json", text).expect_err("a wrong file").to_string();
        assert!(told.starts_with("steps.json:3:15: place 2: missing field `x_m`; write e.g. [{\"side\""), "{told}");
    }
}
