//! A walk that a page has begun: it hears the page's messages and answers with those of `halfstep view`.

use std::collections::{BTreeMap, VecDeque};

use controller::{RequestAnswer, RequestId};
use dialogue::line_queue::{LineQueue, ReadLine};
use dialogue::push_text::push_text;
use dialogue::reply_text::reply_text;
use dialogue::script::Reader;
use interface::{Intent, PeriodTiming, PushOutcome, PushReply, PushRequest, Request, Source};
use lockstep::{LockstepOptions, LockstepWalk, WalkableRobot};
use model::Joint;
use plant::Disturbances;
use scene::{AskedPush, FrameAssembler, FromPage, RobotDrawing, ToPage};
use serde_json::{Value, json};

use crate::{Beginning, ChosenRobot, NamedFile, Session, WalkNews};

/// A walk of a page.
#[derive(Debug)]
pub struct PageWalk {
    walk: LockstepWalk,
    frames: FrameAssembler,
    reader: Reader,
    /// Commands that wait for the reply to the one before, newest positions only.
    waiting: LineQueue,
    /// Their texts, by the numbers of their lines.
    lines: BTreeMap<u64, Value>,
    /// Requests without a reply.
    asked: VecDeque<(RequestId, Request)>,
    session: Session,
    /// What the page is to be told, one JSON text each.
    news: Vec<String>,
}

impl PageWalk {
    /// Begins a walk; the robot stands and is told to walk. What the page is to be told waits for
    /// [`take_news`](Self::take_news).
    ///
    /// # Errors
    /// Why there is no walk, in words.
    pub fn begin(beginning: &Beginning) -> Result<Self, String> {
        let mut news = Vec::new();
        let robot = match &beginning.robot {
            ChosenRobot::InTheBox(name) => WalkableRobot::in_the_box(name).map_err(|error| error.to_string())?,
            ChosenRobot::Urdf { urdf, map } => {
                let map = map.as_ref().map(NamedFile::as_text);
                let imported = WalkableRobot::imported(urdf.as_text(), map);
                let (robot, found) = imported.map_err(|error| error.to_string())?;
                news.push(WalkNews::Imported(&found).text());
                robot
            }
        };
        let begins = Request { intent: Some(Intent::Walk), ..Request::new(Source::Script) };
        let options = LockstepOptions { seed: beginning.seed, ..LockstepOptions::default() };
        let walk = LockstepWalk::new(&robot, &options, [begins], Disturbances::default());
        let walk = walk.map_err(|error| error.to_string())?;
        let mechanism = &robot.robot.mechanism;
        let drawing = RobotDrawing::new(mechanism);
        let instance = format!("in this page, seed {}", beginning.seed);
        news.push(ToPage::Live { instance: &instance, rate_hz: options.rate.hz(), robot: &drawing }.text().to_string());
        news.push(ToPage::Driver { you: true, taken: true }.text().to_string());
        Ok(Self {
            walk,
            frames: FrameAssembler::new(mechanism, options.rate, true),
            reader: Reader::new("page"),
            waiting: LineQueue::default(),
            lines: BTreeMap::new(),
            asked: VecDeque::new(),
            session: Session::default(),
            news,
        })
    }

    /// The walk.
    pub fn walk(&self) -> &LockstepWalk {
        &self.walk
    }

    /// Takes a message of the page. The page always drives, and needs no sign of life.
    pub fn hear(&mut self, message: &FromPage) {
        match message {
            FromPage::Command(line) => self.command(line.clone()),
            FromPage::Stop => self.command(json!({ "intent": "stop" })),
            FromPage::Push(push) => self.push(push),
            FromPage::Beat | FromPage::Drive(_) => {}
        }
    }

    fn command(&mut self, line: Value) {
        match self.reader.read(Ok(&line.to_string())) {
            None => {}
            Some(Err(error)) => self.answer("refused", &error.problem),
            Some(Ok(timed)) => {
                let number = self.reader.line();
                self.lines.insert(number, line);
                for superseded in self.waiting.push(ReadLine { number, timed, read_ns: 0 }) {
                    self.lines.remove(&superseded.line.number);
                }
            }
        }
    }

    fn push(&mut self, asked: &AskedPush) {
        let AskedPush { joint, impulse, lasts_s: duration } = *asked;
        let link = Joint::ALL.get(joint as usize).copied().filter(|joint| joint.link_name().is_some());
        let start = self.walk.time();
        let outcome = match link {
            None => PushOutcome::Invalid,
            Some(link) => match self.walk.push(&PushRequest { link, impulse: impulse.into(), duration }) {
                Ok(push) => {
                    self.session.add_push(&push);
                    PushOutcome::Begun
                }
                Err(outcome) => outcome,
            },
        };
        let (kind, text) = push_text(&impulse, &PushReply { outcome, start });
        self.answer(kind, &text);
    }

    /// Walks on by so many periods, or until the simulation becomes unstable.
    pub fn walk_on(&mut self, ticks: u32) {
        for _ in 0..ticks {
            let mut answers = Vec::new();
            if let Some(line) = self.waiting.next_for_at_once(!self.asked.is_empty()) {
                let request = line.timed.request;
                let time = self.walk.rate().time(self.walk.tick());
                self.session.add_command(time, self.lines.remove(&line.number).unwrap_or_default());
                let id = self.walk.request(&request, &mut |answer| answers.push(answer));
                self.asked.push_back((id, request));
            }
            let timing = PeriodTiming { tick: self.walk.tick(), ..PeriodTiming::default() };
            let tick = self.walk.step(&mut |answer| answers.push(answer));
            self.frames.take(&timing, &tick.report);
            answers.iter().for_each(|answer| self.tell(answer));
            if let Some(instability) = self.walk.instability() {
                self.news.push(WalkNews::Problem(&instability).text());
                break;
            }
        }
        let Session { commands, disturbances } = &self.session;
        let (ticks, hash) = (self.walk.tick(), self.walk.setpoints().to_string());
        self.news.push(WalkNews::Walked { ticks, hash, commands, disturbances }.text());
        if let Some(frame) = self.frames.frame(self.walk.measurement(), None) {
            self.news.push(ToPage::Frame(&frame).text().to_string());
        }
    }

    /// What the page is to be told since the last time, one JSON text each.
    pub fn take_news(&mut self) -> Vec<String> {
        std::mem::take(&mut self.news)
    }

    fn tell(&mut self, answer: &RequestAnswer) {
        if let Some(at) = self.asked.iter().position(|(id, _)| *id == answer.id)
            && let Some((_, request)) = self.asked.remove(at)
        {
            self.answer(answer.reply.verdict.text(), &reply_text(&request, &answer.reply));
        }
    }

    fn answer(&mut self, verdict: &str, text: &str) {
        self.news.push(ToPage::Answer { verdict, text }.text().to_string());
    }
}
