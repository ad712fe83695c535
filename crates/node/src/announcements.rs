//! What a controller's process tells while it runs: its mode when that changes, what it grants to whom, and each
//! latched fault with what to do about it. Made from what the loop records, on the recorder's thread.

use std::collections::VecDeque;

use controller::Tick;
use interface::{Fault, LatchedFault, Lifetime, Mode, Reply, Request, Source};
use wire::{ReplyMessage, RequestMessage};

/// Which changes are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Announced {
    /// Every change of mode, every latched fault, and what is granted.
    All,
    /// Latched faults only: another process tells the rest.
    Faults,
}

/// A request and its reply in words.
pub type ReplyInWords = fn(&Request, &Reply) -> String;

/// Time within which further replies to a stream are only counted (s).
const STREAM_INTERVAL: f64 = 1.0;
/// Requests that are kept until they are answered.
const UNANSWERED_MAX: usize = 256;

/// Turns changes into lines.
#[derive(Clone, Debug)]
pub struct Announcements {
    announced: Announced,
    instance: String,
    in_words: ReplyInWords,
    mode: Option<Mode>,
    latched: Option<LatchedFault>,
    /// Requests without a reply, by their numbers.
    unanswered: VecDeque<(u32, Request)>,
    /// The stream whose reply was told last, when, and how many replies were not told since.
    stream: Option<(Source, f64, u32)>,
}

impl Announcements {
    /// Nothing was told yet, of a controller of this instance.
    pub fn new(announced: Announced, instance: &str, in_words: ReplyInWords) -> Self {
        let (instance, unanswered) = (instance.to_owned(), VecDeque::new());
        Self { announced, instance, in_words, mode: None, latched: None, unanswered, stream: None }
    }

    /// The lines to tell after a tick: none, unless something has changed.
    ///
    /// * `time` – time of the tick since the first one (s)
    pub fn after(&mut self, tick: &Tick, time: f64) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(latched) = tick.latched.filter(|&latched| self.latched != Some(latched)) {
            let (text, time, remedy) = (latched.text(), latched.time, self.remedy(latched.fault));
            lines.push(format!("controller: fault at {time:.2} s: {text}; {remedy}"));
        }
        self.latched = tick.latched;
        let mode = Some(tick.report.mode);
        if self.announced == Announced::All && self.mode != mode {
            lines.push(format!("controller: {} at {time:.2} s", tick.report.mode));
        }
        self.mode = mode;
        lines
    }

    /// What ends a fault.
    fn remedy(&self, fault: Fault) -> String {
        let reset = format!("`halfstep send --instance {} reset`", self.instance);
        match fault {
            Fault::Fallen => format!(
                "put the robot on its feet (a plant with --lift-when-fallen does so; start another one anew), then \
                 {reset}"
            ),
            _ => format!("when that is mended: {reset}"),
        }
    }

    /// Takes note of a request.
    pub fn asked(&mut self, number: u32, message: &RequestMessage) {
        // A heartbeat changes nothing; what is invalid is refused to its sender.
        if let Ok(request) = message.checked()
            && self.announced == Announced::All
            && !request.is_empty()
        {
            if self.unanswered.len() >= UNANSWERED_MAX {
                self.unanswered.pop_front();
            }
            self.unanswered.push_back((number, request));
        }
    }

    /// The line to tell after the reply to a request. Of a stream, which may send many a second, one a second.
    ///
    /// * `time` – time of the reply since the first tick (s)
    pub fn answered(&mut self, number: u32, message: &ReplyMessage, time: f64) -> Option<String> {
        let at = self.unanswered.iter().position(|(asked, _)| *asked == number)?;
        let (_, request) = self.unanswered.remove(at)?;
        let reply = message.checked().ok()?;
        let source = request.source;
        let mut more = String::new();
        if request.lifetime == Lifetime::Streamed && !request.is_stop() {
            if let Some((_, _, untold)) = self
                .stream
                .as_mut()
                .filter(|(last, told, _)| *last == source && (0.0..STREAM_INTERVAL).contains(&(time - told)))
            {
                *untold += 1;
                return None;
            }
            let untold = self.stream.filter(|(last, ..)| *last == source).map_or(0, |(.., untold)| untold);
            if untold > 0 {
                more = format!(" ({untold} more before)");
            }
            self.stream = Some((source, time, 0));
        }
        Some(format!("controller: {source} at {time:.2} s: {}{more}", (self.in_words)(&request, &reply)))
    }
}

