//! Opening or creating a service, under attributes on which both sides must agree.

use std::fmt::Display;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use iceoryx2::prelude::{AttributeSet, AttributeSpecifier, MessagingPattern, PortFactory, Service, ServiceName};
use iceoryx2::service::attribute::{AttributeKey, AttributeValue};
use iceoryx2::service::service_hash::ServiceHash;

use crate::instance::LOCKSTEP;
use crate::shared_memory::Role;
use crate::{ConnectError, DEFAULT_RATE_HZ, Instance, Ipc};

/// Longest wait for a process that is just disconnecting.
const TIMEOUT: Duration = Duration::from_secs(1);
/// After this time an incomplete service was left by a process that was killed while creating it; it is removed.
const INCOMPLETE_TIMEOUT: Duration = Duration::from_millis(300);
/// Time between two attempts.
const RETRY_INTERVAL: Duration = Duration::from_millis(5);

/// Attribute key of the control rate.
const RATE: &str = "rate_hz";
/// Attribute key of the robot's fingerprint.
const MECHANISM: &str = "mechanism";
/// Attribute key of what begins a period: `realtime` or `lockstep`.
const CLOCK: &str = "clock";
/// Attribute key of the posture in which the robot begins: `stride` or `stand`.
const START: &str = "start";

/// The control rate for which a service was created (Hz).
pub(crate) fn rate_hz(service: &impl PortFactory) -> u32 {
    let value = service.attributes().key_value(&attribute_key(RATE), 0);
    // Every controller of this protocol version states it.
    value.and_then(|value| value.to_string().parse().ok()).unwrap_or(DEFAULT_RATE_HZ)
}

/// The fingerprint of the robot for which a service was created; 0 if it states none.
pub(crate) fn mechanism(service: &impl PortFactory) -> u64 {
    let value = service.attributes().key_value(&attribute_key(MECHANISM), 0).map(ToString::to_string);
    let digits = value.as_deref().and_then(|value| value.strip_prefix("0x"));
    digits.and_then(|digits| u64::from_str_radix(digits, 16).ok()).unwrap_or(0)
}

/// Whether a service was created for processes in lockstep.
pub(crate) fn is_lockstep(service: &impl PortFactory) -> bool {
    let value = service.attributes().key_value(&attribute_key(CLOCK), 0);
    value.is_some_and(|clock| *clock == attribute_value(LOCKSTEP))
}

