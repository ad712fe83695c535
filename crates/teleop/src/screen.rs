//! The one screen: what the robot does, what was asked of it, and the keys. It fits 80 columns and 24 lines.

use std::time::Duration;

use interface::{DestinationProgress, Mode, Report, Verdict, WalkPose, WalkVelocity};
use operator::hand_drive::DriveAnswer;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style, Stylize};
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::{Block, Paragraph, Wrap};

use crate::drive_pace::DrivePace;
use crate::held_keys::{HOLD, HeldKeys};
use crate::observed::Observed;
use crate::path_map::PathMap;

/// Least size of a terminal that has room for everything.
const WIDTH: u16 = 80;
const HEIGHT: u16 = 24;
/// Heights of the parts from the top: state, keys and reply, help.
const STATE: u16 = 10;
const ASKED: u16 = 6;
/// Width of the state; the map has the rest.
const STATE_WIDTH: u16 = 50;
/// After so long without a report the controller is called silent.
const SILENT_AFTER: Duration = Duration::from_secs(1);

/// What is drawn.
pub(crate) struct Screen<'a> {
    pub(crate) instance: &'a str,
    pub(crate) is_lockstep: bool,
    pub(crate) observed: &'a Observed,
    /// Time since the last report.
    pub(crate) silence: Duration,
    pub(crate) keys: &'a HeldKeys,
    pub(crate) pace: DrivePace,
    pub(crate) answer: Option<&'a DriveAnswer>,
    /// After which silence of the keys the controller stops the robot.
    pub(crate) age_limit: Duration,
}

impl Screen<'_> {
    /// Draws it.
    pub(crate) fn draw(&self, frame: &mut Frame) {
        let rows = [Constraint::Length(STATE), Constraint::Length(ASKED), Constraint::Min(0)];
        let [top, middle, bottom] = Layout::vertical(rows).areas(frame.area());
        let columns = [Constraint::Length(STATE_WIDTH), Constraint::Min(0)];
        let [state, map] = Layout::horizontal(columns).areas(top);
        let title = format!(" halfstep teleop · instance {} ", self.instance);
        frame.render_widget(Paragraph::new(self.state()).block(Block::bordered().title(title)), state);
        self.draw_map(frame, map);
        let asked = Paragraph::new(self.asked()).wrap(Wrap { trim: true });
        frame.render_widget(asked.block(Block::bordered().title(" asked ")), middle);
        let help = Paragraph::new(self.help()).block(Block::bordered().title(" keys "));
        frame.render_widget(help, bottom);
        let Rect { width, height, .. } = frame.area();
        if width < WIDTH || height < HEIGHT {
            let needed = format!(" {WIDTH} × {HEIGHT} characters show everything ");
            frame.render_widget(Line::from(needed).reversed(), frame.area());
        }
    }

    fn draw_map(&self, frame: &mut Frame, area: Rect) {
        let path: Vec<[f64; 2]> = self.observed.path().collect();
        let pose = self.observed.newest().map_or(WalkPose::default(), |(_, report)| report.odometry.pose);
        let map = PathMap { path: &path, pose };
        let inner = Block::bordered().inner(area);
        let block = Block::bordered().title(format!(" from above, {:.1} m wide ", map.width(inner)));
        frame.render_widget(block, area);
        frame.render_widget(&map, inner);
    }

    /// The robot's state, eight lines.
    fn state(&self) -> Text<'static> {
        let Some((time, report)) = self.observed.newest() else {
            return Text::from("the controller has not reported yet: it waits for its plant");
        };
        let Report { speed, turn, extension, sidestep, .. } = report;
        let clock = if self.is_lockstep { "lockstep" } else { "real time" };
        let time = format!("{time:.1} s, {clock}, {}", self.observed.rate());
        let mut lines = vec![
            named("mode", mode_span(report.mode), &format!(", half-step {}", report.half_step.index)),
            plain("time", &time),
            plain("pose", &pose_text(&report.odometry.pose)),
            plain("velocity", &velocity_text(&report.odometry.velocity)),
            plain(
                "gait",
                &format!(
                    "speed {speed:.2} turn {}° ext {}° side {}°",
                    whole_degrees(*turn),
                    whole_degrees(*extension),
                    whole_degrees(*sidestep)
                ),
            ),
            plain("margin", &self.margin(report)),
            plain("goal", &report.destination.map_or("–".to_owned(), goal)),
        ];
        let faults: Vec<&str> = self.observed.faults().map(|fault| fault.text()).collect();
        lines.push(if self.silence > SILENT_AFTER {
            let silence = format!("no report for {:.0} s", self.silence.as_secs_f64());
            named("", silence.red(), "")
        } else if faults.is_empty() {
            plain("faults", "none")
        } else {
            named("faults", faults.join("; ").red(), "")
        });
        Text::from(lines)
    }

    fn margin(&self, report: &Report) -> String {
        let millimetres =
            |margin: Option<f64>| margin.map_or("–".to_owned(), |margin| format!("{:.0} mm", margin * 1e3));
        let (now, least) = (millimetres(report.margin), millimetres(self.observed.least_margin()));
        format!("{now}, least of 2 s {least}; {} missed", self.observed.missed())
    }

    /// What is asked for, and the last answer.
    fn asked(&self) -> Text<'static> {
        let held: Vec<&str> = self.keys.held().map(|direction| direction.name()).collect();
        let held = if held.is_empty() { "–".to_owned() } else { held.join(", ") };
        let most = self.pace.velocity(&all_positive(), self.observed.com_height());
        let pace = format!("   pace {} %, up to {:.2} m/s ahead", self.pace.percent(), most.ahead);
        let mut lines = vec![named("held", held.bold(), &pace)];
        if let Some(DriveAnswer { verdict, text }) = self.answer {
            let style = match verdict {
                Verdict::Accepted => Style::new().fg(Color::Green),
                Verdict::Limited => Style::new().fg(Color::Yellow),
                Verdict::Refused => Style::new().fg(Color::Red),
            };
            lines.push(Line::from(Span::styled(text.clone(), style)));
        }
        Text::from(lines)
    }

    /// The keys, and how letting go is known.
    fn help(&self) -> Text<'static> {
        let limit = self.age_limit.as_secs_f64();
        let (letting_go, remedy) = if self.keys.tells_release() {
            let tells = "This terminal tells when a key is let go: the robot stops at once.";
            (tells.to_owned(), format!("If the terminal falls silent, it stops {limit:.1} s later."))
        } else {
            let tells = format!("This terminal does not tell when a key is let go: the robot stops {limit:.1} s");
            let hold = HOLD.as_secs_f64();
            (tells, format!("after the last repeat. It repeats one key; another one lasts for {hold:.1} s more."))
        };
        Text::from(vec![
            Line::from("hold   ↑ W ahead   ↓ S back   ← A turn left   → D turn right   Q , E . aside"),
            Line::from("press  + - pace   H hold in stride   R reset after a fault   Esc leave, stop"),
            Line::from("       SPACE stops".bold()),
            Line::from(letting_go.dim()),
            Line::from(remedy.dim()),
        ])
    }
}

