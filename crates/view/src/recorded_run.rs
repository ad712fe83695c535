//! A recorded run, as the frames that a live one would have given.

use std::collections::BTreeSet;
use std::path::Path;

use config::Config;
use interface::Rate;
use model::{Joint, Mechanism};
use record::{PushMessage, Recording, RunEvent, files_of, provenance_of};
use scene::{FloorCell, FloorCells, FloorPiece, FrameAssembler, RobotDrawing, RunNote, ViewFrame};
use wire::TruePoseMessage;

use crate::fall_watch::FallWatch;
use crate::recorded_requests::RecordedRequests;
use crate::{FloorTexts, ViewError};

/// Time between two frames (s).
const INTERVAL: f64 = 0.02;
/// Most frames of a run: of a longer one every second, every third and so on.
const FRAMES_MAX: usize = 30_000;
/// About how many cells of the floor a page can draw.
const CELLS_MAX: usize = 2000;
/// Name of the attached description of the robot.
const MECHANISM: &str = "mechanism.toml";

/// A recorded run in memory.
#[derive(Clone, Debug)]
pub struct RecordedRun {
    pub(crate) name: String,
    pub(crate) robot: RobotDrawing,
    pub(crate) frames: Vec<ViewFrame>,
    pub(crate) notes: Vec<RunNote>,
    /// The floor near the way, where it is no plane.
    pub(crate) floor: Vec<FloorPiece>,
    /// What is missing at its end, if anything is.
    pub cut: Option<String>,
}

impl RecordedRun {
    /// Reads a run, given by its recording or by the folder that holds it.
    ///
    /// # Errors
    /// It cannot be read, says nothing about its robot, or holds no report of a controller.
    pub fn read(run: &Path) -> Result<Self, ViewError> {
        let name = run.display().to_string();
        let origin = provenance_of(run)?;
        let lacks = |what: &str| ViewError::Lacks { run: name.clone(), what: what.to_owned() };
        let text = origin.file(MECHANISM).ok_or_else(|| lacks("mechanism.toml, the description of its robot"))?;
        let mechanism = Mechanism::from_toml(text, &format!("{name}: {MECHANISM}"))
            .map_err(|errors| ViewError::Robot(errors.to_string()))?;
        let rate = origin.entry("controller", "rate_hz").and_then(|rate| rate.parse().ok()).and_then(Rate::new);
        let rate = rate.ok_or_else(|| lacks("the rate of its controller: it must have the controller's recording"))?;
        let robot = RobotDrawing::new(&mechanism);

        let mut assembler =
            FrameAssembler::new(&mechanism, rate, origin.entry("controller", "clock") == Some("lockstep"));
        let (mut frames, mut requests) = (Frames::default(), RecordedRequests::default());
        let mut fall = FallWatch::default();
        let floor = FloorTexts::of_recording(&origin).and_then(|texts| texts.cells());
        let mut way = Vec::new();
        let (mut notes, mut cuts) = (Vec::new(), Vec::new());
        for file in files_of(run)? {
            let mut recording = Recording::open(&file)?;
            let (mut measurement, mut true_sole) = (None, None);
            while let Some(event) = recording.next_event()? {
                match event.event {
                    RunEvent::Measurement(message) => measurement = Some(message.measurement()),
                    RunEvent::Report(report) => {
                        fall.take(event.time(), &report);
                        if let Ok(checked) = report.checked() {
                            assembler.take(&report.timing(), &checked);
                        }
                        if let Some(measurement) = &measurement
                            && frames.is_due(event.time())
                        {
                            frames.add(event.time(), assembler.frame(measurement, true_sole.as_ref()));
                        }
                    }
                    RunEvent::Request(message) => requests.asked(event.number, &message),
                    RunEvent::Reply(message) => requests.replied(event.time(), event.number, &message),
                    RunEvent::Push(push) => notes.push(push_note(&push)),
                    RunEvent::Truth(truth) if floor.is_some() => {
                        let [x, y, z, orientation @ ..] = truth.right_sole;
                        let (tick, position) = (truth.tick, [x, y, z]);
                        true_sole = TruePoseMessage { tick, time_ns: 0, position, orientation }.right_sole();
                        let cell = true_sole.map(|sole| FloorCells::cell(sole.translation.vector.xy()));
                        way.extend(cell.filter(|cell| way.last() != Some(cell)));
                    }
                    RunEvent::Tick(_) | RunEvent::Setpoint(_) | RunEvent::Truth(_) => {}
                }
            }
            cuts.extend(recording.cut());
        }
        if frames.kept.is_empty() {
            return Err(lacks("any report of a controller"));
        }
        let cut = (!cuts.is_empty()).then(|| cuts.join("; "));
        notes.extend(requests.notes);
        notes.extend(fall.notes);
        notes.sort_by(|one, other| one.t.total_cmp(&other.t));
        let floor = floor.map_or(Vec::new(), |floor| floor.pieces(near(&way)));
        Ok(Self { name, robot, frames: frames.kept, notes, floor, cut })
    }

