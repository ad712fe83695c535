//! What is summed up over all rows of a run, however long it is.

use interface::{Fault, Faults, Mode};
use model::Mechanism;
use serde::Serialize;

use super::DriveRow;
use super::drive_account::DriveAccount;
use super::rows::{ControllerRow, PlantRow};
use super::zmp_error::ZmpErrorSum;

/// Sums and peaks over all rows of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunTotals {
    pub(super) drives: DriveAccount,
    pub(super) zmp_error: ZmpErrorSum,
    pub(crate) faulted: Option<FaultedSince>,
    /// Whether the robot lies on the ground in the newest row of the plant.
    is_down: bool,
    /// Whether nothing balances the robot any more, as the newest row of the controller says.
    is_given_up: bool,
}

/// When a fault first stopped the robot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaultedSince {
    /// When (s).
    pub time_s: f64,
    /// What was wrong then, in words.
    pub faults: Vec<String>,
}

impl RunTotals {
    pub(crate) fn note_controller(&mut self, row: &ControllerRow) {
        self.zmp_error.add(row);
        self.is_given_up = !row.is_balancing();
        // Without measurements the robot is stopped: it stands a moment later.
        let is_stopped = row.mode == Mode::Faulted.text() || Faults(row.faults).contains(Fault::MeasurementStale);
        if self.faulted.is_none() && is_stopped {
            // A missed deadline alone stops nothing.
            let faults = Faults(row.faults).iter().filter(|fault| *fault != Fault::DeadlineMissed);
            let faults = faults.map(|fault| fault.to_string()).collect();
            self.faulted = Some(FaultedSince { time_s: row.time, faults });
        }
    }

    pub(super) fn note_plant(&mut self, row: &PlantRow) {
        self.is_down = row.fallen;
    }

    /// Adds a row of the drives, unless the robot has fallen or a fault has stopped it.
    pub(super) fn note_drives(&mut self, mechanism: &Mechanism, row: &DriveRow) {
        if !self.is_down && !self.is_given_up {
            self.drives.add(mechanism, row);
        }
    }
}
