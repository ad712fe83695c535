//! Why a process cannot connect or exchange messages.

use std::fmt;

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
            "clock" => "start both sides with --lockstep, or both without it",
            "start" => "start both sides with --from-stand, or both without it",
            _ => "start both sides with the same mechanism file",
        }
    )]
    Mismatch {
        /// The service's full name.
        service: String,
        /// `protocol`, `mechanism`, `rate_hz`, `clock` or `start`.
        key: &'static str,
        /// This process's value.
        ours: String,
        /// The value that the service was created with, or `none`.
        theirs: String,
    },
    /// The instance has no controller.
    #[error(
        "no controller is running on instance `{instance}`; start one with `halfstep controller --instance \
         {instance}`{elsewhere}"
    )]
    NoController {
        /// The instance's name.
        instance: String,
        /// Where else an instance of this name has files.
        elsewhere: Elsewhere,
    },
    /// No more operators can connect.
    #[error(
        "{max} operators are connected to instance `{instance}`, as many as can be{}; end one of them. \
         `halfstep send stop` gets through all the same",
        listed(processes)
    )]
    Full {
        /// Most operators at a time.
        max: usize,
        /// The instance's name.
        instance: String,
        /// Ids of the processes that are connected.
        processes: Vec<u32>,
    },
    /// Shared memory has no room for another process.
    #[error(
        "shared memory (/dev/shm) has no room for this {role}: it needs {}, and {} are free; remove other files there, \
         or give it more (in a container: docker run --shm-size=256m)",
        mebibytes(*needed),
        mebibytes(*free)
    )]
    NoRoom {
        /// What the process would be: `controller`, `plant`, `operator` or `observer`.
        role: &'static str,
        /// Memory that it needs (bytes).
        needed: u64,
        /// Memory that is free (bytes).
        free: u64,
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

/// Where an instance has files that this process does not use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elsewhere {
    /// Nowhere else.
    Nowhere,
    /// An instance of the same name belongs to the user with this id.
    OtherUser(u32),
    /// This user has an instance of the same name in another runtime folder.
    OtherFolder,
}

impl fmt::Display for Elsewhere {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Elsewhere::Nowhere => Ok(()),
            Elsewhere::OtherUser(0) => write!(out, ". root runs an instance of this name: use the same user"),
            Elsewhere::OtherUser(user) => {
                write!(out, ". The user with the id {user} runs an instance of this name: use the same user")
            }
            Elsewhere::OtherFolder => {
                write!(out, ". You run an instance of this name with another XDG_RUNTIME_DIR: use the same one")
            }
        }
    }
}

/// The first processes of a list, as a part of a sentence.
fn listed(processes: &[u32]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = processes.iter().take(SHOWN).map(u32::to_string).collect();
    let more = if processes.len() > SHOWN { ", …" } else { "" };
    if shown.is_empty() { String::new() } else { format!(" (processes {}{more})", shown.join(", ")) }
}

fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / f64::from(1 << 20))
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

/// Why a push was not answered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PushError {
    /// The instance has no plant that can be pushed.
    #[error("no simulated robot that can be pushed is running on instance `{instance}`")]
    NoPlant {
        /// The instance's name.
        instance: String,
    },
    /// The plant has ended meanwhile.
    #[error("the plant has ended without an answer")]
    Dropped,
    /// The plant is running but has not replied in time.
    #[error("the plant did not answer within {seconds} s")]
    TimedOut {
        /// The timeout (s), as text.
        seconds: String,
    },
    /// There is no connection to the plant.
    #[error(transparent)]
    Connect(ConnectError),
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
