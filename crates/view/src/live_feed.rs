//! Watches a running robot, and publishes what the page shows of it. Nobody waits for a page: those that are slow get
//! the newest frame and miss those before.

use std::sync::Arc;
use std::time::Duration;

use interface::Rate;
use model::Mechanism;
use nalgebra::Isometry3;
use runtime::now_ns;
use scene::{FloorCell, FloorCells, FrameAssembler, RobotDrawing, ToPage};
use tokio::sync::watch;
use wire::{ConnectError, Instance, MeasurementMessage, SpectatorPorts, TruePoses};

use crate::FloorTexts;

/// Time between two looks at the reports, of which the last 64 are kept: in lockstep a second passes in a few
/// hundredths of one.
const POLL_INTERVAL: Duration = Duration::from_millis(1);
/// Time between two frames.
const FRAME_INTERVAL: Duration = Duration::from_millis(25);
/// Time between two looks whether the plant tells of a floor: it may come after the controller.
const FLOOR_INTERVAL: Duration = Duration::from_secs(1);
/// How old a true pose may be: older ones are of a plant that has gone. In lockstep much passes between two looks.
const POSE_AGE_MAX: Duration = Duration::from_secs(10);
/// Time between two attempts to connect.
const RETRY_INTERVAL: Duration = Duration::from_millis(200);
/// After this time without a report the connection is made anew: the controller may have gone.
const SILENCE_MAX: Duration = Duration::from_secs(3);

/// The floor of a plant that tells of none.
const PLANE: ToPage = ToPage::Floor { index: 0, pieces: &[] };

/// What a page shows of a running robot: three texts, each replaced by newer ones.
#[derive(Clone, Debug)]
pub(crate) struct LiveTexts {
    /// The robot, or why there is none to be seen.
    pub(crate) scene: watch::Receiver<Arc<str>>,
    /// The floor near it.
    pub(crate) floor: watch::Receiver<Arc<str>>,
    /// The newest frame; empty before the first one.
    pub(crate) frame: watch::Receiver<Arc<str>>,
}

/// Publishes what is seen of an instance until nobody wants it any more.
pub(crate) struct LiveFeed {
    instance: Instance,
    /// The robots that may be running, of which the fingerprint tells which one is.
    robots: Vec<Mechanism>,
    scene: watch::Sender<Arc<str>>,
    floor: watch::Sender<Arc<str>>,
    frame: watch::Sender<Arc<str>>,
}

impl LiveFeed {
    pub(crate) fn new(instance: Instance, robots: Vec<Mechanism>) -> (Self, LiveTexts) {
        let waiting = ToPage::Waiting { why: "connecting" }.text();
        let (scene, scene_texts) = watch::channel(waiting);
        let (floor, floor_texts) = watch::channel(PLANE.text());
        let (frame, frame_texts) = watch::channel(Arc::from(""));
        let texts = LiveTexts { scene: scene_texts, floor: floor_texts, frame: frame_texts };
        (Self { instance, robots, scene, floor, frame }, texts)
    }

    /// Watches until the last receiver has gone.
    pub(crate) fn run(self) {
        while !self.frame.is_closed() {
            let why = match SpectatorPorts::connect(&self.instance) {
                Ok(ports) => match self.robot(ports.mechanism) {
                    Some(robot) => {
                        self.watch(ports, robot);
                        "the controller is silent".to_owned()
                    }
                    None => "a robot is running that is not known here: start `halfstep view` with its --config or \
                             --robot"
                        .to_owned(),
                },
                Err(ConnectError::NoController { .. }) => {
                    format!("no controller is running on instance `{}`", self.instance.name())
                }
                Err(error) => error.to_string(),
            };
            self.tell(&self.scene, ToPage::Waiting { why: &why }.text());
            std::thread::sleep(RETRY_INTERVAL);
        }
    }

    fn robot(&self, fingerprint: u64) -> Option<&Mechanism> {
        self.robots.iter().find(|robot| robot.fingerprint == fingerprint)
    }

