//! Connects to the controller of an instance, which may just be starting.

use std::time::Duration;

use operator::OperatorError;
use wire::{ConnectError, Instance, running_instances};

use crate::error::CliError;

/// How often, and at what interval, a controller is looked for.
const POLLS: u32 = 40;
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Connects, and waits two seconds for a controller to start.
///
/// # Errors
/// There is no controller: the error names the instances that have one, and nothing is left of this one. Or it cannot
/// be connected to.
pub(super) fn patiently<T, E: Into<OperatorError>>(
    instance: &Instance,
    mut connect: impl FnMut() -> Result<T, E>,
) -> Result<T, CliError> {
    let mut polls = 0;
    let error = loop {
        match connect().map_err(E::into) {
            Err(OperatorError::Connect(ConnectError::NoController { .. })) if polls < POLLS => {
                std::thread::sleep(POLL_INTERVAL);
            }
            Err(error) => break error,
            Ok(connected) => return Ok(connected),
        }
        polls += 1;
    };
    if !matches!(error, OperatorError::Connect(ConnectError::NoController { .. })) {
        return Err(error.into());
    }
    drop(instance.leftovers());
    let running: Vec<String> = running_instances().iter().map(|name| format!("--instance {name}")).collect();
    let hint = if running.is_empty() { String::new() } else { format!("; running: {}", running.join(", ")) };
    Err(CliError::new(format!("{error}{hint}")))
}