    /// Time of the last frame (s).
    pub(crate) fn duration(&self) -> f64 {
        self.frames.last().map_or(0.0, |frame| frame.t)
    }
}

/// Cells near a way, no more than a page can draw: of a longer way those at its beginning.
fn near(way: &[FloorCell]) -> BTreeSet<FloorCell> {
    let mut cells = BTreeSet::new();
    for cell in way {
        if cells.len() < CELLS_MAX {
            cells.extend(FloorCells::near(*cell));
        }
    }
    cells
}

/// A push in words.
fn push_note(push: &PushMessage) -> RunNote {
    let link = u8::try_from(push.link).ok().and_then(Joint::from_number).and_then(Joint::link_name);
    let [x, y, z] = push.impulse;
    let text = format!(
        "push on the {}: {x:.1}, {y:.1}, {z:.1} N·s within {:.2} s",
        link.unwrap_or("robot").replace('_', " "),
        push.duration
    );
    RunNote { t: push.start, kind: "push", text }
}

/// The frames of a run, not too many.
struct Frames {
    kept: Vec<ViewFrame>,
    interval: f64,
    due: f64,
}

impl Default for Frames {
    fn default() -> Self {
        Self { kept: Vec::new(), interval: INTERVAL, due: 0.0 }
    }
}

impl Frames {
    /// Whether there is to be a frame at a time (s).
    fn is_due(&self, time: f64) -> bool {
        // A hair earlier, so that a multiple of the interval is one.
        time >= self.due - 1e-9
    }

    fn add(&mut self, time: f64, frame: Option<ViewFrame>) {
        self.kept.extend(frame.map(|frame| ViewFrame { t: time, ..frame }));
        self.due = time + self.interval;
        if self.kept.len() > FRAMES_MAX {
            let mut keep = false;
            self.kept.retain(|_| {
                keep = !keep;
                keep
            });
            self.interval *= 2.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of a robot that stands.
    fn frame_at(t: f64) -> ViewFrame {
        ViewFrame {
            t,
            mode: "standing",
            support: 0,
            half_step: 0,
            progress: 0.0,
            gait: [1.0, 0.0, 0.0, 0.0],
            base: [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            floor: None,
            angles: [0.0; Joint::COUNT],
            zmp: None,
            zmp_planned: None,
            dcm: None,
            dcm_planned: None,
            margin: None,
            lean: [0.0; 2],
            added: None,
            pose: [0.0; 3],
            velocity: [0.0; 3],
            support_sole: [0.0; 3],
            landings: [[0.0; 3]; 2],
            destination: None,
            loads: [0.0; 2],
            capturability: "",
            faults: Vec::new(),
            missed: 0,
            compute_us: 0.0,
            jitter_us: 0.0,
        }
    }

    #[test]
    fn a_long_run_is_thinned_to_what_a_page_can_hold() {
        let mut frames = Frames::default();
        for tick in 0..2_000_000_u32 {
            let time = f64::from(tick) * 1e-3;
            if frames.is_due(time) {
                frames.add(time, Some(frame_at(time)));
            }
        }
        assert!((FRAMES_MAX / 2..=FRAMES_MAX).contains(&frames.kept.len()), "{}", frames.kept.len());
        let steps = frames.kept.windows(2).map(|pair| pair[1].t - pair[0].t);
        let longest = steps.fold(0.0, f64::max);
        assert!((longest - frames.interval).abs() < 1e-6, "{longest} instead of {}", frames.interval);
        assert!(frames.kept.last().is_some_and(|last| last.t > 1999.0));
    }
}
