//! `halfstep stream`: requests line by line while the robot walks, each with its reply.

use interface::{Intent, Request, Source, Verdict};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use node::interrupt::Interrupt;
use operator::command_stream::CommandStream;
use operator::reply_text::{ReplyJson, reply_text};
use operator::script::{Reader, ScriptError, TimedRequest};
use serde::Serialize;

use super::options::{InstanceOption, command_timeout};
use crate::error::CliError;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// Send JSON-lines commands from a file or stdin to a running controller and print each reply
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "Each line is a JSON object such as {\"t\":1.5,\"turn_deg\":10,\"speed\":1.2,\
\"extension_deg\":0,\"intent\":\"stop\"}. t is the controller's time since the stream began, in seconds; without t the \
line is sent at once. All other keys are optional. A wrong line is reported with its number, and the stream \
continues.\n\n\
While the stream is open, also between two lines, it has control authority: sources of lower priority are refused. If \
it is killed or interrupted, the robot stops after the command timeout. At the end of the input it releases control: \
what it requested stays in force until another request changes it, unless --stop-at-end is given.")]
pub(super) struct StreamArgs {
    #[command(flatten)]
    instance: InstanceOption,
    /// File with one JSON object per line; - is stdin
    #[arg(value_name = "FILE", default_value = "-")]
    file: String,
    /// Command timeout: the robot stops when the stream sends nothing for this long, e.g. 500ms [default: the
    /// controller's own, config/controller.toml; none in lockstep]
    #[arg(long, value_name = "DURATION", value_parser = command_timeout)]
    age_limit: Option<Duration>,
    /// Stop the walk at the end of the input: for a pipe from a program, which may end because it crashed
    #[arg(long)]
    stop_at_end: bool,
}

const POLL_INTERVAL: Duration = Duration::from_millis(1);
/// Polls between two checks that the controller is still there, which cost more.
const POLLS_PER_CHECK: u32 = 100;

/// A line's reply as JSON.
#[derive(Serialize)]
struct LineReply {
    line: u64,
    #[serde(flatten)]
    reply: ReplyJson,
}

/// A line's error as JSON.
#[derive(Serialize)]
struct LineError {
    line: u64,
    error: String,
}

impl StreamArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let interrupt = Interrupt::listen()?;
        let (name, source): (&str, Box<dyn Read + Send>) = match self.file.as_str() {
            "-" => ("stdin", Box::new(std::io::stdin())),
            file => {
                (file, Box::new(File::open(file).map_err(|error| CliError::bad_input(format!("{file}: {error}")))?))
            }
        };
        let mut stream = CommandStream::connect(&self.instance.instance()?, self.age_limit)?;
        let lines = lines(source)?;

        let mut reader = Reader::new(name);
        let mut all_granted = true;
        while let Some(line) = next_line(&lines, &mut stream, &interrupt)? {
            let timed = match reader.read(&line.map_err(|error| CliError::new(format!("{name}: {error}")))?) {
                None => continue,
                Some(Ok(timed)) => timed,
                Some(Err(error)) => {
                    all_granted = false;
                    print_error(json, &error)?;
                    continue;
                }
            };
            let Some(not_before) = wait_for(&timed, &mut stream, &interrupt)? else { break };
            let request = Request { not_before, ..timed.request };
            let reply = stream.request(&request)?;
            all_granted &= reply.verdict != Verdict::Refused;
            let line = reader.line();
            if json {
                print_json(&LineReply { line, reply: (&reply).into() })?;
            } else {
                print_line(format_args!("{line}: {}", reply_text(&request, &reply)))?;
            }
        }
        // An interrupted stream is to lose its authority; its last commands must not stay in effect.
        if !interrupt.is_raised() {
            if self.stop_at_end {
                stream.request(&Request { intent: Some(Intent::Stop), ..Request::new(Source::Script) })?;
            }
            stream.close()?;
        }
        Ok(Status::success_if(all_granted))
    }
}

fn print_error(json: bool, error: &ScriptError) -> Result<(), CliError> {
    if json {
        print_json(&LineError { line: error.line, error: error.to_string() })
    } else {
        eprintln!("{error}");
        Ok(())
    }
}

/// Reads lines in a thread of its own: a blocking read cannot be cancelled.
fn lines(source: Box<dyn Read + Send>) -> Result<Receiver<std::io::Result<String>>, CliError> {
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
        .map_err(|error| CliError::new(format!("cannot start a thread: {error}")))?;
    Ok(lines)
}

/// The next line; `None` at the end, or when this process was asked to end.
fn next_line(
    lines: &Receiver<std::io::Result<String>>,
    stream: &mut CommandStream,
    interrupt: &Interrupt,
) -> Result<Option<std::io::Result<String>>, CliError> {
    while !interrupt.is_raised() {
        match lines.recv_timeout(POLL_INTERVAL) {
            Ok(line) => return Ok(Some(line)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => stream.keep_alive()?,
        }
    }
    Ok(None)
}

/// Waits until a request is to be sent, and returns its tick; `None` when this process was asked to end.
fn wait_for(timed: &TimedRequest, stream: &mut CommandStream, interrupt: &Interrupt) -> Result<Option<u64>, CliError> {
    let mut polls = 0_u32;
    while !interrupt.is_raised() {
        stream.keep_alive()?;
        if let Some(due) = stream.due(timed) {
            return Ok(Some(due));
        }
        polls += 1;
        if polls.is_multiple_of(POLLS_PER_CHECK) && !stream.is_connected() {
            return Err(CliError::new("the controller has left; the rest of the stream was not sent"));
        }
        std::thread::sleep(POLL_INTERVAL);
    }
    Ok(None)
}
