//! `halfstep stream`: requests line by line while the robot walks, each with its reply.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use dialogue::line_queue::{CAPACITY, LineQueue, ReadLine, Superseded};
use dialogue::lines::{BadLine, InputLines};
use dialogue::reply_text::{ReplyJson, reply_text};
use dialogue::script::{Reader, ScriptError};
use interface::{Intent, Request, Source, Verdict};
use node::interrupt::Interrupt;
use node::tell::tell;
use operator::command_stream::{CommandStream, SentRequest};
use runtime::now_ns;
use serde::Serialize;

use super::connect::patiently;
use super::options::{InstanceOption, command_timeout};
use crate::error::CliError;
use crate::messages::complain;
use crate::output::{print_json, print_line};
use crate::status::Status;

/// Send JSON-lines commands from a file or stdin to a running controller and print each reply
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = "Each line is a JSON object such as {\"t\":1.5,\"turn_deg\":10,\"speed\":1.2,\
\"extension_deg\":0,\"intent\":\"stop\"}. t is the controller's time since the stream began, in seconds; without t the \
line is sent at once. All other keys are optional; {\"vx\":0.3,\"vy\":-0.1,\"wz_deg_s\":15} is a velocity in m/s and \
degrees per second instead, {\"goto\":{\"x_m\":3,\"y_m\":2,\"heading_deg\":90}} a goal (or an array of way-points to \
it), {\"footsteps\":[{\"side\":\"left\",\"x_m\":0.2,\"y_m\":0.1,\"heading_deg\":0}]} footsteps; with \
\"relative\":true these are seen from the robot. A wrong line is reported with its number, and the stream \
continues.\n\n\
Lines without t that arrive faster than they are answered are passed over for a newer one that sets the same keys: \
the newest position of a stick counts. A stop overtakes everything, and takes the place of all lines before it that \
were not sent, also of those that wait for their t.\n\n\
While the stream is open, also between two lines, it has control authority: sources of lower priority are refused. If \
it is killed or interrupted, the robot stops after the command timeout. At the end of the input it releases control: \
what it requested stays in force until another request changes it, unless --stop-at-end is given.")]
pub(super) struct StreamArgs {
    #[command(flatten)]
    instance: InstanceOption,
    /// File with one JSON object per line; - is stdin
    #[arg(value_name = "FILE", default_value = "-")]
    file: String,
    /// Command timeout: the robot stops when the stream sends nothing for this long, e.g. 500ms, and a line without t
    /// that could not be sent for this long is not sent at all [default: the controller's own, config/controller.toml;
    /// none in lockstep]
    #[arg(long, value_name = "DURATION", value_parser = command_timeout, allow_hyphen_values = true)]
    age_limit: Option<Duration>,
    /// Stop the walk at the end of the input: for a pipe from a program, which may end because it crashed
    #[arg(long)]
    stop_at_end: bool,
}

const POLL_INTERVAL: Duration = Duration::from_millis(1);
/// Polls between two checks that the controller is still there, which cost more.
const POLLS_PER_CHECK: u32 = 100;
/// Lines that may wait between the thread that reads them and the one that sends them.
const READ_AHEAD: usize = 256;
/// Most timed lines that are sent and have no reply: a few, so that a dense script is not late.
const TIMED_UNANSWERED: usize = 16;

/// What became of a line, as JSON.
#[derive(Serialize)]
struct LineReply {
    line: u64,
    /// From reading the line to its reply (s).
    lag_s: f64,
    #[serde(flatten)]
    reply: ReplyJson,
}

/// A line that was not sent, as JSON.
#[derive(Serialize)]
struct LineNotSent {
    line: u64,
    verdict: &'static str,
    reason: String,
    /// The newer line that took its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    superseded_by: Option<u64>,
}

/// A line's error as JSON.
#[derive(Serialize)]
struct LineError {
    line: u64,
    error: String,
}

/// What a thread reads: the next line, or why the input cannot be read.
type ReadResult = io::Result<Result<String, BadLine>>;

