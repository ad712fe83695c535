//! Scripts: requests with their times, one JSON object per line.
//!
//! ```text
//! {"t": 1.5, "turn_deg": 10, "speed": 1.2, "extension_deg": 0, "sidestep_deg": 0, "intent": "walk"}
//! {"t": 3.0, "vx": 0.3, "vy": -0.1, "wz_deg_s": 15}
//! {"t": 9.0, "goto": {"x_m": 3, "y_m": 2, "heading_deg": 90}, "speed": 1.1}
//! {"footsteps": [{"side": "left", "x_m": 0.2, "y_m": 0.1, "heading_deg": 0}], "relative": true}
//! ```
//!
//! The second line is a velocity in m/s ahead and to the left and in °/s, instead of gait parameters: what is left out
//! of it is 0, and zero is a stand.
//!
//! The third is a destination in the walk frame, or an array of way-points to it; the fourth is footsteps, here seen
//! from the robot (see `place_json`). Of the gait parameters only a speed goes with either.
//!
//! `t` is the time since the start (s) and must not decrease; a request without it is due at once. At least one of the
//! other keys is required. Empty lines are skipped. A request's id is the number of its line.

use std::io::BufRead;
use std::time::Duration;

use interface::{Destination, GaitChange, Intent, PlaceFrame, Places, Rate, Request, Source, WalkVelocity};
use serde::{Deserialize, Deserializer};

use crate::lines::{BadLine, InputLines};
use crate::place_json;

/// A line of a script: a request and its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedRequest {
    /// Time since the start; `None` is at once.
    pub time: Option<Duration>,
    /// The request; its sender sets the tick before which it must not take effect.
    pub request: Request,
}

/// Reads a script line by line.
#[derive(Clone, Debug)]
pub struct Reader {
    name: String,
    line: u64,
    time: f64,
}

/// A line of a script that is no request.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}:{line}: {problem}")]
pub struct ScriptError {
    /// The file's name.
    pub name: String,
    /// Number of the line, from 1.
    pub line: u64,
    /// What is wrong, and what would be valid.
    pub problem: String,
}

/// A line as it is written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    t: Option<f64>,
    turn_deg: Option<f64>,
    speed: Option<f64>,
    extension_deg: Option<f64>,
    sidestep_deg: Option<f64>,
    vx: Option<f64>,
    vy: Option<f64>,
    wz_deg_s: Option<f64>,
    #[serde(default, deserialize_with = "place_json::waypoints")]
    goto: Option<Places>,
    #[serde(default, deserialize_with = "place_json::footsteps")]
    footsteps: Option<Places>,
    relative: Option<bool>,
    #[serde(default, deserialize_with = "intent")]
    intent: Option<Intent>,
}

const EXAMPLE: &str = r#"write e.g. {"t":1.5,"turn_deg":10,"speed":1.2,"extension_deg":0,"intent":"walk"}"#;
const VELOCITY_EXAMPLE: &str = r#"{"t":1.5,"vx":0.3,"vy":-0.1,"wz_deg_s":15}"#;
const GOTO_EXAMPLE: &str = r#"{"t":1.5,"goto":{"x_m":3,"y_m":2,"heading_deg":90},"relative":true}"#;
const FOOTSTEPS_EXAMPLE: &str = r#"{"footsteps":[{"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}]}"#;
/// Latest time (s): longer than anyone walks, so that a later one is a mistake of unit.
const TIME_MAX: f64 = 1e6;
/// Most wrong lines of a script that are told.
const ERRORS_MAX: usize = 100;
/// Most lines of a whole script.
const LINES_MAX: u64 = 1_000_000;

