//! The progress of a walk, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use interface::{DestinationProgress, Rate, Report};
use node::tell::tell;

/// How far it is to a destination: `goal in 1.2 m, 3 places left`.
pub(crate) fn goal_text(progress: &DestinationProgress) -> String {
    let DestinationProgress { places_left, distance, .. } = *progress;
    match places_left {
        0 => "at the goal".to_owned(),
        1 => format!("goal in {distance:.1} m, 1 place left"),
        _ => format!("goal in {distance:.1} m, {places_left} places left"),
    }
}

/// A line on the terminal that shows the state of the walk; nothing if stderr is no terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    rate: Rate,
}

impl Progress {
    /// The progress of a walk that takes so many ticks, or has no end.
    pub(crate) fn new(ticks: Option<u64>, rate: Rate) -> Self {
        let (bar, template) = match ticks {
            Some(ticks) => (ProgressBar::new(ticks), "{bar:20} {msg}"),
            None => (ProgressBar::no_length(), "{spinner} {msg}"),
        };
        // The templates are constants and valid.
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        Self { bar: bar.with_style(style), rate }
    }

    /// Shows where the walk is.
    pub(crate) fn show(&self, tick: u64, report: &Report) {
        let margin = report.margin.map_or("   –".to_owned(), |margin| format!("{:4.0}", margin * 1e3));
        let goal = report.destination.map_or(String::new(), |progress| format!("  {}", goal_text(&progress)));
        self.bar.set_position(tick + 1);
        self.bar.set_message(format!(
            "{:6.1} s  half-step {:3}  speed {:.2}  turn {:+5.1}°  extension {:+5.1}°  sidestep {:+5.1}°  \
             margin {margin} mm  {}{goal}",
            (tick + 1) as f64 * self.rate.period_s(),
            report.half_step.index,
            report.speed,
            report.turn.to_degrees(),
            report.extension.to_degrees(),
            report.sidestep.to_degrees(),
            report.mode,
        ));
    }

    /// Prints a message above the line.
    pub(crate) fn print(&self, text: &str) {
        self.bar.suspend(|| tell(text));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
