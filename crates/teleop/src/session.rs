//! Driving a robot from a terminal, until the person leaves.

use std::fmt;
use std::time::Duration;

use interface::{Intent, Rate, Request, Source, Verdict};
use operator::hand_drive::{DriveAnswer, HandDrive};
use ratatui::crossterm::event::{Event, KeyEvent};
use runtime::now_ns;
use serde::Serialize;
use wire::{Instance, SpectatorPorts};

use crate::TeleopError;
use crate::drive_key::{DriveKey, MoveKey, is_release};
use crate::drive_pace::DrivePace;
use crate::held_keys::{HOLD, HeldKeys};
use crate::observed::Observed;
use crate::screen::Screen;
use crate::terminal::KeyTerminal;

/// Longest wait for a key: so often reports and replies are looked for.
const POLL: Duration = Duration::from_millis(5);
/// Time between two drawings of the screen.
const DRAW_INTERVAL: Duration = Duration::from_millis(50);
/// Time between two questions whether the terminal is still there, while keys are held whose release it tells.
const ASK_INTERVAL: Duration = Duration::from_millis(150);

/// How many times as fast as real time lockstep is about.
const LOCKSTEP_SPEED: u32 = 15;

/// What to drive, and how.
#[derive(Clone, Debug)]
pub struct Teleop {
    /// The robot.
    pub instance: Instance,
    /// After which silence the controller stops the robot, by its own time; `None` is about the time for which a key
    /// counts as held.
    pub age_limit: Option<Duration>,
}

/// What became of the requests of a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct TeleopSummary {
    /// Requests granted as they were.
    pub accepted: u64,
    /// Requests granted in part.
    pub limited: u64,
    /// Requests refused.
    pub refused: u64,
}

impl Teleop {
    /// Drives until the person leaves or `is_over`, and then stops the robot.
    ///
    /// # Errors
    /// There is no terminal or no controller, or one of them fails.
    pub fn run(&self, is_over: impl Fn() -> bool) -> Result<TeleopSummary, TeleopError> {
        let ports = SpectatorPorts::connect(&self.instance)?;
        let terminal = KeyTerminal::open()?;
        let mut session = TeleopSession::new(self, ports, terminal);
        let ended = session.go_on_until(is_over);
        // Whatever has ended it.
        session.leave();
        ended.map(|()| session.summary)
    }
}

/// A person at a terminal.
struct TeleopSession<'a> {
    teleop: &'a Teleop,
    terminal: KeyTerminal,
    ports: SpectatorPorts,
    observed: Observed,
    keys: HeldKeys,
    pace: DrivePace,
    age_limit: Duration,
    drive: HandDrive,
    answer: Option<DriveAnswer>,
    summary: TeleopSummary,
    began_ns: u64,
    heard: Duration,
    drawn: Option<Duration>,
    asked_terminal: Duration,
}

impl<'a> TeleopSession<'a> {
    fn new(teleop: &'a Teleop, ports: SpectatorPorts, terminal: KeyTerminal) -> Self {
        let usual = if ports.is_lockstep { LOCKSTEP_SPEED * HOLD } else { HOLD };
        let age_limit = teleop.age_limit.unwrap_or(usual);
        Self {
            observed: Observed::new(Rate::clamped(ports.reports.rate_hz())),
            keys: HeldKeys::new(terminal.tells_release()),
            pace: DrivePace::default(),
            age_limit,
            drive: HandDrive::new(teleop.instance.clone(), Some(age_limit)),
            answer: None,
            summary: TeleopSummary::default(),
            began_ns: now_ns(),
            heard: Duration::ZERO,
            drawn: None,
            asked_terminal: Duration::ZERO,
            teleop,
            terminal,
            ports,
        }
    }

    fn now(&self) -> Duration {
        Duration::from_nanos(now_ns().saturating_sub(self.began_ns))
    }

    fn go_on_until(&mut self, is_over: impl Fn() -> bool) -> Result<(), TeleopError> {
        while !is_over() && self.go_on()? {}
        Ok(())
    }

    /// Takes keys, reports and replies, and draws the screen. Whether the person stays.
    fn go_on(&mut self) -> Result<bool, TeleopError> {
        if let Some(event) = self.terminal.next_event(POLL)?
            && !self.take_event(&event)
        {
            return Ok(false);
        }
        self.keys.expire(self.now());
        self.show_life();
        let answer = self.drive.exchange();
        self.note(answer);
        while let Some(report) = self.ports.reports.next_report()? {
            self.observed.take(&report);
            self.heard = self.now();
        }
        self.draw()?;
        Ok(true)
    }