    /// Publishes frames until the controller has been silent for long.
    fn watch(&self, mut ports: SpectatorPorts, robot: &Mechanism) {
        let rate = Rate::clamped(ports.reports.rate_hz());
        let mut assembler = FrameAssembler::new(robot, rate, ports.is_lockstep);
        self.tell(&self.floor, PLANE.text());
        let (mut heard_ns, mut framed_ns) = (now_ns(), 0);
        let mut is_heard = false;
        let mut measured: Option<MeasurementMessage> = None;
        let (mut floor, mut floor_sought_ns, mut true_sole): (Option<NearFloor>, _, _) = (None, 0, None);
        let elapsed = |since: u64| Duration::from_nanos(now_ns().saturating_sub(since));
        while !self.frame.is_closed() && elapsed(heard_ns) < SILENCE_MAX {
            if measured.is_none() && elapsed(framed_ns) >= FRAME_INTERVAL {
                measured = ports.measurements.latest();
                // In lockstep much is walked until the report has come.
                if floor.is_none() && elapsed(floor_sought_ns) >= FLOOR_INTERVAL {
                    floor_sought_ns = now_ns();
                    floor = NearFloor::of(&self.instance);
                }
                let sole = floor.as_mut().zip(measured.as_ref()).map(|(floor, at)| floor.true_sole(at, rate));
                if matches!(sole, Some(Err(OtherPlant))) {
                    floor = None;
                }
                true_sole = sole.and_then(Result::ok).flatten();
            }
            // A report that cannot be received is a lost one.
            while let Ok(Some(report)) = ports.reports.next_report() {
                if let Ok(checked) = report.checked() {
                    assembler.take(&report.timing(), &checked);
                }
                heard_ns = now_ns();
                if !std::mem::replace(&mut is_heard, true) {
                    let drawing = RobotDrawing::new(robot);
                    let instance = self.instance.name().as_str();
                    self.tell(&self.scene, ToPage::Live { instance, rate_hz: rate.hz(), robot: &drawing }.text());
                }
                // Reports take a while: the one of the period that used the measurement comes after it.
                if let Some(message) = measured.take_if(|message| message.time_ns <= report.time_ns) {
                    framed_ns = now_ns();
                    if let (Some(floor), Some(sole)) = (&mut floor, &true_sole)
                        && let Some(text) = floor.text_if_new(sole)
                    {
                        self.tell(&self.floor, text);
                    }
                    if let Some(frame) = assembler.frame(&message.measurement(), true_sole.as_ref()) {
                        self.tell(&self.frame, ToPage::Frame(&frame).text());
                    }
                }
            }
            std::thread::sleep(POLL_INTERVAL);
        }
    }

    fn tell(&self, to: &watch::Sender<Arc<str>>, text: Arc<str>) {
        to.send_if_modified(|last| {
            let is_new = *last != text;
            *last = text;
            is_new
        });
    }
}

/// The floor near a simulated robot, where it is no plane.
struct NearFloor {
    cells: FloorCells,
    poses: TruePoses,
    /// The plant's period of the newest pose.
    tick: u64,
    /// The cell in which the robot was.
    here: Option<FloorCell>,
}

impl NearFloor {
    fn of(instance: &Instance) -> Option<Self> {
        let cells = FloorTexts::left_in(instance.folder())?.cells()?;
        Some(Self { cells, poses: TruePoses::connect(instance).ok()?, tick: 0, here: None })
    }

    /// Where the right sole truly is at about the time of a measurement, whose plant counts its periods from its start;
    /// an error if another plant has taken the place of the one whose floor this is.
    fn true_sole(&mut self, measured: &MeasurementMessage, rate: Rate) -> Result<Option<Isometry3<f64>>, OtherPlant> {
        let Some(pose) = self.poses.poses.latest() else { return Ok(None) };
        if pose.tick < self.tick || pose.tick.abs_diff(measured.tick) > rate.ticks(POSE_AGE_MAX) {
            return Err(OtherPlant);
        }
        self.tick = pose.tick;
        Ok(pose.right_sole())
    }

    /// What a page is told when the robot has come to another cell.
    fn text_if_new(&mut self, sole: &Isometry3<f64>) -> Option<Arc<str>> {
        let cell = FloorCells::cell(sole.translation.vector.xy());
        if self.here.replace(cell) == Some(cell) {
            return None;
        }
        let pieces = self.cells.pieces(FloorCells::near(cell));
        Some(ToPage::Floor { index: 0, pieces: &pieces }.text())
    }
}

/// The plant whose floor was shown has gone.
struct OtherPlant;