/// Keys that ask for the most in each positive direction.
fn all_positive() -> HeldKeys {
    use crate::drive_key::MoveKey;
    let mut keys = HeldKeys::new(true);
    for direction in [MoveKey::Ahead, MoveKey::Left, MoveKey::TurnLeft] {
        keys.press(direction, Duration::ZERO);
    }
    keys
}

fn named(name: &'static str, value: Span<'static>, rest: &str) -> Line<'static> {
    Line::from(vec![format!("{name:<9}").dim(), value, Span::from(rest.to_owned())])
}

fn plain(name: &'static str, value: &str) -> Line<'static> {
    named(name, Span::from(value.to_owned()), "")
}

fn mode_span(mode: Mode) -> Span<'static> {
    let color = match mode {
        Mode::Walking | Mode::InPlace => Color::Green,
        Mode::Fallen | Mode::Faulted => Color::Red,
        Mode::Holding | Mode::Starting | Mode::Standing | Mode::Stopping => Color::Yellow,
    };
    Span::styled(mode.text(), Style::new().fg(color).bold())
}

/// A number with two digits, and no sign for zero.
fn hundredths(value: f64) -> String {
    format!("{:.2}", (value * 100.0).round() / 100.0 + 0.0)
}

fn degrees(angle: f64) -> String {
    format!("{:.1}°", (angle.to_degrees() * 10.0).round() / 10.0 + 0.0)
}

fn whole_degrees(angle: f64) -> f64 {
    angle.to_degrees().round() + 0.0
}

fn pose_text(pose: &WalkPose) -> String {
    format!("x {} m  y {} m  heading {}", hundredths(pose.x), hundredths(pose.y), degrees(pose.heading))
}

