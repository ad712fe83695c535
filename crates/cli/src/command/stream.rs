//! `halfstep stream`: requests line by line while the robot walks, each with its reply.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use serde::Serialize;
use wire::{Intent, Request, Source, Verdict};

use super::{InstanceOption, duration, print_json, print_line};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::script::{Reader, ScriptError, Step};
use crate::voice::Voice;
use crate::words::{self, ReplyInJson};

/// Ask the running controller for what a file or pipe says, line by line, and print each reply
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "Each line is a JSON object such as {\"t\":1.5,\"turn_deg\":10,\"speed\":1.2,\
\"extension_deg\":0,\"intent\":\"stop\"}: t in seconds of the controller's time since the stream began, or absent for at \
once; the others as needed. A line that is wrong is reported with its number, and the stream goes on.\n\n\
While the stream is open it is in command, also between two lines: sources with less priority are refused. If it is \
killed or interrupted, the walk comes to a stand after the age limit. At the end of the input it takes its leave: what it \
asked lasts until another request changes it, unless --stop-at-end.")]
pub struct Stream {
    #[command(flatten)]
    instance: InstanceOption,
    /// File with one JSON object per line; - is stdin
    #[arg(value_name = "FILE", default_value = "-")]
    file: String,
    /// How long the walk goes on when nothing is heard of this stream any more, e.g. 500ms; the controller's own limit
    /// (config/controller.toml) if absent, which in lockstep is none
    #[arg(long, value_name = "DURATION", value_parser = duration)]
    age_limit: Option<Duration>,
    /// Stop the walk at the end of the input: for a pipe from a program, which may end because it crashed
    #[arg(long)]
    stop_at_end: bool,
}

const GLANCE: Duration = Duration::from_millis(1);
/// After how many glances it is looked whether the controller has left, which costs more.
const GLANCES_PER_LOOK: u32 = 100;

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
        let mut voice = Voice::connect(&self.instance.instance()?, self.age_limit)?;
        let lines = lines(source)?;

        let mut reader = Reader::new(name);
        let mut all_well = true;
        while let Some(line) = next_line(&lines, &mut voice, &interrupt)? {
            let step = match reader.read(&line.map_err(|error| Failure::new(format!("{name}: {error}")))?) {
                None => continue,
                Some(Ok(step)) => step,
                Some(Err(error)) => {
                    all_well = false;
                    print_error(json, &error)?;
                    continue;
                }
            };
            let Some(not_before) = wait_for(&step, &mut voice, &interrupt)? else { break };
            let request = Request { not_before, ..step.request };
            let reply = voice.ask(&request)?;
            all_well &= reply.verdict != Verdict::Refused;
            let line = reader.line();
            if json {
                print_json(&LineReply { line, reply: (&reply).into() })?;
            } else {
                print_line(format_args!("{line}: {}", words::reply(&request, &reply)))?;
            }
        }
        // Whoever interrupts a stream wants it out of command, not its last word to last.
        if !interrupt.is_raised() {
            if self.stop_at_end {
                voice.ask(&Request { intent: Some(Intent::Stop), ..Request::by(Source::Script) })?;
            }
            voice.take_leave()?;
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
    voice: &mut Voice,
    interrupt: &Interrupt,
) -> Result<Option<std::io::Result<String>>, Failure> {
    while !interrupt.is_raised() {
        match lines.recv_timeout(GLANCE) {
            Ok(line) => return Ok(Some(line)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => voice.keep_up()?,
        }
    }
    Ok(None)
}

/// Waits until a step is nearly due, and gives its tick; `None` when this process was asked to end.
fn wait_for(step: &Step, voice: &mut Voice, interrupt: &Interrupt) -> Result<Option<u64>, Failure> {
    let mut glances = 0_u32;
    while !interrupt.is_raised() {
        voice.keep_up()?;
        if let Some(due) = voice.due(step) {
            return Ok(Some(due));
        }
        glances += 1;
        if glances.is_multiple_of(GLANCES_PER_LOOK) && !voice.is_heard() {
            return Err(Failure::new("the controller has left; the rest of the stream was not sent"));
        }
        std::thread::sleep(GLANCE);
    }
    Ok(None)
}