#[cfg(test)]
mod tests {
    use interface::{Command, GaitChange, Reason, Report, Setpoint, SteadyWalk, Verdict};

    use super::*;

    fn tick(mode: Mode, latched: Option<LatchedFault>) -> Tick {
        let report = Report::of(mode);
        let (setpoint, command) = (Setpoint::default(), Command::NOMINAL);
        Tick { setpoint, report, rejection: None, command, reply: None, superseded: None, latched }
    }

    fn announcements(announced: Announced) -> Announcements {
        Announcements::new(announced, "a", |request, reply| format!("{} {:?}", reply.verdict, request.gait.turn))
    }

    #[test]
    fn a_fault_and_each_change_of_mode_are_told_once() {
        let fallen = Some(LatchedFault { fault: Fault::Fallen, time: 3.3, cause: None });
        let run = [(Mode::Walking, None), (Mode::Stopping, fallen), (Mode::Stopping, fallen), (Mode::Faulted, fallen)];
        let lines = |announced| {
            let mut announcements = announcements(announced);
            let after = |(number, &(mode, latched))| announcements.after(&tick(mode, latched), number as f64);
            run.iter().enumerate().flat_map(after).collect::<Vec<String>>()
        };
        let fault = "controller: fault at 3.30 s: the robot has fallen; put the robot on its feet (a plant with \
                     --lift-when-fallen does so; start another one anew), then `halfstep send --instance a reset`";
        let all = ["controller: walking at 0.00 s", fault, "controller: stopping at 1.00 s"];
        assert_eq!(lines(Announced::All)[..3], all);
        assert_eq!(lines(Announced::All)[3..], ["controller: faulted at 3.00 s"]);
        assert_eq!(lines(Announced::Faults), [fault]);
    }

    #[test]
    fn what_is_granted_is_told_and_of_a_stream_once_a_second() {
        let reply = Reply {
            id: 0,
            verdict: Verdict::Accepted,
            reason: Reason::None,
            effect_half_step: 1,
            granted: Command::NOMINAL,
            walk: SteadyWalk::ZERO,
            intent: None,
            active_limit: None,
            place: None,
            arrival: None,
            authority: None,
            predicted_margin: None,
            mode: None,
            latched: None,
        };
        let request = |source, lifetime, turn| Request {
            gait: GaitChange { turn, ..GaitChange::NONE },
            lifetime,
            ..Request::new(source)
        };
        let mut announcements = announcements(Announced::All);
        let mut told = |number: u32, request: Request, time| {
            announcements.asked(number, &(&request).into());
            announcements.answered(number, &(&reply).into(), time)
        };
        let console = request(Source::Console, Lifetime::Latched, Some(0.5));
        assert_eq!(told(1, console, 0.1).as_deref(), Some("controller: console at 0.10 s: accepted Some(0.5)"));
        assert_eq!(told(2, request(Source::Teleop, Lifetime::Streamed, None), 0.2), None, "a heartbeat");
        let stick = request(Source::Teleop, Lifetime::Streamed, Some(0.25));
        let line = "controller: teleop at 1.00 s: accepted Some(0.25)";
        assert_eq!(told(3, stick, 1.0).as_deref(), Some(line));
        assert_eq!([told(4, stick, 1.5), told(5, stick, 1.99)], [None, None]);
        assert_eq!(told(6, stick, 2.0), Some(line.replace("1.00 s", "2.00 s") + " (2 more before)"));
        let mut faults_only = Announcements::new(Announced::Faults, "a", |_, _| String::new());
        faults_only.asked(1, &(&console).into());
        assert_eq!(faults_only.answered(1, &(&reply).into(), 0.1), None);
    }
}
