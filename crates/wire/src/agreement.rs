//! Agreement: a service is opened or created, and both sides must mean the same by it.

use std::fmt::Display;
use std::time::{Duration, Instant};

use iceoryx2::prelude::{AttributeSet, AttributeSpecifier, MessagingPattern, PortFactory, Service, ServiceName};
use iceoryx2::service::attribute::{AttributeKey, AttributeValue};
use iceoryx2::service::service_hash::ServiceHash;

use crate::{ConnectError, Instance, Ipc, RATE_HZ};

/// How long a process that is just leaving may stand in the way.
const PATIENCE: Duration = Duration::from_secs(1);
/// After how long something half there is not on its way out, but was left by a process killed while it made it.
const PATIENCE_WITH_HALF_MADE: Duration = Duration::from_millis(300);
const PAUSE: Duration = Duration::from_millis(5);

/// Key of the periods in a second.
const RATE: &str = "rate_hz";

/// The periods in a second that a service was created for [Hz].
pub(crate) fn rate_hz(service: &impl PortFactory) -> u32 {
    let told = service.attributes().key_value(&attribute_key(RATE), 0);
    // Whoever speaks this protocol tells.
    told.and_then(|told| told.to_string().parse().ok()).unwrap_or(RATE_HZ)
}

/// A service of an instance, with what both sides must agree on.
pub(crate) struct Agreement<'a> {
    instance: &'a Instance,
    pattern: MessagingPattern,
    pub name: ServiceName,
    terms: Vec<(&'static str, String)>,
}

impl<'a> Agreement<'a> {
    /// `mechanism` where joint numbers are exchanged.
    pub fn new(
        instance: &'a Instance,
        service: &'static str,
        pattern: MessagingPattern,
        mechanism: Option<u64>,
    ) -> Self {
        let mut terms = vec![("protocol", instance.protocol().to_string())];
        terms.extend(mechanism.map(|fingerprint| ("mechanism", format!("{fingerprint:#018x}"))));
        Self { instance, pattern, name: instance.service_name(service), terms }
    }

    /// The same for a side that counts the periods: both must count the same ones.
    pub fn at_rate(mut self) -> Self {
        self.terms.push((RATE, self.instance.rate_hz().to_string()));
        self
    }

    /// Opens the service if it is there and creates it if it is not, so that the order in which processes start does
    /// not matter.
    pub fn open_or_create<P: PortFactory, O: Display, C: Display>(
        &self,
        open: impl Fn() -> Result<P, O>,
        create: impl Fn(&AttributeSpecifier) -> Result<P, C>,
    ) -> Result<P, ConnectError> {
        let terms = self.terms.iter().fold(AttributeSpecifier::new(), |terms, (key, value)| {
            terms.define(&attribute_key(key), &attribute_value(value)).expect("there is room for eight attributes")
        });
        self.patiently(|| match open() {
            Ok(service) => self.check(service.attributes()).map(|()| service).map_err(Obstacle::Lasting),
            Err(cause) if self.exists()? => Err(self.passing("open", cause)),
            Err(_) => create(&terms).map_err(|cause| Obstacle::HalfMade(self.memory("create", cause))),
        })
    }

    /// Opens the service if it is there.
    pub fn open<P: PortFactory, O: Display>(&self, open: impl Fn() -> Result<P, O>) -> Result<P, ConnectError> {
        self.patiently(|| match open() {
            Ok(service) => self.check(service.attributes()).map(|()| service).map_err(Obstacle::Lasting),
            Err(cause) if self.exists()? => Err(self.passing("open", cause)),
            Err(_) => Err(Obstacle::Lasting(self.instance.no_controller())),
        })
    }

    /// Tries until it succeeds or fails for good. The only instance of `role` may take a moment to leave.
    pub fn only_one<T, E: Display + PartialEq>(
        &self,
        role: &'static str,
        taken: E,
        service: &impl PortFactory,
        take: impl Fn() -> Result<T, E>,
    ) -> Result<T, ConnectError> {
        self.patiently(|| {
            take().map_err(|cause| {
                if cause == taken {
                    service.blocking_cleanup_dead_nodes(PAUSE);
                    let instance = self.instance.name().to_string();
                    Obstacle::Passing(ConnectError::AlreadyRunning { role, instance })
                } else {
                    self.passing("connect to", cause)
                }
            })
        })
    }

    /// An error in the words of iceoryx2.
    pub fn memory(&self, action: &'static str, cause: impl Display) -> ConnectError {
        ConnectError::Memory { action, what: self.name.to_string(), cause: cause.to_string() }
    }

    fn passing(&self, action: &'static str, cause: impl Display) -> Obstacle {
        Obstacle::Passing(self.memory(action, cause))
    }

    fn patiently<T>(&self, attempt: impl Fn() -> Result<T, Obstacle>) -> Result<T, ConnectError> {
        let began = Instant::now();
        loop {
            match attempt() {
                Ok(value) => return Ok(value),
                Err(Obstacle::Lasting(error)) => return Err(error),
                Err(Obstacle::Passing(error)) if began.elapsed() >= PATIENCE => return Err(error),
                Err(Obstacle::HalfMade(error)) if began.elapsed() >= PATIENCE => return Err(error),
                Err(Obstacle::HalfMade(_)) if began.elapsed() >= PATIENCE_WITH_HALF_MADE => self.remove_half_made(),
                Err(Obstacle::Passing(_) | Obstacle::HalfMade(_)) => {}
            }
            std::thread::sleep(PAUSE);
        }
    }

    /// Removes the file that says that the service exists. The rest of what a killed process made has unique names, and
    /// goes with the instance's other leftovers.
    fn remove_half_made(&self) {
        let hash = ServiceHash::new::<<Ipc as Service>::ServiceNameHasher>(&self.name, self.pattern);
        let global = &self.instance.config().global;
        let file = format!("{}{}{}", global.prefix, hash, global.service.static_config_storage_suffix);
        // If this fails, so does the next attempt to create the service, which says why.
        let _ = std::fs::remove_file(std::path::Path::new(&global.service_dir().to_string()).join(file));
    }

    /// Whether the service exists. Another version may have layouts that cannot be opened, so terms are compared here
    /// too.
    fn exists(&self) -> Result<bool, Obstacle> {
        match Ipc::details(&self.name, self.instance.config(), self.pattern) {
            Ok(Some(details)) => {
                self.check(details.static_details.attributes()).map_err(Obstacle::Lasting)?;
                Ok(details.dynamic_details.is_some())
            }
            Ok(None) | Err(_) => Ok(false),
        }
    }

    fn check(&self, attributes: &AttributeSet) -> Result<(), ConnectError> {
        for (key, ours) in &self.terms {
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
    /// Somebody may just be leaving.
    Passing(ConnectError),
    /// The service cannot be opened because it is not all there, and not created because something is.
    HalfMade(ConnectError),
    /// Trying again would not help.
    Lasting(ConnectError),
}

fn attribute_key(key: &str) -> AttributeKey {
    key.try_into().expect("a key is a short word")
}

fn attribute_value(value: &str) -> AttributeValue {
    value.try_into().expect("a value is a number")
}
