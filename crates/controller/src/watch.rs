//! Watches the measurements: what is stale, out of order or no number does not get through.

use nalgebra::Vector3;

use crate::{Fault, Faults, Measurement, WatchParameters};

/// Remembers how long ago a measurement was good.
#[derive(Clone, Debug)]
pub struct Watch {
    parameters: WatchParameters,
    newest: Option<u64>,
    silence: f64,
}

impl Watch {
    /// Nothing seen yet; the allowed silence begins now.
    pub fn new(parameters: WatchParameters) -> Self {
        Self { parameters, newest: None, silence: 0.0 }
    }

    /// Absorbs what came within the last `dt` seconds and lets a good measurement through, with the vertical in its
    /// trunk's axes.
    pub fn update<'m>(
        &mut self,
        measurement: Option<&'m Measurement>,
        dt: f64,
        faults: &mut Faults,
    ) -> Option<(&'m Measurement, Vector3<f64>)> {
        self.silence += dt;
        let good = measurement.and_then(|measurement| match measurement.up_in_trunk() {
            _ if self.newest.is_some_and(|newest| measurement.tick < newest) => {
                faults.insert(Fault::MeasurementOutOfOrder);
                None
            }
            // The same sample again is no news, but no fault either: the two processes' periods drift.
            _ if self.newest == Some(measurement.tick) => None,
            Some(up) => Some((measurement, up)),
            None => {
                faults.insert(Fault::MeasurementNotFinite);
                None
            }
        });
        if let Some((measurement, _)) = good {
            self.newest = Some(measurement.tick);
            self.silence = 0.0;
        }
        if self.is_stale() {
            faults.insert(Fault::MeasurementStale);
        }
        good
    }

    /// Whether nothing good came for longer than allowed.
    pub fn is_stale(&self) -> bool {
        self.silence > self.parameters.silence_max
    }

    /// Whether the trunk tilts beyond recovery.
    pub fn has_fallen(&self, up_in_trunk: &Vector3<f64>) -> bool {
        up_in_trunk.z < self.parameters.tilt_max.cos()
    }
}
