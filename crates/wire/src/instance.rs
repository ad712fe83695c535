//! An instance: the name of one robot, and the memory that its processes share.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Once;

use iceoryx2::node::NodeView;
use iceoryx2::prelude::{
    CallbackProgression, Config, FileName, LogLevel, Node, NodeBuilder, NodeName, NodeState, SemanticString,
    ServiceName, SignalHandlingMode, set_log_level_from_env_or,
};
use rustix::process::getuid;

use crate::connect_lock::ConnectLock;
use crate::shared_memory::{self, Role};
use crate::{ConnectError, DEFAULT_RATE_HZ, Elsewhere, Ipc, PROTOCOL, runtime_folder};

/// Name of an instance: 1 to 32 characters of `a`–`z`, `0`–`9`, `_` and `-`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct InstanceName(String);

impl InstanceName {
    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for InstanceName {
    type Err = ConnectError;

    fn from_str(name: &str) -> Result<Self, ConnectError> {
        let usable = |character: &char| matches!(character, 'a'..='z' | '0'..='9' | '_' | '-');
        let reason = match (name.chars().count(), name.chars().find(|character| !usable(character))) {
            (0, _) => "it is empty".to_owned(),
            (_, Some(character)) => format!("it contains {character:?}"),
            (length @ 33.., None) => format!("it has {length} characters"),
            (1..33, None) => return Ok(Self(name.to_owned())),
        };
        Err(ConnectError::BadName { name: name.to_owned(), reason })
    }
}

impl fmt::Display for InstanceName {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.pad(&self.0)
    }
}

/// The clock of an instance unless it is set otherwise.
const REALTIME: &str = "realtime";
/// The clock of processes that wait for each other's messages.
pub(crate) const LOCKSTEP: &str = "lockstep";
/// The start posture of an instance unless it is set otherwise.
const STRIDE: &str = "stride";

/// One robot: its name, and where its shared memory lies.
#[derive(Clone, Debug)]
pub struct Instance {
    name: InstanceName,
    protocol: u32,
    rate_hz: u32,
    clock: &'static str,
    start: &'static str,
    root: PathBuf,
    config: Config,
}

impl Instance {
    /// The instance called `name`. Nothing is created yet.
    ///
    /// # Errors
    /// The name is not usable, or the path of the temporary folder is too long.
    pub fn new(name: &str) -> Result<Self, ConnectError> {
        Self::in_folder(name, &runtime_folder::of_user())
    }