impl Reader {
    /// A reader before the first line of a file with this name.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), line: 0, time: 0.0 }
    }

    /// The number of the last line that was read, from 1.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Reads the next line; `None` if it is empty.
    ///
    /// # Errors
    /// The line is no request. The next line can be read all the same.
    pub fn read(&mut self, text: Result<&str, BadLine>) -> Option<Result<TimedRequest, ScriptError>> {
        self.line += 1;
        let number = self.line;
        let timed = match text.map(str::trim) {
            Ok("") => return None,
            Ok(text) => timed_request(text, &mut self.time),
            Err(bad) => Err(format!("{bad}; {EXAMPLE}")),
        };
        let problem = |problem| ScriptError { name: self.name.clone(), line: number, problem };
        let numbered = |timed: TimedRequest| TimedRequest { request: Request { id: number, ..timed.request }, ..timed };
        Some(timed.map(numbered).map_err(problem))
    }

    /// Reads a whole script.
    ///
    /// # Errors
    /// Every line that is no request, up to a hundred, that the input ends with an error, or that it has more than a
    /// million lines.
    pub fn read_all(name: impl Into<String>, input: impl BufRead) -> Result<Vec<TimedRequest>, Vec<ScriptError>> {
        let mut reader = Self::new(name);
        let (mut steps, mut errors) = (Vec::new(), Vec::new());
        for line in InputLines::new(input) {
            let read = match line {
                Ok(line) => reader.read(line.as_deref().map_err(|bad| *bad)),
                Err(error) => {
                    let (name, line, problem) = (reader.name.clone(), reader.line + 1, error.to_string());
                    errors.push(ScriptError { name, line, problem });
                    break;
                }
            };
            match read {
                None => {}
                Some(Ok(step)) => steps.push(step),
                Some(Err(error)) => errors.push(error),
            }
            let problem = if errors.len() == ERRORS_MAX {
                Some(format!("the {ERRORS_MAX}th wrong line; what follows is not read"))
            } else if reader.line > LINES_MAX {
                Some(format!("it has more than {LINES_MAX} lines; what follows is not read"))
            } else {
                None
            };
            if let Some(problem) = problem {
                errors.push(ScriptError { name: reader.name.clone(), line: reader.line, problem });
                break;
            }
        }
        if errors.is_empty() { Ok(steps) } else { Err(errors) }
    }
}

impl TimedRequest {
    /// The tick at which the request is due if the script starts at tick 0; 0 is at once.
    pub fn tick(&self, rate: Rate) -> u64 {
        self.time.map_or(0, |time| rate.ticks(time))
    }
}

/// Reads a line; `last` is the time of the previous line.
fn timed_request(text: &str, last: &mut f64) -> Result<TimedRequest, String> {
    // serde would accept an array as well, which nobody could read.
    if !text.starts_with('{') {
        return Err(format!("not a JSON object; {EXAMPLE}"));
    }
    let line_text = text;
    let line: Line = serde_json::from_str(text).map_err(|error| {
        let (text, column) = (error.to_string(), error.column());
        let text = text.split(" at line ").next().unwrap_or_default();
        format!("{text} (column {column}); {}", example(line_text))
    })?;
    let destination = destination(&line)?;
    let Line { t, turn_deg, speed, extension_deg, sidestep_deg, vx, vy, wz_deg_s, intent, .. } = line;
    let velocity = vx.or(vy).or(wz_deg_s).map(|_| WalkVelocity {
        ahead: vx.unwrap_or(0.0),
        left: vy.unwrap_or(0.0),
        turn: wz_deg_s.unwrap_or(0.0).to_radians(),
    });
    let has_parameters = turn_deg.or(speed).or(extension_deg).or(sidestep_deg).is_some();
    if has_parameters && velocity.is_some() {
        return Err(format!("a velocity and gait parameters in one line; {EXAMPLE} or {VELOCITY_EXAMPLE}"));
    }
    if velocity.is_some() && intent.is_some_and(|intent| intent != Intent::Walk) {
        return Err(format!("a velocity goes with no intent but \"walk\"; write e.g. {VELOCITY_EXAMPLE}"));
    }
    if !has_parameters && velocity.is_none() && destination.is_none() && intent.is_none() {
        return Err(format!("no command in this line; {EXAMPLE}"));
    }
    if let Some(t) = t {
        if !(0.0..=TIME_MAX).contains(&t) {
            return Err(format!("t = {t}: must be seconds since the beginning, at least 0 and at most {TIME_MAX}"));
        }
        if t < *last {
            return Err(format!("t = {t}: must not be less than {last}, the time of an earlier line"));
        }
        *last = t;
    }
    let request = Request {
        intent,
        gait: GaitChange {
            turn: turn_deg.map(f64::to_radians),
            speed,
            extension: extension_deg.map(f64::to_radians),
            sidestep: sidestep_deg.map(f64::to_radians),
        },
        velocity,
        destination,
        ..Request::new(Source::Script)
    };
    Ok(TimedRequest { time: t.map(Duration::from_secs_f64), request })
}

