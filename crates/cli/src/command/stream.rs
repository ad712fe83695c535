//! `halfstep stream`: requests line by line while the robot walks, each with its reply.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use serde::Serialize;
use wire::{ObserverEnd, OperatorEnd, Request, Verdict};

use super::{InstanceOption, print_json, print_line};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::script::{Reader, ScriptError, Step};
use crate::words::{self, ReplyInJson};

/// Ask the running controller for what a file or pipe says, line by line, and print each reply
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "Each line is a JSON object such as {\"t\":1.5,\"turn_deg\":10,\"speed\":1.2,\
\"extension_deg\":0,\"intent\":\"stop\"}: t in seconds of the controller's time since the stream began, or absent for at \
once; the others as needed. A line that is wrong is reported with its number, and the stream goes on.")]
pub struct Stream {
    #[command(flatten)]
    instance: InstanceOption,
    /// File with one JSON object per line; - is stdin
    #[arg(value_name = "FILE", default_value = "-")]
    file: String,
}

/// How long the controller may take to answer: long enough to start its plant by hand.
const PATIENCE: Duration = Duration::from_secs(10);
const GLANCE: Duration = Duration::from_millis(1);
/// How often it is looked whether anybody asks this process to end, or the controller has left.
const HEARTBEAT: Duration = Duration::from_millis(100);
/// How early a request is sent that is not yet due [ticks]: late enough that ending the stream ends its influence.
const LEAD: u64 = 20;

/// A line's reply as JSON.
#[derive(Serialize)]
struct LineReply {
    line: u64,
    #[serde(flatten)]
    reply: ReplyInJson,
}

/// A line's error as JSON.
#[derive(Serialize)]
struct LineError {
    line: u64,
    error: String,
}

impl Stream {
    pub fn run(self, json: bool) -> Result<Outcome, Failure> {
        let interrupt = Interrupt::listen()?;
        let (name, source): (&str, Box<dyn Read + std::marker::Send>) = match self.file.as_str() {
            "-" => ("stdin", Box::new(std::io::stdin())),
            file => (file, Box::new(File::open(file).map_err(|error| Failure::bad_input(format!("{file}: {error}")))?)),
        };
        let instance = self.instance.instance()?;
        let operator = OperatorEnd::connect(&instance)?;
        let mut time = ControllerTime { observer: ObserverEnd::connect(&instance)?, began: None, now: 0 };
        let lines = lines(source)?;

        let mut reader = Reader::new(name);
        let mut all_well = true;
        while let Some(line) = next_line(&lines, &interrupt)? {
            let step = match reader.read(&line.map_err(|error| Failure::new(format!("{name}: {error}")))?) {
                None => continue,
                Some(Ok(step)) => step,
                Some(Err(error)) => {
                    all_well = false;
                    print_error(json, &error)?;
                    continue;
                }
            };
            let Some(not_before) = time.wait_for(&step, &operator, &interrupt)? else { break };
            let request = Request { not_before, ..step.request };
            let reply = operator.requests.ask(&(&request).into(), PATIENCE)?.checked().map_err(Failure::new)?;
            all_well &= reply.verdict != Verdict::Refused;
            let line = reader.line();
            if json {
                print_json(&LineReply { line, reply: (&reply).into() })?;
            } else {
                print_line(format_args!("{line}: {}", words::reply(&request, &reply)))?;
            }
        }
        Ok(Outcome::fine_if(all_well))
    }
}

fn print_error(json: bool, error: &ScriptError) -> Result<(), Failure> {
    if json {
        print_json(&LineError { line: error.line, error: error.to_string() })
    } else {
        eprintln!("{error}");
        Ok(())
    }
}

/// Lines as they come, read by a thread of its own: a read cannot be called off.
fn lines(source: Box<dyn Read + std::marker::Send>) -> Result<Receiver<std::io::Result<String>>, Failure> {
    let (sender, lines) = mpsc::sync_channel(1);
    let read = move || {
        for line in BufReader::new(source).lines() {
            let is_last = line.is_err();
            if sender.send(line).is_err() || is_last {
                return;
            }
        }
    };
    std::thread::Builder::new()
        .name("lines".to_owned())
        .spawn(read)
        .map_err(|error| Failure::new(format!("cannot start a thread: {error}")))?;
    Ok(lines)
}

/// The next line; `None` at the end, or when this process was asked to end.
fn next_line(
    lines: &Receiver<std::io::Result<String>>,
    interrupt: &Interrupt,
) -> Result<Option<std::io::Result<String>>, Failure> {
    while !interrupt.is_raised() {
        match lines.recv_timeout(HEARTBEAT) {
            Ok(line) => return Ok(Some(line)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
    Ok(None)
}

/// The controller's time, by its reports: it may go faster or slower than the clock on the wall.
struct ControllerTime {
    observer: ObserverEnd,
    /// The tick at which the stream began.
    began: Option<u64>,
    now: u64,
}

impl ControllerTime {
    /// Waits until a step is nearly due, and gives its tick; `None` when this process was asked to end.
    fn wait_for(&mut self, step: &Step, operator: &OperatorEnd, interrupt: &Interrupt) -> Result<Option<u64>, Failure> {
        let mut looks = 0_u32;
        while !interrupt.is_raised() {
            while let Some(report) = self.observer.reports.next_report()? {
                self.now = report.tick;
                self.began.get_or_insert(report.tick);
            }
            if step.time.is_none() {
                return Ok(Some(0));
            }
            if let Some(due) = self.began.map(|began| began + step.tick())
                && self.now + LEAD >= due
            {
                return Ok(Some(due));
            }
            looks += 1;
            if looks.is_multiple_of(HEARTBEAT.div_duration_f64(GLANCE) as u32)
                && !operator.requests.controller_is_there()
            {
                return Err(Failure::new("the controller has left; the rest of the stream was not sent"));
            }
            std::thread::sleep(GLANCE);
        }
        Ok(None)
    }
}
