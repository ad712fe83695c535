//! What the tests share: an instance for each, messages to send, and waiting.

#![allow(dead_code)]

use std::fs::DirBuilder;
use std::os::unix::fs::DirBuilderExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use model::Joint;
use wire::{Instance, Leftovers, MeasurementMessage, ReportMessage, RequestMessage, SetpointMessage};

pub(crate) const MECHANISM: u64 = 0x0123_4567_89ab_cdef;

/// Much longer than anything here takes, even on a loaded machine.
pub(crate) const LONG: Duration = Duration::from_secs(30);

/// Removes what is left of a test.
pub(crate) struct Guard {
    leftovers: Option<Leftovers>,
    base: PathBuf,
}

impl Drop for Guard {
    fn drop(&mut self) {
        self.leftovers.take();
        let _ = std::fs::remove_dir_all(&self.base);
    }
}

/// An instance of this test alone, in a runtime folder of its own, and the guard that removes its files.
pub(crate) fn own_instance() -> (Instance, Guard) {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let name = format!("test-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let base = std::env::temp_dir().join(format!("halfstep-{name}"));
    DirBuilder::new().mode(0o700).create(&base).unwrap();
    let instance = Instance::new_in(&name, &base).unwrap();
    let leftovers = Some(instance.leftovers());
    (instance, Guard { leftovers, base })
}

/// The `$XDG_RUNTIME_DIR` of an instance of [`own_instance`].
pub(crate) fn runtime_folder(instance: &Instance) -> &Path {
    instance.folder().ancestors().nth(2).unwrap()
}

/// Polls until there is a value.
pub(crate) fn eventually<T>(what: &str, mut poll: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(value) = poll() {
            return value;
        }
        assert!(began.elapsed() < LONG, "{what} did not happen");
        std::thread::yield_now();
    }
}

pub(crate) fn setpoint(tick: u64) -> SetpointMessage {
    let value = tick as f64;
    SetpointMessage {
        tick,
        time_ns: 10 * tick,
        angles: [value; Joint::COUNT],
        rates: [-value; Joint::COUNT],
        feed_forward: [value / 2.0; Joint::COUNT],
    }
}

pub(crate) fn measurement(tick: u64) -> MeasurementMessage {
    let value = tick as f64;
    MeasurementMessage {
        tick,
        time_ns: 10 * tick,
        sample: tick,
        angles: [value; Joint::COUNT],
        rates: [-value; Joint::COUNT],
        wrench_right: [value; 6],
        wrench_left: [-value; 6],
        imu_orientation: [0.0, 1.0, 0.0, 0.0],
        imu_rate: [value; 3],
        motor_current: [value; Joint::COUNT],
        imu_specific_force: [value; 3],
        missing: 0,
    }
}

pub(crate) fn request(turn: f64) -> RequestMessage {
    RequestMessage {
        not_before: 0,
        present: RequestMessage::TURN,
        intent: 0,
        source: 0,
        lasting: 0,
        turn,
        speed: 0.0,
        extension: 0.0,
        sidestep: 0.0,
        velocity: [0.0; 3],
        places: [0.0; 72],
        place_count: 0,
        place_kind: 0,
        place_frame: 0,
        place_marks: 0,
        age_limit: 0.0,
        id: 0,
        expires_ns: 0,
    }
}

pub(crate) fn report(tick: u64) -> ReportMessage {
    ReportMessage {
        tick,
        time_ns: 0,
        mode: 2,
        support: 1,
        half_step: 4,
        progress: 0.25,
        speed: 1.0,
        turn: 0.1,
        extension: 0.0,
        sidestep: 0.0,
        zmp_in_support: [0.01, 0.02],
        zmp_planned: [0.0; 2],
        margin: 0.02,
        lean: [0.0; 2],
        added: [0.0; 4],
        com_in_support: [0.1, 0.09, 0.9],
        com_velocity_in_support: [0.4, 0.0, 0.0],
        com_planned: [0.1, 0.09, 0.9],
        com_velocity_planned: [0.4, 0.0, 0.0],
        pose: [0.5, 0.0, 0.1],
        walk_velocity: [0.4, 0.0, 0.1],
        support_sole: [0.6, 0.1, 0.1],
        landing: [0.8, -0.1, 0.1],
        landing_after: [1.0, 0.1, 0.2],
        destination: 1,
        destination_places_left: 2,
        destination_distance: 1.5,
        destination_turn: 0.3,
        capturability: 1,
        contact: 2,
        external_force: [3.0, -2.0],
        com_offset: [0.01, 0.0],
        gyro_bias: [0.0; 3],
        faults: 0,
        missed: 0,
        compute_ns: 1500,
    }
}

/// Names of files in shared memory and in the temporary folder that belong to an instance.
pub(crate) fn files_of(instance: &Instance) -> Vec<String> {
    let mark = instance.prefix();
    let shared = std::fs::read_dir("/dev/shm").unwrap().flatten().map(|file| file.file_name());
    let mut files: Vec<String> =
        shared.map(|name| name.to_string_lossy().into_owned()).filter(|name| name.starts_with(&mark)).collect();
    let folder = instance.folder();
    files.extend(folder.exists().then(|| folder.display().to_string()));
    files
}
