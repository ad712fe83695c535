//! What is summed up over all rows of a run, however long it is.

use interface::{Fault, Faults, Mode};
use model::Mechanism;
use serde::Serialize;

use super::DriveRow;
use super::drive_account::DriveAccount;
use super::rows::ControllerRow;
use super::zmp_error::ZmpErrorSum;

/// Sums and peaks over all rows of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunTotals {
    pub(super) drives: DriveAccount,
    pub(super) zmp_error: ZmpErrorSum,
    pub(crate) faulted: Option<FaultedSince>,
}

/// When the controller first stood because of a fault.
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
        if self.faulted.is_none() && row.mode == Mode::Faulted.text() {
            // A missed deadline alone stops nothing.
            let faults = Faults(row.faults).iter().filter(|fault| *fault != Fault::DeadlineMissed);
            let faults = faults.map(|fault| fault.to_string()).collect();
            self.faulted = Some(FaultedSince { time_s: row.time, faults });
        }
    }

    pub(super) fn note_drives(&mut self, mechanism: &Mechanism, row: &DriveRow) {
        self.drives.add(mechanism, row);
    }
}