    /// Whether the person stays.
    fn take_event(&mut self, event: &Event) -> bool {
        match event {
            Event::Key(key) => return self.take_key(key),
            // Whoever types elsewhere holds no key here, and its release will not be told.
            Event::FocusLost if self.keys.held().next().is_some() => {
                self.keys.release_all();
                self.steer();
            }
            _ => {}
        }
        true
    }

    fn take_key(&mut self, event: &KeyEvent) -> bool {
        let Some(key) = DriveKey::of(event) else { return true };
        if is_release(event) {
            if let DriveKey::Move(direction) = key
                && self.keys.is_held(direction)
            {
                self.keys.release(direction);
                self.steer();
            }
            return true;
        }
        match key {
            DriveKey::Leave => return false,
            DriveKey::Move(direction) => self.hold(direction),
            DriveKey::Faster | DriveKey::Slower => {
                self.pace = if key == DriveKey::Faster { self.pace.faster() } else { self.pace.slower() };
                if self.keys.held().next().is_some() {
                    self.steer();
                }
            }
            DriveKey::Stop => self.stop(),
            DriveKey::Hold => self.ask_for(Intent::Hold),
            DriveKey::Reset => self.ask_for(Intent::Reset),
        }
        true
    }

    /// A key for a direction is pressed or repeats: this is a sign of life, too.
    fn hold(&mut self, direction: MoveKey) {
        let now = self.now();
        self.keys.expire(now);
        let is_new = !self.keys.is_held(direction);
        self.keys.press(direction, now);
        if is_new {
            self.steer();
        } else if !self.keys.tells_release() {
            let problem = self.drive.beat();
            self.note(problem);
        }
    }

    /// Asks for the velocity of the held keys; without any the robot stops.
    fn steer(&mut self) {
        let velocity = Some(self.pace.velocity(&self.keys, self.observed.com_height()));
        self.drive.ask(Request { velocity, ..Request::new(Source::Teleop) });
    }

    fn ask_for(&mut self, intent: Intent) {
        self.keys.release_all();
        self.drive.ask(Request { intent: Some(intent), ..Request::new(Source::Teleop) });
    }

    fn stop(&mut self) {
        self.keys.release_all();
        let answer = self.drive.stop();
        self.note(Some(answer));
    }

    /// Where the release of keys is told, a held key does not repeat for ever: the terminal is asked whether it is
    /// still there. Elsewhere each repeat is a sign of life.
    fn show_life(&mut self) {
        let now = self.now();
        let is_due = now.saturating_sub(self.asked_terminal) >= ASK_INTERVAL;
        if self.keys.tells_release() && is_due && self.keys.held().next().is_some() {
            self.asked_terminal = now;
            if self.terminal.answers() {
                let problem = self.drive.beat();
                self.note(problem);
            }
        }
    }

    fn note(&mut self, answer: Option<DriveAnswer>) {
        let Some(answer) = answer else { return };
        let Self { summary: TeleopSummary { accepted, limited, refused }, .. } = self;
        match answer.verdict {
            Verdict::Accepted => *accepted += 1,
            Verdict::Limited => *limited += 1,
            Verdict::Refused => *refused += 1,
        }
        self.answer = Some(answer);
    }

    fn draw(&mut self) -> Result<(), TeleopError> {
        let now = self.now();
        if self.drawn.is_some_and(|drawn| now.saturating_sub(drawn) < DRAW_INTERVAL) {
            return Ok(());
        }
        self.drawn = Some(now);
        let screen = Screen {
            instance: self.teleop.instance.name().as_str(),
            is_lockstep: self.ports.is_lockstep,
            observed: &self.observed,
            silence: now.saturating_sub(self.heard),
            keys: &self.keys,
            pace: self.pace,
            answer: self.answer.as_ref(),
            age_limit: self.age_limit,
        };
        self.terminal.show(&screen)
    }

    /// Stops the robot. If nobody answers, the stream has fallen silent all the same.
    fn leave(&mut self) {
        let answer = self.drive.stop();
        self.note(Some(answer));
    }
}

impl fmt::Display for TeleopSummary {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { accepted, limited, refused } = self;
        write!(out, "left, and stopped the robot; requests: {accepted} accepted, {limited} limited, {refused} refused")
    }
}
