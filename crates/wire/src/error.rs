//! Why a process cannot connect or exchange messages.

/// Why a process could not connect to an instance.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConnectError {
    /// The instance's name cannot be part of file names.
    #[error("instance name `{name}` is not usable: {reason}; write 1 to 32 of a–z, 0–9, _ and -, e.g. `robot-1`")]
    BadName {
        /// The name as it was given.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The instance has a controller, or plant, already: there is one of each.
    #[error(
        "another {role} is already running on instance `{instance}`; \
         stop it or choose another instance (--instance NAME)"
    )]
    AlreadyRunning {
        /// `controller` or `plant`.
        role: &'static str,
        /// The instance's name.
        instance: String,
    },
    /// The service was created by another version of the program, at another rate or for another robot.
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
    /// The instance has no controller.
    #[error(
        "no controller is running on instance `{instance}`; start one with `halfstep controller --instance {instance}`"
    )]
    NoController {
        /// The instance's name.
        instance: String,
    },
    /// No more operators can connect.
    #[error("{operators} operators are connected to instance `{instance}`, as many as can be; end one of them")]
    Full {
        /// The instance's name.
        instance: String,
        /// How many operators can connect.
        operators: usize,
    },
    /// A reader has outlived more killed writers than the service has places for.
    #[error(
        "service `{service}` is used up: {writers} processes that wrote to it were killed while its reader went on; \
         restart the reader too"
    )]
    UsedUp {
        /// The service's full name.
        service: String,
        /// Number of writers that were killed.
        writers: u64,
    },
    /// The memory of the instance could not be used.
    #[error("cannot {action} `{what}`: {cause}{}", hint(cause))]
    Memory {
        /// What was tried: `open`, `create`, …
        action: &'static str,
        /// Name of the service, or path of the file.
        what: String,
        /// The reason as given by iceoryx2 or the operating system.
        cause: String,
    },
}

fn hint(cause: &str) -> &'static str {
    if cause.contains("Permission") { " (all processes of an instance must run as the same user)" } else { "" }
}

/// Why a request got no reply.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RequestError {
    /// The controller has disconnected.
    #[error("no controller is running on instance `{instance}` any more; the request was not answered")]
    NoController {
        /// The instance's name.
        instance: String,
    },
    /// The controller dropped the request without a reply: a bug in the controller.
    #[error("the controller dropped the request without an answer")]
    Dropped,
    /// Too many requests of this operator are unanswered.
    #[error("{limit} requests are unanswered already; read the answers before asking more")]
    TooMany {
        /// Most unanswered requests of one operator.
        limit: usize,
    },
    /// The controller is running but has not replied in time.
    #[error("the controller did not answer within {seconds} s")]
    TimedOut {
        /// The timeout (s), as text.
        seconds: String,
    },
    /// The shared memory failed.
    #[error(transparent)]
    Transport(#[from] TransportError),
}

/// The shared memory failed while connected: it was removed by force, or memory has run out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot {action}: {cause}")]
pub struct TransportError {
    /// What was tried: `send a request`, …
    pub action: &'static str,
    /// The reason as given by iceoryx2.
    pub cause: String,
}
