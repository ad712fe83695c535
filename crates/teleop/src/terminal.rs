//! The terminal: in raw mode while a person drives, and left as it was found, also after a panic.

use std::io::{self, IsTerminal, Write, stdin, stdout};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;
use ratatui::crossterm::event::{
    DisableFocusChange, EnableFocusChange, Event, KeyboardEnhancementFlags, PopKeyboardEnhancementFlags,
    PushKeyboardEnhancementFlags,
};
use ratatui::crossterm::terminal::{
    EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode, supports_keyboard_enhancement,
};
use ratatui::crossterm::{cursor, execute};

use crate::TeleopError;
use crate::hangup::{end_after_terminal, next_event};
use crate::screen::Screen;

/// Makes sure that there is a terminal to read keys from and to draw on.
///
/// # Errors
/// Input or output is none.
pub fn require_terminal() -> Result<(), TeleopError> {
    match [("stdin", stdin().is_terminal()), ("stdout", stdout().is_terminal())].iter().find(|(_, is)| !is) {
        Some((name, _)) => Err(TeleopError::NoTerminal(name)),
        None => Ok(()),
    }
}

/// What the terminal must be brought back from; the panic hook needs to know it, too.
static IS_RAW: AtomicBool = AtomicBool::new(false);
static TELLS_RELEASE: AtomicBool = AtomicBool::new(false);

/// The terminal of this process, which shows a screen and gives keys. Dropping it brings it back.
pub(crate) struct KeyTerminal {
    terminal: Terminal<CrosstermBackend<io::Stdout>>,
    tells_release: bool,
}

impl KeyTerminal {
    /// Takes the terminal over.
    ///
    /// # Errors
    /// Input or output is no terminal, or it cannot be used.
    pub(crate) fn open() -> Result<Self, TeleopError> {
        require_terminal()?;
        restore_after_panic();
        end_after_terminal()?;
        enable_raw_mode()?;
        IS_RAW.store(true, Ordering::Relaxed);
        // A terminal that does not answer has no such protocol.
        let tells_release = supports_keyboard_enhancement().unwrap_or(false);
        let opened = Self::open_screen(tells_release);
        if opened.is_err() {
            restore();
        }
        opened
    }

    fn open_screen(tells_release: bool) -> Result<Self, TeleopError> {
        execute!(stdout(), EnterAlternateScreen, EnableFocusChange)?;
        if tells_release {
            let flags = KeyboardEnhancementFlags::DISAMBIGUATE_ESCAPE_CODES
                | KeyboardEnhancementFlags::REPORT_EVENT_TYPES
                | KeyboardEnhancementFlags::REPORT_ALL_KEYS_AS_ESCAPE_CODES;
            execute!(stdout(), PushKeyboardEnhancementFlags(flags))?;
            TELLS_RELEASE.store(true, Ordering::Relaxed);
        }
        Ok(Self { terminal: Terminal::new(CrosstermBackend::new(stdout()))?, tells_release })
    }

    /// Whether it tells when a key is let go.
    pub(crate) fn tells_release(&self) -> bool {
        self.tells_release
    }

    /// The next event, waited for at most so long.
    ///
    /// # Errors
    /// The terminal is gone, or cannot be read.
    pub(crate) fn next_event(&self, patience: Duration) -> Result<Option<Event>, TeleopError> {
        next_event(patience)
    }

    /// Whether the terminal answers: one at the other end of a connection that hangs does not. Waits for two seconds at
    /// most.
    pub(crate) fn answers(&self) -> bool {
        cursor::position().is_ok()
    }

    /// Shows a screen.
    pub(crate) fn show(&mut self, screen: &Screen) -> Result<(), TeleopError> {
        self.terminal.draw(|frame| screen.draw(frame))?;
        Ok(())
    }
}

impl Drop for KeyTerminal {
    fn drop(&mut self) {
        restore();
    }
}

/// Brings the terminal back, as far as that is possible: it may be gone.
fn restore() {
    if !IS_RAW.swap(false, Ordering::Relaxed) {
        return;
    }
    if TELLS_RELEASE.swap(false, Ordering::Relaxed) {
        let _ = execute!(stdout(), PopKeyboardEnhancementFlags);
    }
    let _ = execute!(stdout(), DisableFocusChange, LeaveAlternateScreen, cursor::Show);
    let _ = disable_raw_mode();
    let _ = stdout().flush();
}

/// Brings the terminal back before a panic is told.
fn restore_after_panic() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let tell = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            restore();
            tell(panic);
        }));
    });
}
