//! Prints results and writes files of commands.

use std::fs;
use std::path::Path;

use serde::Serialize;

use crate::error::CliError;

/// Prints a value as JSON or as text.
pub(crate) fn print(json: bool, value: &(impl Serialize + std::fmt::Display)) -> Result<(), CliError> {
    if json { print_json(value) } else { print_line(value) }
}

/// Prints a value as JSON on one line.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string(value).map_err(CliError::new)?;
    print_line(text)
}

/// Prints a line and flushes it. A closed pipe is an error, which ends the command.
pub(crate) fn print_line(text: impl std::fmt::Display) -> Result<(), CliError> {
    use std::io::Write;
    let mut stdout = std::io::stdout().lock();
    writeln!(stdout, "{text}")
        .and_then(|()| stdout.flush())
        .map_err(|error| CliError::new(format!("cannot print: {error}")))
}

/// Tells the user something beside the result, on stderr. If that cannot be written, nobody reads it.
pub(crate) fn tell(text: impl std::fmt::Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Writes files, given by name and text, into a folder, which is created if necessary.
pub(crate) fn write_files(folder: &Path, files: &[(&str, String)]) -> Result<(), CliError> {
    fs::create_dir_all(folder).map_err(CliError::file(folder))?;
    for (name, text) in files {
        let file = folder.join(name);
        fs::write(&file, text).map_err(|error| {
            // On a full disk: half a file is worse than none.
            let _ = fs::remove_file(&file);
            CliError::file(&file)(error)
        })?;
    }
    Ok(())
}
