//! The progress of work that takes seconds or minutes: a bar on a terminal, a line for each part elsewhere.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use node::tell::{is_quiet, tell};

/// How often the time on a terminal is drawn anew.
const DRAW_INTERVAL: Duration = Duration::from_millis(250);

/// The progress of work in several parts. Dropping it removes it from the terminal.
pub(crate) struct WorkProgress {
    bar: ProgressBar,
    what: String,
}

impl WorkProgress {
    /// Work begins that has so many parts.
    pub(crate) fn new(what: impl Into<String>, parts: u64) -> Self {
        let (bar, what) = (if is_quiet() { ProgressBar::hidden() } else { ProgressBar::new(parts) }, what.into());
        // The template is a constant and valid.
        let style = ProgressStyle::with_template("{bar:20} {pos} of {len} {wide_msg} {elapsed}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = bar.with_style(style).with_message(what.clone());
        if bar.is_hidden() {
            tell(format_args!("{what}: begins, {parts} parts"));
        } else {
            bar.enable_steady_tick(DRAW_INTERVAL);
        }
        Self { bar, what }
    }

    /// A part is done.
    pub(crate) fn part_done(&self) {
        self.bar.inc(1);
        if self.bar.is_hidden() {
            tell(format_args!("{}: {} of {}", self.what, self.bar.position(), self.bar.length().unwrap_or(0)));
        }
    }
}

impl Drop for WorkProgress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
