//! Prints results of commands.

use std::io::{ErrorKind, Write};

use serde::Serialize;

use crate::error::CliError;
use crate::messages::complain;

/// Prints a value as JSON or as text.
pub(crate) fn print(json: bool, value: &(impl Serialize + std::fmt::Display)) -> Result<(), CliError> {
    if json { print_json(value) } else { print_line(value) }
}

/// Prints a value as JSON on one line.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string(value).map_err(CliError::new)?;
    print_line(text)
}

/// Prints a line and flushes it. If the reader has closed the pipe it has read enough: that is no error.
pub(crate) fn print_line(text: impl std::fmt::Display) -> Result<(), CliError> {
    let mut stdout = std::io::stdout().lock();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::new(format!("cannot print: {error}"))),
        _ => Ok(()),
    }
}

/// Reports an error: as text on stderr and, if the results are JSON, also as JSON on stdout.
pub(crate) fn print_error(json: bool, error: &CliError) {
    if json {
        // What cannot be printed here can be printed nowhere.
        let _ = print_json(error);
    }
    complain(error);
}

/// Quotes a word for the shell.
pub(crate) fn quoted(word: &str) -> String {
    let plain = |character: char| character.is_ascii_alphanumeric() || "/._-+=:,@".contains(character);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