/// A stream at work.
struct Streaming {
    json: bool,
    stream: CommandStream,
    reader: Reader,
    queue: LineQueue,
    sent: Vec<Sent>,
    age_limit: Option<Duration>,
    all_granted: bool,
    /// Why the first line of the output could not be printed: the stream goes on all the same.
    unprinted: Option<CliError>,
    lags: Lags,
}

/// A line that was sent and has no reply yet.
struct Sent {
    line: ReadLine,
    request: Request,
    pending: SentRequest,
}

/// How far the stream was behind its input.
#[derive(Default)]
struct Lags {
    passed_over: u64,
    longest_ns: u64,
}

impl StreamArgs {
    pub(super) fn run(self, json: bool) -> Result<Status, CliError> {
        let interrupt = Interrupt::listen()?;
        let (name, source): (&str, Box<dyn Read + Send>) = match self.file.as_str() {
            "-" => ("stdin", Box::new(io::stdin())),
            file => {
                (file, Box::new(File::open(file).map_err(|error| CliError::bad_input(format!("{file}: {error}")))?))
            }
        };
        let instance = self.instance.instance()?;
        let stream = patiently(&instance, || CommandStream::connect(&instance, self.age_limit))?;
        let mut streaming = Streaming::new(json, stream, Reader::new(name), self.age_limit);
        streaming.work_off(&read_lines(source)?, &interrupt, name)?;

        let Streaming { mut stream, all_granted, unprinted, lags, .. } = streaming;
        // An interrupted stream is to lose its authority; its last commands must not stay in effect.
        if !interrupt.is_raised() {
            if self.stop_at_end {
                stream.request(&Request { intent: Some(Intent::Stop), ..Request::new(Source::Script) })?;
            }
            stream.close()?;
        }
        lags.tell();
        unprinted.map_or(Ok(Status::success_if(all_granted)), Err)
    }
}

impl Streaming {
    fn new(json: bool, stream: CommandStream, reader: Reader, age_limit: Option<Duration>) -> Self {
        Self {
            json,
            stream,
            reader,
            queue: LineQueue::default(),
            sent: Vec::new(),
            age_limit,
            all_granted: true,
            unprinted: None,
            lags: Lags::default(),
        }
    }

    /// Sends lines and prints replies until all lines are answered, or this process is asked to end.
    fn work_off(&mut self, lines: &Receiver<ReadResult>, interrupt: &Interrupt, name: &str) -> Result<(), CliError> {
        let cannot_read = |error| CliError::bad_input(format!("{name}: {error}"));
        let mut is_at_end = false;
        let mut polls = 0_u32;
        while !interrupt.is_raised() {
            self.stream.keep_alive()?;
            while !is_at_end && self.queue.len() < CAPACITY {
                match lines.try_recv() {
                    Ok(line) => self.take(line.map_err(cannot_read)?),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => is_at_end = true,
                }
            }
            self.send()?;
            self.print_replies()?;
            if is_at_end && self.queue.is_empty() && self.sent.is_empty() {
                break;
            }
            polls += 1;
            if polls.is_multiple_of(POLLS_PER_CHECK) && !self.stream.is_connected() {
                return Err(CliError::new("the controller has left; the rest of the stream was not sent"));
            }
            if is_at_end || self.queue.len() >= CAPACITY {
                std::thread::sleep(POLL_INTERVAL);
                continue;
            }
            match lines.recv_timeout(POLL_INTERVAL) {
                Ok(line) => self.take(line.map_err(cannot_read)?),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => is_at_end = true,
            }
        }
        Ok(())
    }

    /// Takes in a line, or reports what is wrong with it.
    fn take(&mut self, line: Result<String, BadLine>) {
        match self.reader.read(line.as_deref().map_err(|bad| *bad)) {
            None => {}
            Some(Err(error)) => {
                self.all_granted = false;
                self.print_error(&error);
            }
            Some(Ok(timed)) => {
                let line = ReadLine { number: self.reader.line(), timed, read_ns: now_ns() };
                for Superseded { line, by } in self.queue.push(line) {
                    self.lags.passed_over += 1;
                    self.print_not_sent(line.number, format!("superseded by line {by}"), Some(by));
                }
            }
        }
    }

