//! The progress of a walk, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use interface::{Rate, Report};
use node::tell::{is_quiet, tell};

use crate::state_line::{goal_text, state_line};

/// A line on the terminal that shows the state of the walk; nothing if stderr is no terminal or all are to be quiet.
pub(crate) struct Progress {
    bar: ProgressBar,
    rate: Rate,
}

impl Progress {
    /// The progress of a walk that takes so many ticks, or has no end.
    pub(crate) fn new(ticks: Option<u64>, rate: Rate) -> Self {
        let (bar, template) = match ticks {
            _ if is_quiet() => (ProgressBar::hidden(), ""),
            Some(ticks) => (ProgressBar::new(ticks), "{bar:8} {wide_msg}"),
            None => (ProgressBar::no_length(), "{spinner} {wide_msg}"),
        };
        // The templates are constants and valid.
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        Self { bar: bar.with_style(style), rate }
    }

    /// Shows where the walk is.
    pub(crate) fn show(&self, tick: u64, report: &Report) {
        let goal = report.destination.map_or(String::new(), |progress| format!("  {}", goal_text(&progress)));
        self.bar.set_position(tick + 1);
        let time = self.rate.time(tick + 1);
        self.bar.set_message(format!("{time:6.1} s {}{goal}", state_line(report, report.margin)));
    }

    /// Prints a message above the line.
    pub(crate) fn print(&self, text: &str) {
        self.bar.suspend(|| tell(text));
    }

    /// Does something that prints while the line is not there.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