fn velocity_text(velocity: &WalkVelocity) -> String {
    let WalkVelocity { ahead, left, turn } = velocity;
    format!("ahead {}  left {} m/s  turn {}/s", hundredths(*ahead), hundredths(*left), degrees(*turn))
}

fn goal(progress: DestinationProgress) -> String {
    match progress.places_left {
        0 => "reached".to_owned(),
        left => format!("in {:.1} m, {left} to go", progress.distance),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use interface::Faults;
    use interface::Rate;
    use ratatui::Terminal;
    use ratatui::backend::TestBackend;

    use super::*;
    use crate::drive_key::MoveKey;
    use crate::observed::tests::report;

    /// The screen of a walk, as text.
    fn drawn(width: u16, height: u16) -> String {
        let mut observed = Observed::new(Rate::clamped(1000));
        (0..12_345).for_each(|tick| observed.take(&report(tick, 0.036, Faults::default())));
        let mut keys = HeldKeys::new(false);
        for direction in [MoveKey::Ahead, MoveKey::TurnLeft] {
            keys.press(direction, Duration::ZERO);
        }
        let text = "limited to vx 0.412 m/s, vy 0.000 m/s, wz 30.0 °/s (speed 1.00, steps of 0.250 m, 0.000 m aside), \
                    from half-step 36: joint 5 (right knee) would exceed its rate (6.31 rad/s, must be at most \
                    6.2 rad/s); predicted ZMP margin 20.1 mm";
        let answer = DriveAnswer { verdict: Verdict::Limited, text: text.to_owned() };
        let screen = Screen {
            instance: "default",
            is_lockstep: false,
            observed: &observed,
            silence: Duration::ZERO,
            keys: &keys,
            pace: DrivePace::default(),
            answer: Some(&answer),
            age_limit: HOLD,
        };
        let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a terminal in memory");
        terminal.draw(|frame| screen.draw(frame)).expect("room");
        terminal.backend().to_string()
    }

    #[test]
    fn the_screen_fits_eighty_columns() {
        expect![[r#"
            "┌ halfstep teleop · instance default ────────────┐┌ from above, 7.8 m wide ────┐"
            "│mode     walking, half-step 34                  ││             ⠘⡄             │"
            "│time     12.3 s, real time, 1000 Hz             ││              ⡇             │"
            "│pose     x 3.70 m  y -0.41 m  heading 11.5°     ││              ⡇             │"
            "│velocity ahead 0.30  left -0.01 m/s  turn 5.7°/s││              ⡇             │"
            "│gait     speed 1.00 turn 6° ext 0° side -1°     ││              ⡇             │"
            "│margin   36 mm, least of 2 s 36 mm; 3 missed    ││              ⡇             │"
            "│goal     –                                      ││              ⡇             │"
            "│faults   none                                   ││              ⠁             │"
            "└────────────────────────────────────────────────┘└────────────────────────────┘"
            "┌ asked ───────────────────────────────────────────────────────────────────────┐"
            "│held     ahead, turn left   pace 50 %, up to 0.50 m/s ahead                   │"
            "│limited to vx 0.412 m/s, vy 0.000 m/s, wz 30.0 °/s (speed 1.00, steps of 0.250│"
            "│m, 0.000 m aside), from half-step 36: joint 5 (right knee) would exceed its   │"
            "│rate (6.31 rad/s, must be at most 6.2 rad/s); predicted ZMP margin 20.1 mm    │"
            "└──────────────────────────────────────────────────────────────────────────────┘"
            "┌ keys ────────────────────────────────────────────────────────────────────────┐"
            "│hold   ↑ W ahead   ↓ S back   ← A turn left   → D turn right   Q , E . aside  │"
            "│press  + - pace   H hold in stride   R reset after a fault   Esc leave, stop  │"
            "│       SPACE stops                                                            │"
            "│This terminal does not tell when a key is let go: the robot stops 0.8 s       │"
            "│after the last repeat. It repeats one key; another one lasts for 0.8 s more.  │"
            "│                                                                              │"
            "└──────────────────────────────────────────────────────────────────────────────┘"
        "#]]
        .assert_eq(&drawn(WIDTH, HEIGHT));
    }

    #[test]
    fn a_terminal_of_any_size_is_drawn() {
        for (width, height) in [(1, 1), (10, 3), (79, 24), (80, 10), (200, 60)] {
            let is_small = width < WIDTH || height < HEIGHT;
            let told = drawn(width, height).contains("characters show everything");
            assert_eq!(told, is_small && width > 40, "{width} × {height}");
        }
    }
}