    /// Sends the lines that are due.
    fn send(&mut self) -> Result<(), CliError> {
        loop {
            let is_waiting = self.sent.iter().any(|sent| sent.line.timed.time.is_none());
            let Some(line) = self.queue.next_for_at_once(is_waiting) else { break };
            let age = Duration::from_nanos(now_ns().saturating_sub(line.read_ns));
            let is_too_old = self.age_limit.is_some_and(|limit| age > limit);
            if is_too_old && !line.timed.request.is_stop() {
                self.all_granted = false;
                let reason =
                    format!("not sent: it has waited for {:.2} s, longer than the age limit", age.as_secs_f64());
                self.print_not_sent(line.number, reason, None);
            } else {
                self.send_line(line, 0)?;
            }
        }
        while self.sent.len() < TIMED_UNANSWERED
            && let Some(not_before) = self.queue.next_timed().and_then(|line| self.stream.due(&line.timed))
            && let Some(line) = self.queue.take_timed()
        {
            self.send_line(line, not_before)?;
        }
        Ok(())
    }

    fn send_line(&mut self, line: ReadLine, not_before: u64) -> Result<(), CliError> {
        let request = Request { not_before, ..line.timed.request };
        let pending = self.stream.send(&request)?;
        self.sent.push(Sent { line, request, pending });
        Ok(())
    }

    /// Prints the replies that have arrived.
    fn print_replies(&mut self) -> Result<(), CliError> {
        let mut at = 0;
        while at < self.sent.len() {
            let Some(reply) = self.stream.poll(&self.sent[at].pending)? else {
                at += 1;
                continue;
            };
            let Sent { line: ReadLine { number, read_ns, timed }, request, .. } = self.sent.remove(at);
            self.all_granted &= reply.verdict != Verdict::Refused;
            let lag_ns = now_ns().saturating_sub(read_ns);
            if timed.time.is_none() {
                self.lags.longest_ns = self.lags.longest_ns.max(lag_ns);
            }
            let printed = if self.json {
                let lag_s = Duration::from_nanos(lag_ns).as_secs_f64();
                print_json(&LineReply { line: number, lag_s, reply: (&reply).into() })
            } else {
                print_line(format_args!("{number}: {}", reply_text(&request, &reply)))
            };
            self.note_printed(printed);
        }
        Ok(())
    }

    fn print_not_sent(&mut self, line: u64, reason: String, superseded_by: Option<u64>) {
        let printed = if self.json {
            print_json(&LineNotSent { line, verdict: Verdict::Refused.text(), reason, superseded_by })
        } else {
            print_line(format_args!("{line}: {reason}"))
        };
        self.note_printed(printed);
    }

    fn print_error(&mut self, error: &ScriptError) {
        if self.json {
            self.note_printed(print_json(&LineError { line: error.line, error: error.to_string() }));
        } else {
            complain(error);
        }
    }

    fn note_printed(&mut self, printed: Result<(), CliError>) {
        if let Err(error) = printed {
            self.unprinted.get_or_insert(error);
        }
    }
}

impl Lags {
    /// Tells how far the stream was behind, if lines were passed over.
    fn tell(&self) {
        if self.passed_over > 0 {
            let longest = Duration::from_nanos(self.longest_ns).as_secs_f64();
            let Self { passed_over, .. } = self;
            tell(format_args!(
                "{passed_over} lines were passed over for newer ones; the longest time from reading a line to its \
                 reply was {longest:.2} s"
            ));
        }
    }
}

/// Reads lines in a thread of its own: a blocking read cannot be cancelled.
fn read_lines(source: Box<dyn Read + Send>) -> Result<Receiver<ReadResult>, CliError> {
    let (sender, lines) = mpsc::sync_channel(READ_AHEAD);
    let read = move || {
        for line in InputLines::new(BufReader::new(source)) {
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
