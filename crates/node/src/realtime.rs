//! Rate and scheduling of the loops; `config/realtime.toml`.

use std::path::Path;
use std::time::Duration;

use config::{Config, Table};
use interface::Rate;
use runtime::{Granted, Scheduling};

use crate::cycle::{Clock, CycleTiming};
use crate::tell::tell;

/// Rate and scheduling of the loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealtimeParameters {
    /// Control periods per second; the same for controller and plant.
    pub rate: Rate,
    /// How long before a deadline a loop stops sleeping and waits actively.
    pub spin: Duration,
    /// How many more deadlines must be missed than kept until the controller stops the robot; 0 is never.
    pub hold_after_misses: u64,
    /// Scheduling of the controller's loop.
    pub controller: Scheduling,
    /// Scheduling of the plant's loop.
    pub plant: Scheduling,
}

/// Highest number of a core that an affinity can name.
const CORE_MAX: u64 = 1023;

impl Config for RealtimeParameters {
    fn read(root: &Table) -> Self {
        let rate_hz = root.integer("rate_hz", Rate::HZ_MIN.into(), Rate::HZ_MAX.into());
        let scheduling = root.table("scheduling");
        Self {
            rate: Rate::clamped(rate_hz as u32),
            spin: Duration::from_micros(root.integer("spin_us", 0, 1000)),
            hold_after_misses: root.integer("hold_after_misses", 0, 1_000_000),
            controller: of_loop(&scheduling, "controller_core"),
            plant: of_loop(&scheduling, "plant_core"),
        }
    }
}

impl RealtimeParameters {
    /// Keeps this thread, and the threads that it starts from now on, off the core of the controller's loop, if that is
    /// pinned to one: waking up takes longer on a core that other threads use. The loops themselves choose their cores
    /// in [`enter`].
    pub fn keep_off_the_loop(&self, clock: Clock) {
        if let Some(core) = self.controller.core.filter(|_| clock == Clock::Realtime) {
            // If the system refuses, other threads delay the loop now and then.
            let _ = runtime::keep_off(core);
        }
    }

    /// When the cycles of a loop begin.
    pub fn timing(&self, clock: Clock) -> CycleTiming {
        CycleTiming { clock, rate: self.rate, spin: self.spin }
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

/// Asks the system for the scheduling of the calling thread, and tells once what was refused. In lockstep it asks for
/// nothing: the loops wait actively for each other, and would starve all other threads.
///
/// * `file` – where the scheduling was read
pub fn enter(scheduling: &Scheduling, clock: Clock, role: &str, file: &Path) -> Option<Granted> {
    let granted = (clock == Clock::Realtime).then(|| scheduling.request())?;
    if !granted.refused.is_empty() {
        let refused: Vec<String> = granted.refused.iter().map(|refusal| format!("  {refusal}")).collect();
        tell(format_args!(
            "the {role} runs on without everything that {} asks for:\n{}",
            file.display(),
            refused.join("\n")
        ));
    }
    Some(granted)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "rate_hz = 2000\nspin_us = 150\nhold_after_misses = 9\n[scheduling]\npriority = 0\n\
                        plant_core = 1\nlock_memory = true\nkeep_awake = false\n";

    #[test]
    fn scheduling_keys_that_are_absent_or_zero_ask_for_nothing() {
        let parameters = RealtimeParameters::from_toml(GOOD, "realtime.toml").unwrap();
        assert_eq!((parameters.rate.hz(), parameters.spin), (2000, Duration::from_micros(150)));
        let asked = Scheduling { priority: None, core: None, lock_memory: true, keep_awake: false };
        assert_eq!(parameters.controller, asked);
        assert_eq!(parameters.plant, Scheduling { core: Some(1), ..asked });
    }

    #[test]
    fn rate_out_of_range_is_refused_with_the_valid_range() {
        let errors = RealtimeParameters::from_toml(&GOOD.replace("2000", "100"), "realtime.toml").unwrap_err();
        let right = "realtime.toml:1:11: rate_hz = 100: must be a whole number between 250 and 4000";
        assert_eq!(errors.to_string(), right);
    }
}