    /// The instance called `name` as processes see it whose `$XDG_RUNTIME_DIR` is `base`, which must be this user's
    /// alone: for tests.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn new_in(name: &str, base: &Path) -> Result<Self, ConnectError> {
        Self::in_folder(name, &runtime_folder::of_user_in(base))
    }

    fn in_folder(name: &str, of_user: &Path) -> Result<Self, ConnectError> {
        let name: InstanceName = name.parse()?;
        let root = of_user.join(name.as_str());

        // Not read from a file: all processes of an instance must agree, wherever they were started.
        let mut config = Config::default();
        let no_path = |cause: &dyn fmt::Debug| ConnectError::Memory {
            action: "use the folder",
            what: root.display().to_string(),
            cause: format!("{cause:?}"),
        };
        // A dot cannot be part of a name, so that no instance's files begin like another's. An instance of the same
        // name of another user, or in another folder, is another one.
        let prefix = format!("halfstep.{}.{name}.", folder_hash(&root));
        config.global.prefix = FileName::new(prefix.as_bytes()).map_err(|cause| no_path(&cause))?;
        config.global.set_root_path(
            &iceoryx2::prelude::Path::new(root.as_os_str().as_encoded_bytes()).map_err(|cause| no_path(&cause))?,
        );
        let (protocol, rate_hz, clock, start) = (PROTOCOL, DEFAULT_RATE_HZ, REALTIME, STRIDE);
        Ok(Self { name, protocol, rate_hz, clock, start, root, config })
    }

    /// The same instance for a process with another protocol version than [`PROTOCOL`].
    pub fn with_protocol(self, protocol: u32) -> Self {
        Self { protocol, ..self }
    }

    /// The same instance for a controller or plant with `rate_hz` control periods in a second, instead of
    /// [`DEFAULT_RATE_HZ`].
    pub fn with_rate_hz(self, rate_hz: u32) -> Self {
        Self { rate_hz, ..self }
    }

    /// The same instance for a controller or plant in lockstep instead of in real time.
    pub fn with_lockstep(self, lockstep: bool) -> Self {
        Self { clock: if lockstep { LOCKSTEP } else { REALTIME }, ..self }
    }

    /// The same instance for a controller or plant that begins in a stand instead of in stride.
    pub fn with_stand(self, stands: bool) -> Self {
        Self { start: if stands { "stand" } else { STRIDE }, ..self }
    }

    /// The folder of the instance's files.
    pub fn folder(&self) -> &Path {
        &self.root
    }

    /// What the names of the instance's files in shared memory begin with.
    pub fn prefix(&self) -> String {
        self.config.global.prefix.to_string()
    }

    /// The instance's name.
    pub fn name(&self) -> &InstanceName {
        &self.name
    }

    pub(crate) fn protocol(&self) -> u32 {
        self.protocol
    }

    pub(crate) fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    pub(crate) fn clock(&self) -> &'static str {
        self.clock
    }

    pub(crate) fn start(&self) -> &'static str {
        self.start
    }

    pub(crate) fn config(&self) -> &Config {
        &self.config
    }

    /// Waits until this process may connect to an instance that must exist: nothing is created.
    pub(crate) fn connect_lock_if_there(&self) -> Result<ConnectLock, ConnectError> {
        if self.root.exists() { self.connect_lock() } else { Err(self.no_controller()) }
    }

    /// Waits until this process may connect.
    pub(crate) fn connect_lock(&self) -> Result<ConnectLock, ConnectError> {
        silence_log();
        ConnectLock::acquire(&self.root).map_err(|cause| self.memory_error("connect to the instance", cause))
    }

    /// Connects to the instance, and cleans up after processes that died in it. Needs the lock.
    pub(crate) fn open_node(&self, _lock: &ConnectLock, role: Role) -> Result<Node<Ipc>, ConnectError> {
        shared_memory::require_own(&self.prefix())?;
        shared_memory::require_room(role)?;
        NodeBuilder::new()
            .name(&NodeName::new(role.name()).expect("a role is a short word"))
            .config(&self.config)
            // Signals belong to the process, not to a library.
            .signal_handling_mode(SignalHandlingMode::Disabled)
            .create()
            .map_err(|cause| self.memory_error("join the instance", cause))
    }

    /// Takes the memory of what a process has connected to; it must still hold the lock.
    pub(crate) fn take_room(&self, _lock: &ConnectLock, role: Role) -> Result<(), ConnectError> {
        shared_memory::take_room(&self.prefix(), role)
    }

    /// Whether a controller or a plant is connected, or about to connect.
    pub fn is_in_use(&self) -> bool {
        [Role::Controller, Role::Plant].iter().any(|&role| !self.processes(role).is_empty())
    }

    /// Ids of the processes that are connected in a role.
    pub(crate) fn processes(&self, role: Role) -> Vec<u32> {
        let mut processes = Vec::new();
        // If they cannot be listed, none is named.
        let _ = Node::<Ipc>::list(&self.config, |state| {
            if let NodeState::Alive(node) = state
                && let Some(details) = node.details()
                && details.name().as_str() == role.name()
            {
                processes.push(details.process_id().value() as u32);
            }
            CallbackProgression::Continue
        });
        processes.sort_unstable();
        processes
    }

    pub(crate) fn service_name(&self, service: &str) -> ServiceName {
        let name = format!("halfstep/{}/{service}", self.name);
        ServiceName::new(&name).expect("an instance's name is short and plain")
    }

    pub(crate) fn no_controller(&self) -> ConnectError {
        ConnectError::NoController { instance: self.name.to_string(), elsewhere: self.elsewhere() }
    }

    /// Where else an instance of this name has files.
    fn elsewhere(&self) -> Elsewhere {
        let hash = folder_hash(&self.root);
        let others: Vec<_> = shared_memory::all()
            .into_iter()
            .filter(|file| file.instance == self.name.as_str() && file.folder != hash)
            .collect();
        match others.iter().find(|file| file.user != getuid().as_raw()) {
            Some(file) => Elsewhere::OtherUser(file.user),
            None if others.is_empty() => Elsewhere::Nowhere,
            None => Elsewhere::OtherFolder,
        }
    }

    pub(crate) fn memory_error(&self, action: &'static str, cause: impl fmt::Display) -> ConnectError {
        ConnectError::Memory { action, what: self.name.to_string(), cause: cause.to_string() }
    }
}

/// The hash of an instance's folder, in the names of its files in shared memory.
pub(crate) fn folder_hash(root: &Path) -> String {
    format!("{:016x}", fnv_1a(root.as_os_str().as_encoded_bytes()))
}

/// The FNV-1a hash of some bytes, 64 bits.
fn fnv_1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Silences iceoryx2, which logs every refusal that we report ourselves; `IOX2_LOG_LEVEL` overrides it.
fn silence_log() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| set_log_level_from_env_or(LogLevel::Fatal));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a() {
        // Vectors of the draft-eastlake-fnv.
        assert_eq!(fnv_1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv_1a(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_bad_name_is_refused_with_what_is_wrong_and_what_would_be_right() {
        let text = |name: &str| Instance::new(name).unwrap_err().to_string();
        assert_eq!(
            text("Robot 1"),
            "instance name `Robot 1` is not usable: it contains 'R'; \
             write 1 to 32 of a–z, 0–9, _ and -, e.g. `robot-1`"
        );
        assert!(text("").contains("it is empty"));
        assert!(text(&"a".repeat(33)).contains("it has 33 characters"));
        assert!(text("../etc").contains("it contains '.'"));
        assert!(text("a/b").contains("it contains '/'"));
        assert!(text("größe").contains("it contains 'ö'"));
        assert!(Instance::new(&"a".repeat(32)).is_ok());
        assert!(Instance::new("robot_1-b").is_ok());
    }
}
