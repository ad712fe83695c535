//! What can be set about the loops' time; `config/realtime.toml`.

use std::path::Path;
use std::time::Duration;

use model::config::{self, ConfigErrors, Document, Table};
use runtime::{Granted, Rate, Scheduling};

use crate::turns::{Clock, Pace};

/// All of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealtimeParameters {
    /// How many periods there are in a second; the same for controller and plant.
    pub rate: Rate,
    /// How long before a deadline sleeping ends; the rest is spent awake.
    pub spin: Duration,
    /// After how many missed periods in a row the controller comes to a stand; 0 is never.
    pub hold_after_misses: u64,
    /// What the controller's loop asks of the system.
    pub controller: Scheduling,
    /// What the plant's loop asks of the system.
    pub plant: Scheduling,
}

/// The last core that an affinity can name.
const CORE_MAX: u64 = 1023;

impl RealtimeParameters {
    /// Reads the file.
    ///
    /// # Errors
    /// When the file cannot be read, and every key that is unknown, missing or out of range.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ConfigErrors> {
        let path = path.as_ref();
        Self::from_toml(&config::read(path)?, &path.display().to_string())
    }

    /// Reads the file's text; `file` is its name for messages.
    ///
    /// # Errors
    /// Every key that is unknown, missing or out of range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigErrors> {
        let document = Document::parse(text, file)?;
        let root = document.root();
        let rate_hz = root.integer("rate_hz", Rate::HZ_MIN.into(), Rate::HZ_MAX.into());
        let scheduling = root.table("scheduling");
        let parameters = Self {
            rate: u32::try_from(rate_hz).ok().and_then(Rate::new).unwrap_or_default(),
            spin: Duration::from_micros(root.integer("spin_us", 0, 1000)),
            hold_after_misses: root.integer("hold_after_misses", 0, 1_000_000),
            controller: of_loop(&scheduling, "controller_core"),
            plant: of_loop(&scheduling, "plant_core"),
        };
        document.finish(parameters)
    }

    /// Keeps this thread, and those that it starts from now on, off the core of the controller's loop, if that has one to
    /// itself: waking up takes longer where somebody else runs. The loops themselves see to their cores in [`enter`].
    pub fn keep_off_the_loop(&self, clock: Clock) {
        if let Some(core) = self.controller.core.filter(|_| clock == Clock::Realtime) {
            // Where the system refuses, the loop is disturbed now and then.
            let _ = runtime::keep_off(core);
        }
    }

    /// How a loop goes by a clock.
    pub fn pace(&self, clock: Clock) -> Pace {
        Pace { clock, rate: self.rate, spin: self.spin }
    }
}

fn of_loop(table: &Table, core: &str) -> Scheduling {
    Scheduling {
        priority: u8::try_from(table.integer("priority", 0, 99)).ok().filter(|priority| *priority > 0),
        core: table.has(core).then(|| table.integer(core, 0, CORE_MAX) as usize),
        lock_memory: table.flag("lock_memory"),
        keep_awake: table.flag("keep_awake"),
    }
}

/// Asks for the scheduling of the calling thread's loop, and says once what was refused. In lockstep nothing is asked
/// for: the loops wait for each other awake, and would keep everybody else from the cores.
pub fn enter(scheduling: &Scheduling, clock: Clock, role: &str) -> Option<Granted> {
    let granted = (clock == Clock::Realtime).then(|| scheduling.ask())?;
    if !granted.refused.is_empty() {
        let refused: Vec<String> = granted.refused.iter().map(|refusal| format!("  {refusal}")).collect();
        eprintln!("the {role} runs on without real time (config/realtime.toml):\n{}", refused.join("\n"));
    }
    Some(granted)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "rate_hz = 2000\nspin_us = 150\nhold_after_misses = 9\n[scheduling]\npriority = 0\n\
                        plant_core = 1\nlock_memory = true\nkeep_awake = false\n";

    #[test]
    fn what_is_left_out_or_zero_is_not_asked_for() {
        let parameters = RealtimeParameters::from_toml(GOOD, "realtime.toml").unwrap();
        assert_eq!((parameters.rate.hz(), parameters.spin), (2000, Duration::from_micros(150)));
        let asked = Scheduling { priority: None, core: None, lock_memory: true, keep_awake: false };
        assert_eq!(parameters.controller, asked);
        assert_eq!(parameters.plant, Scheduling { core: Some(1), ..asked });
    }

    #[test]
    fn a_rate_that_no_loop_keeps_is_refused_with_what_would_be_right() {
        let errors = RealtimeParameters::from_toml(&GOOD.replace("2000", "100"), "realtime.toml").unwrap_err();
        let right = "realtime.toml:1:11: rate_hz = 100: must be a whole number between 250 and 4000";
        assert_eq!(errors.to_string(), right);
    }
}