/// The destination of a line, which goes with a speed and with nothing else.
fn destination(line: &Line) -> Result<Option<Destination>, String> {
    let (places, example) = match (line.goto, line.footsteps) {
        (None, None) if line.relative.is_some() => {
            return Err(format!("relative without goto or footsteps; write e.g. {GOTO_EXAMPLE}"));
        }
        (None, None) => return Ok(None),
        (Some(waypoints), None) => (waypoints, GOTO_EXAMPLE),
        (None, Some(footsteps)) => (footsteps, FOOTSTEPS_EXAMPLE),
        (Some(_), Some(_)) => return Err("goto and footsteps in one line: ask for one of them".to_owned()),
    };
    let others = [line.turn_deg, line.extension_deg, line.sidestep_deg, line.vx, line.vy, line.wz_deg_s];
    if others.iter().any(Option::is_some) {
        return Err(format!("of the gait parameters only a speed goes with a destination; write e.g. {example}"));
    }
    if line.intent.is_some_and(|intent| intent != Intent::Walk) {
        return Err(format!("a destination goes with no intent but \"walk\"; write e.g. {example}"));
    }
    let frame = if line.relative == Some(true) { PlaceFrame::Robot } else { PlaceFrame::Walk };
    Ok(Some(Destination { frame, places }))
}

/// An example of the kind of line that was meant.
fn example(text: &str) -> String {
    if text.contains("\"goto\"") {
        format!("write e.g. {GOTO_EXAMPLE}")
    } else if text.contains("\"footsteps\"") {
        format!("write e.g. {FOOTSTEPS_EXAMPLE}")
    } else {
        EXAMPLE.to_owned()
    }
}

fn intent<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<Intent>, D::Error> {
    let Some(word) = Option::<String>::deserialize(deserializer)? else { return Ok(None) };
    let known = Intent::ALL.iter().find(|intent| intent.text() == word);
    known.copied().map(Some).ok_or_else(|| {
        let words: Vec<_> = Intent::ALL.iter().map(|intent| format!("\"{intent}\"")).collect();
        serde::de::Error::custom(format!("intent = \"{word}\": must be one of {}", words.join(", ")))
    })
}

#[cfg(test)]
mod tests {
    use interface::{Footstep, PlaceList, WalkPose, Waypoint};
    use model::Side;

    use super::*;

    proptest::proptest! {
        #[test]
        fn any_line_is_a_request_or_an_error_with_its_place(
            parts in proptest::collection::vec((0..27_usize, ".{0,8}"), 0..24),
        ) {
            const PIECES: [&str; 23] = [
                "{", "}", "\"t\"", ":", ",", "\"turn_deg\"", "\"speed\"", "\"intent\"", "\"walk\"", "\"stop\"", "1.5",
                "-1e999", "1e308", "null", "[", "]", "\"extension_deg\"", "nan", "\u{0}", "\n",
                "\"goto\"", "\"x_m\":1", "\"y_m\":2",
            ];
            let text: String =
                parts.iter().map(|(piece, other)| *PIECES.get(*piece).unwrap_or(&other.as_str())).collect();
            match Reader::read_all("fuzz", text.as_bytes()) {
                Ok(steps) => assert!(steps.iter().all(|step| step.time.is_none_or(|t| t.as_secs_f64() <= TIME_MAX))),
                Err(errors) => assert!(errors.iter().all(|error| error.to_string().starts_with("fuzz:"))),
            }
        }
    }

    fn problem(line: &str) -> String {
        Reader::new("f").read(Ok(line)).expect("a line").expect_err("it is wrong").to_string()
    }

