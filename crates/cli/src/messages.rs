//! Where messages to people go: to stderr, as plain lines; with `--quiet` nowhere. Nobody may read them: the pipe is
//! closed, the disk full. A message that cannot be written is lost, and nothing else happens; `eprintln!` would panic.

use std::fmt::{self, Debug, Display, Write as _};
use std::io::Write as _;

use node::tell::TARGET;
use tracing::field::{Field, Visit};
use tracing::{Event, Level, Subscriber};
use tracing_subscriber::EnvFilter;
use tracing_subscriber::fmt::FmtContext;
use tracing_subscriber::fmt::format::{Format, FormatEvent, FormatFields, Writer};
use tracing_subscriber::registry::LookupSpan;

/// Messages to people as they are, and all others as `tracing` formats them.
struct PlainMessages;

/// The message of an event.
struct MessageText(String);

/// Begins to write messages: those to people unless `quiet`, and others as `RUST_LOG` has it.
pub(crate) fn begin(quiet: bool) {
    let filter = if quiet {
        EnvFilter::new("error")
    } else {
        let others = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("warn"));
        let to_people = format!("{TARGET}={}", Level::INFO);
        match to_people.parse() {
            Ok(to_people) => others.add_directive(to_people),
            Err(_) => others,
        }
    };
    // Its own way to report that stderr cannot be written is to write to stderr, which panics.
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_env_filter(filter)
        .log_internal_errors(false)
        .event_format(PlainMessages)
        .init();
}

/// Writes why a command has failed to stderr, also when all else is quiet, or loses it.
pub(crate) fn complain(text: impl Display) {
    // In one piece, so that lines of several processes do not mix.
    let line = format!("{text}\n");
    let _ = std::io::stderr().lock().write_all(line.as_bytes());
}

impl<S, N> FormatEvent<S, N> for PlainMessages
where
    S: Subscriber + for<'a> LookupSpan<'a>,
    N: for<'a> FormatFields<'a> + 'static,
{
    fn format_event(&self, context: &FmtContext<'_, S, N>, mut writer: Writer<'_>, event: &Event<'_>) -> fmt::Result {
        if event.metadata().target() != TARGET {
            return Format::default().format_event(context, writer, event);
        }
        let mut message = MessageText(String::new());
        event.record(&mut message);
        writeln!(writer, "{}", message.0)
    }
}

impl Visit for MessageText {
    fn record_debug(&mut self, field: &Field, value: &dyn Debug) {
        if field.name() == "message" {
            // Writing to a string does not fail.
            let _ = write!(self.0, "{value:?}");
        }
    }
}
