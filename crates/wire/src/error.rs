//! What can go wrong on the way.

/// Why an end could not be connected to an instance.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConnectError {
    /// The instance's name cannot be part of a file name everywhere.
    #[error("instance name `{name}` is not usable: {reason}; write 1 to 32 of a–z, 0–9, _ and -, e.g. `robot-1`")]
    BadName {
        /// As it was given.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// There is one controller and one plant per instance.
    #[error(
        "another {role} is already running on instance `{instance}`; stop it or choose another instance (--instance NAME)"
    )]
    AlreadyRunning {
        /// `controller` or `plant`.
        role: &'static str,
        /// The instance's name.
        instance: String,
    },
    /// Whoever is there speaks another version or means another robot.
    #[error(
        "service `{service}` has {key} {theirs}, this process has {key} {ours}; {}",
        match *key {
            "protocol" => "run the same version of halfstep on both sides",
            "rate_hz" => "start both sides with the same realtime.toml",
            _ => "start both sides with the same mechanism file",
        }
    )]
    Mismatch {
        /// The service's full name.
        service: String,
        /// `protocol`, `mechanism` or `rate_hz`.
        key: &'static str,
        /// This process's value.
        ours: String,
        /// The value that the service was created with, or `none`.
        theirs: String,
    },
    /// Nobody to talk to.
    #[error(
        "no controller is running on instance `{instance}`; start one with `halfstep controller --instance {instance}`"
    )]
    NoController {
        /// The instance's name.
        instance: String,
    },
    /// The other side has outlived too many killed partners.
    #[error(
        "service `{service}` is used up: {} processes that wrote to it were killed while its reader went on; restart the reader too",
        crate::NEWEST_SLOTS
    )]
    UsedUp {
        /// The service's full name.
        service: String,
    },
    /// The memory of the instance could not be used.
    #[error("cannot {action} `{what}`: {cause}{}", hint(cause))]
    Memory {
        /// `open`, `create`, …
        action: &'static str,
        /// A service or a path.
        what: String,
        /// In the words of whoever refused.
        cause: String,
    },
}

fn hint(cause: &str) -> &'static str {
    if cause.contains("Permission") { " (all processes of an instance must run as the same user)" } else { "" }
}

/// Why a request was not answered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AskError {
    /// Nobody to talk to.
    #[error("no controller is running on instance `{instance}` any more; the request was not answered")]
    NoController {
        /// The instance's name.
        instance: String,
    },
    /// The controller looked at the request and dropped it, which it never should.
    #[error("the controller dropped the request without an answer")]
    Dropped,
    /// Too many questions at once.
    #[error("{limit} requests are unanswered already; read the answers before asking more")]
    TooMany {
        /// The limit for one operator.
        limit: usize,
    },
    /// The controller is there but has not answered.
    #[error("the controller did not answer within {seconds} s")]
    TimedOut {
        /// How long was waited [s], as text.
        seconds: String,
    },
    /// The shared memory failed.
    #[error(transparent)]
    Wire(#[from] WireFault),
}

/// The shared memory failed while connected: it was removed by force, or memory has run out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot {action}: {cause}")]
pub struct WireFault {
    /// What was tried.
    pub action: &'static str,
    /// In the words of whoever refused.
    pub cause: String,
}
