//! Setpoint, controller → wire → plant.

use plant::Setpoint;
use wire::SetpointMessage;

/// The controller's setpoint that answers the measurement of `tick`, for the wire.
pub fn message(tick: u64, time_ns: u64, setpoint: &controller::Setpoint) -> SetpointMessage {
    let controller::Setpoint { angles, rates, feed_forward } = *setpoint;
    SetpointMessage::from(&wire::Setpoint { tick, time_ns, angles, rates, feed_forward })
}

/// What came over the wire, for the plant.
pub fn for_plant(setpoint: &wire::Setpoint) -> Setpoint {
    Setpoint { angles: setpoint.angles, rates: setpoint.rates, feed_forward: setpoint.feed_forward }
}
