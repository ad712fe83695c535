//! What a controller's process tells on stderr while it runs: its mode when that changes, and each latched fault. Made
//! from what the loop records, on the recorder's thread.

use controller::Tick;
use interface::{LatchedFault, Mode};

/// Which changes are told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Announced {
    /// Every change of mode, and every latched fault.
    All,
    /// Latched faults only: another process tells the modes.
    Faults,
}

/// Turns changes into lines.
#[derive(Clone, Debug)]
pub struct Announcements {
    announced: Announced,
    mode: Option<Mode>,
    latched: Option<LatchedFault>,
}

impl Announcements {
    /// Nothing was told yet.
    pub fn new(announced: Announced) -> Self {
        Self { announced, mode: None, latched: None }
    }

    /// The lines to tell after a tick: none, unless something has changed.
    ///
    /// * `time` – time of the tick since the first one (s)
    pub fn after(&mut self, tick: &Tick, time: f64) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(latched) = tick.latched.filter(|&latched| self.latched != Some(latched)) {
            let (text, time) = (latched.text(), latched.time);
            lines.push(format!("controller: fault at {time:.2} s: {text}; it waits for a reset"));
        }
        self.latched = tick.latched;
        let mode = Some(tick.report.mode);
        if self.announced == Announced::All && self.mode != mode {
            lines.push(format!("controller: {} at {time:.2} s", tick.report.mode));
        }
        self.mode = mode;
        lines
    }
}

#[cfg(test)]
mod tests {
    use interface::{Command, Fault, Faults, HalfStep, Odometry, Report, Setpoint};
    use model::Side;
    use nalgebra::Vector2;

    use super::*;

    fn tick(mode: Mode, latched: Option<LatchedFault>) -> Tick {
        let report = Report {
            mode,
            half_step: HalfStep::first(Side::Right),
            speed: 1.0,
            turn: 0.0,
            extension: 0.0,
            sidestep: 0.0,
            odometry: Odometry::default(),
            destination: None,
            zmp_in_support: None,
            zmp_planned: None,
            margin: None,
            lean: Vector2::zeros(),
            added: None,
            com_planned: None,
            com_measured: None,
            capturability: None,
            estimate: interface::StateEstimate::default(),
            faults: Faults::default(),
        };
        let (setpoint, command) = (Setpoint::default(), Command::NOMINAL);
        Tick { setpoint, report, rejection: None, command, reply: None, superseded: None, latched }
    }

    #[test]
    fn a_fault_and_each_change_of_mode_are_told_once() {
        let stale = Some(LatchedFault { fault: Fault::Fallen, time: 3.3, cause: None });
        let run = [(Mode::Walking, None), (Mode::Stopping, stale), (Mode::Stopping, stale), (Mode::Faulted, stale)];
        let lines = |announced| {
            let mut announcements = Announcements::new(announced);
            let after = |(number, &(mode, latched))| announcements.after(&tick(mode, latched), number as f64);
            run.iter().enumerate().flat_map(after).collect::<Vec<String>>()
        };
        let fault = "controller: fault at 3.30 s: the robot has fallen; it waits for a reset";
        let all = ["controller: walking at 0.00 s", fault, "controller: stopping at 1.00 s"];
        assert_eq!(lines(Announced::All)[..3], all);
        assert_eq!(lines(Announced::All)[3..], ["controller: faulted at 3.00 s"]);
        assert_eq!(lines(Announced::Faults), [fault]);
    }
}