/// A service of an instance, with the attributes on which both sides must agree.
pub(crate) struct ServiceContract<'a> {
    instance: &'a Instance,
    pattern: MessagingPattern,
    pub name: ServiceName,
    attributes: Vec<(&'static str, String)>,
    /// Attributes that are compared only before the robot moves.
    initial: Vec<(&'static str, String)>,
}

impl<'a> ServiceContract<'a> {
    /// A service named `service`; `mechanism` is the fingerprint of the robot if the messages carry joint numbers.
    pub(crate) fn new(
        instance: &'a Instance,
        service: &'static str,
        pattern: MessagingPattern,
        mechanism: Option<u64>,
    ) -> Self {
        let mut attributes = vec![("protocol", instance.protocol().to_string())];
        attributes.extend(mechanism.map(|fingerprint| (MECHANISM, format!("{fingerprint:#018x}"))));
        Self { instance, pattern, name: instance.service_name(service), attributes, initial: Vec::new() }
    }

    /// The same for a side that counts control periods: both must have the same rate.
    pub(crate) fn at_rate(mut self) -> Self {
        self.attributes.push((RATE, self.instance.rate_hz().to_string()));
        self
    }

    /// The same for controller and plant: both must have the same clock, and begin in the same posture.
    pub(crate) fn of_pair(mut self) -> Self {
        self.attributes.push((CLOCK, self.instance.clock().to_owned()));
        self.initial.push((START, self.instance.start().to_owned()));
        self.at_rate()
    }

    /// Compares what both sides must begin with: for a robot that has not moved yet.
    pub(crate) fn check_start(&self, service: &impl PortFactory) -> Result<(), ConnectError> {
        self.compare(&self.initial, service.attributes())
    }

    /// Opens the service if it exists and creates it otherwise, so that the order in which processes start does not
    /// matter.
    pub(crate) fn open_or_create<P: PortFactory, O: Display, C: Display>(
        &self,
        open: impl Fn() -> Result<P, O>,
        create: impl Fn(&AttributeSpecifier) -> Result<P, C>,
    ) -> Result<P, ConnectError> {
        let all = self.attributes.iter().chain(&self.initial);
        let attributes = all.fold(AttributeSpecifier::new(), |attributes, (key, value)| {
            attributes.define(&attribute_key(key), &attribute_value(value)).expect("there is room for eight attributes")
        });
        self.retry(|| match open() {
            Ok(service) => self.check(service.attributes()).map(|()| service).map_err(Obstacle::Permanent),
            Err(cause) if self.exists()? => Err(self.temporary("open", cause)),
            Err(_) => create(&attributes).map_err(|cause| Obstacle::Incomplete(self.memory_error("create", cause))),
        })
    }

    /// Opens the service if it exists.
    pub(crate) fn open<P: PortFactory, O: Display>(&self, open: impl Fn() -> Result<P, O>) -> Result<P, ConnectError> {
        self.retry(|| match open() {
            Ok(service) => self.check(service.attributes()).map(|()| service).map_err(Obstacle::Permanent),
            Err(cause) if self.exists()? => Err(self.temporary("open", cause)),
            Err(_) => Err(Obstacle::Permanent(self.instance.no_controller())),
        })
    }

    /// Creates the only port of its kind, which makes this process the `role`. Its predecessor may take a moment to
    /// disconnect: then creating it fails with `taken` for a while.
    pub(crate) fn claim<T, E: Display + PartialEq>(
        &self,
        role: Role,
        taken: E,
        service: &impl PortFactory,
        create: impl Fn() -> Result<T, E>,
    ) -> Result<T, ConnectError> {
        self.retry(|| {
            create().map_err(|cause| {
                if cause == taken {
                    service.blocking_cleanup_dead_nodes(RETRY_INTERVAL);
                    let instance = self.instance.name().to_string();
                    Obstacle::Temporary(ConnectError::AlreadyRunning { role: role.name(), instance })
                } else {
                    self.temporary("connect to", cause)
                }
            })
        })
    }

    /// An error with the reason given by iceoryx2.
    pub(crate) fn memory_error(&self, action: &'static str, cause: impl Display) -> ConnectError {
        ConnectError::Memory { action, what: self.name.to_string(), cause: cause.to_string() }
    }

    fn temporary(&self, action: &'static str, cause: impl Display) -> Obstacle {
        Obstacle::Temporary(self.memory_error(action, cause))
    }

    /// Attempts until success, a permanent obstacle or the timeout.
    fn retry<T>(&self, attempt: impl Fn() -> Result<T, Obstacle>) -> Result<T, ConnectError> {
        let began = Instant::now();
        // A single attempt may take longer than the timeout: iceoryx2 waits for others by itself.
        let mut removed_at: Option<Instant> = None;
        loop {
            match attempt() {
                Ok(value) => return Ok(value),
                Err(Obstacle::Permanent(error)) => return Err(error),
                Err(Obstacle::Temporary(error)) if began.elapsed() >= TIMEOUT => return Err(error),
                Err(Obstacle::Incomplete(error)) if removed_at.is_some_and(|at| at.elapsed() >= TIMEOUT) => {
                    return Err(error);
                }
                Err(Obstacle::Incomplete(_)) if began.elapsed() >= INCOMPLETE_TIMEOUT => {
                    self.remove_incomplete();
                    removed_at.get_or_insert_with(Instant::now);
                }
                Err(Obstacle::Temporary(_) | Obstacle::Incomplete(_)) => {}
            }
            std::thread::sleep(RETRY_INTERVAL);
        }
    }

    /// Removes the file by which the service exists. The other files of a killed process have unique names and are
    /// removed with the instance's other leftovers.
    fn remove_incomplete(&self) {
        // If this fails, so does the next attempt to create the service, with a reason.
        let _ = std::fs::remove_file(self.file());
    }

    /// The file by which the service exists.
    fn file(&self) -> PathBuf {
        let hash = ServiceHash::new::<<Ipc as Service>::ServiceNameHasher>(&self.name, self.pattern);
        let global = &self.instance.config().global;
        let file = format!("{}{}{}", global.prefix, hash, global.service.static_config_storage_suffix);
        PathBuf::from(global.service_dir().to_string()).join(file)
    }

    /// Whether the service exists. A service of another version may have layouts that cannot be opened, so attributes
    /// are compared here too.
    fn exists(&self) -> Result<bool, Obstacle> {
        match Ipc::details(&self.name, self.instance.config(), self.pattern) {
            Ok(Some(details)) => {
                self.check(details.static_details.attributes()).map_err(Obstacle::Permanent)?;
                Ok(details.dynamic_details.is_some())
            }
            Ok(None) | Err(_) => Ok(false),
        }
    }

    fn check(&self, attributes: &AttributeSet) -> Result<(), ConnectError> {
        self.compare(&self.attributes, attributes)
    }

    fn compare(&self, own: &[(&'static str, String)], attributes: &AttributeSet) -> Result<(), ConnectError> {
        for (key, ours) in own {
            let theirs = attributes.key_value(&attribute_key(key), 0);
            if theirs.is_none_or(|theirs| *theirs != attribute_value(ours)) {
                return Err(ConnectError::Mismatch {
                    service: self.name.to_string(),
                    key,
                    ours: ours.clone(),
                    theirs: theirs.map_or("none".to_owned(), ToString::to_string),
                });
            }
        }
        Ok(())
    }
}

/// Why an attempt failed.
enum Obstacle {
    /// Another process may just be disconnecting.
    Temporary(ConnectError),
    /// The service can neither be opened, because it is incomplete, nor created, because parts of it exist.
    Incomplete(ConnectError),
    /// Another attempt would not help.
    Permanent(ConnectError),
}

fn attribute_key(key: &str) -> AttributeKey {
    key.try_into().expect("a key is a short word")
}

fn attribute_value(value: &str) -> AttributeValue {
    value.try_into().expect("a value is a number")
}

#[cfg(test)]
mod tests {
    use std::fs::DirBuilder;
    use std::os::unix::fs::DirBuilderExt;

    use super::*;
    use crate::ControllerPorts;

    /// iceoryx2 may name its files otherwise in another version: then nothing incomplete would be removed any more.
    #[test]
    fn a_service_exists_by_the_file_that_is_removed_if_it_is_incomplete() {
        let base = std::env::temp_dir().join(format!("contract-{}", std::process::id()));
        DirBuilder::new().mode(0o700).create(&base).unwrap();
        let instance = Instance::new_in("contract", &base).unwrap();
        let leftovers = instance.leftovers();
        let controller = ControllerPorts::connect(&instance, 1).unwrap();
        for (service, pattern) in [
            ("setpoint", MessagingPattern::Blackboard),
            ("measurement", MessagingPattern::Blackboard),
            ("report", MessagingPattern::PublishSubscribe),
            ("request", MessagingPattern::RequestResponse),
        ] {
            let contract = ServiceContract::new(&instance, service, pattern, None);
            assert!(contract.file().is_file(), "{}", contract.file().display());
        }
        drop((controller, leftovers));
        std::fs::remove_dir_all(&base).unwrap();
    }
}