    #[test]
    fn script_line_is_read_in_degrees_and_seconds() {
        let step = Reader::new("f").read(Ok(r#"{"t":1.5,"turn_deg":180,"speed":1.2,"intent":"stop"}"#));
        let step = step.unwrap().unwrap();
        assert_eq!(step.tick(Rate::clamped(1000)), 1500);
        assert_eq!(step.request.gait.turn, Some(std::f64::consts::PI));
        assert_eq!((step.request.gait.speed, step.request.gait.extension), (Some(1.2), None));
        assert_eq!((step.request.intent, step.request.id), (Some(Intent::Stop), 1));
    }

    #[test]
    fn script_errors_name_line_and_remedy() {
        let text = problem(r#"{"t":1,"trun_deg":5}"#);
        assert!(text.starts_with("f:1: unknown field `trun_deg`, expected one of `t`, `turn_deg`, `speed`"), "{text}");
        assert!(problem("[1, 2]").starts_with("f:1: not a JSON object; write e.g. {"));
        assert!(problem(r#"{"t":1}"#).starts_with("f:1: no command in this line"));
        assert!(problem(r#"{"t":-1,"speed":1}"#).starts_with("f:1: t = -1: must be"));
        assert!(problem(r#"{"speed":1e999}"#).starts_with("f:1: number out of range"));
        assert!(problem(r#"{"intent":"fly"}"#).contains("intent = \"fly\": must be one of \"walk\", \"stop\""));
        assert!(problem(r#"{"speed":1"#).starts_with("f:1: EOF while parsing an object"));
    }

    #[test]
    fn a_velocity_is_read_in_metres_and_degrees_per_second_and_goes_with_nothing_else() {
        let step = Reader::new("f").read(Ok(r#"{"vx":0.3,"wz_deg_s":180}"#)).unwrap().unwrap();
        let expected = WalkVelocity { ahead: 0.3, left: 0.0, turn: std::f64::consts::PI };
        assert_eq!((step.request.velocity, step.request.gait), (Some(expected), GaitChange::NONE));
        assert!(problem(r#"{"vx":0.3,"turn_deg":5}"#).starts_with("f:1: a velocity and gait parameters in one line"));
        assert!(problem(r#"{"vx":0.3,"intent":"stop"}"#).starts_with("f:1: a velocity goes with no intent but"));
        assert!(Reader::new("f").read(Ok(r#"{"vx":0.3,"intent":"walk"}"#)).unwrap().is_ok());
    }

    fn destination_of(line: &str) -> Destination {
        let step = Reader::new("f").read(Ok(line)).expect("a line").expect("it is right");
        step.request.destination.expect("a destination")
    }

    #[test]
    fn a_destination_is_read_in_metres_and_degrees() {
        let waypoint = |heading| Waypoint { x: 3.0, y: -2.0, heading };
        let goal = r#"{"x_m":3,"y_m":-2,"heading_deg":180}"#;
        let alone = destination_of(&format!(r#"{{"goto":{goal}}}"#));
        let expected = Places::Waypoints(PlaceList::new(&[waypoint(Some(std::f64::consts::PI))]).unwrap());
        assert_eq!(alone, Destination { frame: PlaceFrame::Walk, places: expected });
        let through = format!(r#"{{"t":2,"goto":[{{"x_m":3,"y_m":-2}},{goal}],"relative":true,"speed":1.1}}"#);
        let list = [waypoint(None), waypoint(Some(std::f64::consts::PI))];
        let expected = Places::Waypoints(PlaceList::new(&list).unwrap());
        assert_eq!(destination_of(&through), Destination { frame: PlaceFrame::Robot, places: expected });
        let request = Reader::new("f").read(Ok(&through)).unwrap().unwrap().request;
        assert_eq!(request.gait, GaitChange { speed: Some(1.1), ..GaitChange::NONE });

        let step = r#"{"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}"#;
        let sole = WalkPose { x: 0.2, y: 0.1, heading: 0.0 };
        let expected = Places::Footsteps(PlaceList::new(&[Footstep { side: Side::Left, sole }]).unwrap());
        let steps = destination_of(&format!(r#"{{"footsteps":[{step}],"relative":false,"intent":"walk"}}"#));
        assert_eq!(steps, Destination { frame: PlaceFrame::Walk, places: expected });
    }

    #[test]
    fn a_wrong_destination_is_named_with_its_place_and_goes_with_a_speed_only() {
        let place = r#"{"x_m":1,"y_m":0}"#;
        let told = problem(&format!(r#"{{"goto":[{place},{{"x_m":1,"z_m":2}}]}}"#));
        assert!(told.starts_with("f:1: place 2: unknown field `z_m`, expected one of `x_m`, `y_m`"), "{told}");
        assert!(told.contains(r#"(column 41); write e.g. {"t":1.5,"goto":{"#), "{told}");
        let told = problem(r#"{"goto":{"x_m":1}}"#);
        assert!(told.starts_with("f:1: place 1: missing field `y_m` (column 1"), "{told}");
        let told = problem(&format!(r#"{{"goto":[{}]}}"#, vec![place; 25].join(",")));
        assert!(told.starts_with("f:1: place 25: at most 24 can be given at a time (column "), "{told}");
        assert!(problem(r#"{"goto":3}"#).starts_with("f:1: invalid type: integer `3`, expected a way-point such as {"));
        let told = problem(r#"{"footsteps":[{"side":"up"}]}"#);
        assert!(told.starts_with("f:1: place 1: unknown variant `up`") && told.contains(FOOTSTEPS_EXAMPLE), "{told}");
        for other in [r#""turn_deg":5"#, r#""sidestep_deg":5"#, r#""extension_deg":5"#, r#""vx":0"#, r#""wz_deg_s":1"#]
        {
            let told = problem(&format!(r#"{{"goto":{place},{other}}}"#));
            assert!(told.starts_with("f:1: of the gait parameters only a speed goes with a destination"), "{told}");
        }
        let told = problem(&format!(r#"{{"goto":{place},"intent":"stop"}}"#));
        assert!(told.starts_with("f:1: a destination goes with no intent but \"walk\""), "{told}");
        assert!(problem(r#"{"speed":1,"relative":true}"#).starts_with("f:1: relative without goto or footsteps"));
        let step = r#"{"side":"left","x_m":0.2,"y_m":0.1,"heading_deg":0}"#;
        let both = problem(&format!(r#"{{"goto":{place},"footsteps":[{step}]}}"#));
        assert!(both.starts_with("f:1: goto and footsteps in one line"), "{both}");
    }

    #[test]
    fn bytes_that_are_no_text_are_refused_with_their_line() {
        let script = b"\xef\xbb\xbf{\"t\":1,\"speed\":1}\r\n\r\n{\"speed\":\"\xff\"}\n\0\n{\"speed\":1}\n";
        let errors = Reader::read_all("f", &script[..]).unwrap_err();
        let texts: Vec<String> = errors.iter().map(ScriptError::to_string).collect();
        assert!(texts[0].starts_with("f:3: not UTF-8 (byte 11 of the line); write e.g. {"), "{texts:?}");
        assert!(texts[1].starts_with("f:4: not a JSON object"), "{texts:?}");
        assert_eq!(texts.len(), 2, "{texts:?}");
    }

    #[test]
    fn a_script_of_nothing_but_wrong_lines_is_read_no_further_than_a_hundred() {
        let errors = Reader::read_all("f", "[[push]]\n\n".repeat(100_000).as_bytes()).unwrap_err();
        assert_eq!(errors.len(), ERRORS_MAX + 1);
        let last = errors.last().map(ToString::to_string);
        assert_eq!(last.as_deref(), Some("f:199: the 100th wrong line; what follows is not read"));
    }

    #[test]
    fn script_times_must_not_decrease_and_errors_have_line_numbers() {
        let script = "{\"t\":2,\"speed\":1}\n\n{\"t\":1,\"speed\":1}\nnonsense\n{\"speed\":1}\n";
        let errors = Reader::read_all("f", script.as_bytes()).unwrap_err();
        assert_eq!(errors.iter().map(|error| error.line).collect::<Vec<_>>(), [3, 4]);
        assert_eq!(errors[0].to_string(), "f:3: t = 1: must not be less than 2, the time of an earlier line");
    }
}
