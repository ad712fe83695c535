//! The machine on which a benchmark runs.

use std::{fmt, fs};

use serde::Serialize;

/// Properties of the machine that affect a benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// The processor's name.
    pub processor: String,
    /// Number of cores.
    pub cores: usize,
    /// The kernel's release.
    pub kernel: String,
    /// Preemption model as the kernel reports it: `PREEMPT_RT` is the real-time one.
    pub preemption: String,
    /// Frequency governor of the processor, or `none` if there is none.
    pub governor: String,
    /// Whether it is a virtual machine, from which the host may take cores away.
    pub virtualised: bool,
    /// The kernel's clock source.
    pub clock: String,
    /// Load average of the last minute (-).
    pub load: f64,
}

impl Machine {
    /// The machine of this process.
    pub fn of_this_process() -> Self {
        let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let of_cpu = |key: &str| {
            let line = cpu.lines().find(|line| line.starts_with(key));
            line.and_then(|line| line.split_once(':')).map(|(_, value)| value.trim().to_owned())
        };
        let first_word = |file: &str| {
            let text = fs::read_to_string(file).ok()?;
            text.split_whitespace().next().map(str::to_owned)
        };
        let name = rustix::system::uname();
        let version = name.version().to_string_lossy().into_owned();
        let preemption = version.split_whitespace().find(|word| word.starts_with("PREEMPT"));
        Self {
            processor: of_cpu("model name").unwrap_or_else(|| "unknown".to_owned()),
            cores: cpu.lines().filter(|line| line.starts_with("processor")).count(),
            kernel: name.release().to_string_lossy().into_owned(),
            preemption: preemption.unwrap_or("none").to_owned(),
            governor: first_word("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor")
                .unwrap_or_else(|| "none".to_owned()),
            virtualised: of_cpu("flags").is_some_and(|flags| flags.split(' ').any(|flag| flag == "hypervisor")),
            clock: first_word("/sys/devices/system/clocksource/clocksource0/current_clocksource")
                .unwrap_or_else(|| "unknown".to_owned()),
            load: first_word("/proc/loadavg").and_then(|load| load.parse().ok()).unwrap_or(f64::NAN),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { processor, cores, kernel, preemption, governor, virtualised, clock, load } = self;
        let kind = if *virtualised { "virtual" } else { "physical" };
        write!(
            out,
            "{processor}, {cores} cores, {kind}; Linux {kernel} {preemption}, governor {governor}, \
             clock {clock}, load {load:.1}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn machine_of_this_process_has_name_and_cores() {
        let machine = Machine::of_this_process();
        assert!(machine.cores > 0 && !machine.kernel.is_empty(), "{machine}");
    }
}
