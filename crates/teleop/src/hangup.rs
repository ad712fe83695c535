//! Notices that the terminal is gone: its window was closed, or the connection to it is lost.
//!
//! crossterm (0.29) reads from such a terminal for ever, without waiting. So nothing is read from one that has hung up,
//! and if that happens while crossterm reads, the process ends.

use std::io::stdin;
use std::time::Duration;

use ratatui::crossterm::event;
use ratatui::crossterm::event::Event;
use rustix::event::{PollFd, PollFlags, Timespec, poll};

use crate::TeleopError;

/// How long the session has to stop the robot once the terminal is gone.
const GRACE: Duration = Duration::from_secs(2);
/// Exit code of a process whose terminal has gone while it was read: that of a shell for one that SIGHUP has ended.
const HUNG_UP: i32 = 129;

/// Ends the process if it has not ended some seconds after its terminal.
///
/// # Errors
/// No thread can be started.
pub(crate) fn end_after_terminal() -> Result<(), TeleopError> {
    let watch = || {
        // Without flags it waits for a hang-up alone.
        while !is_gone(PollFlags::empty(), None) {}
        std::thread::sleep(GRACE);
        std::process::exit(HUNG_UP);
    };
    std::thread::Builder::new().name("terminal-watch".to_owned()).spawn(watch)?;
    Ok(())
}

/// The next event of the terminal, waited for at most so long.
///
/// # Errors
/// The terminal is gone, or cannot be read.
pub(crate) fn next_event(patience: Duration) -> Result<Option<Event>, TeleopError> {
    // A time that is too long for the system is waited for without an end.
    let timeout = Timespec::try_from(patience).ok();
    if is_gone(PollFlags::IN, timeout.as_ref()) {
        return Err(TeleopError::TerminalGone);
    }
    // Also without input: it may tell that the window has another size.
    if event::poll(Duration::ZERO)? { Ok(Some(event::read()?)) } else { Ok(None) }
}

/// Waits for flags of the terminal, or that it is gone; whether it is.
fn is_gone(flags: PollFlags, timeout: Option<&Timespec>) -> bool {
    let terminal = stdin();
    let mut polled = [PollFd::new(&terminal, flags)];
    // An interrupted wait has seen nothing.
    poll(&mut polled, timeout).is_ok()
        && polled[0].revents().intersects(PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL)
}
