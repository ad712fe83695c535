//! An instance: the name of one robot, and the memory that its processes share.

use std::fmt;
use std::fs::{DirEntry, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Once;

use iceoryx2::prelude::{
    CallbackProgression, Config, FileName, LogLevel, Node, NodeBuilder, NodeName, NodeState, Path, SemanticString,
    ServiceName, SignalHandlingMode, set_log_level_from_env_or,
};

use crate::connect_lock::ConnectLock;
use crate::runtime_folder;
use crate::{ConnectError, DEFAULT_RATE_HZ, Ipc, PROTOCOL};

/// Folder of POSIX shared memory on Linux.
const SHARED_MEMORY: &str = "/dev/shm";

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

/// One robot: its name, and where its shared memory lies.
#[derive(Clone, Debug)]
pub struct Instance {
    name: InstanceName,
    protocol: u32,
    rate_hz: u32,
    root: PathBuf,
    config: Config,
}

impl Instance {
    /// The instance called `name`. Nothing is created yet.
    ///
    /// # Errors
    /// The name is not usable, or the path of the temporary folder is too long.
    pub fn new(name: &str) -> Result<Self, ConnectError> {
        let name: InstanceName = name.parse()?;
        let root = runtime_folder::of_user().join(name.as_str());

        // Not read from a file: all processes of an instance must agree, wherever they were started.
        let mut config = Config::default();
        let no_path = |cause: &dyn fmt::Debug| ConnectError::Memory {
            action: "use the folder",
            what: root.display().to_string(),
            cause: format!("{cause:?}"),
        };
        // A dot cannot be part of a name, so that no instance's files begin like another's. An instance of the same
        // name of another user, or in another folder, is another one.
        let prefix = format!("halfstep.{:016x}.{name}.", fnv_1a(root.as_os_str().as_encoded_bytes()));
        config.global.prefix = FileName::new(prefix.as_bytes()).map_err(|cause| no_path(&cause))?;
        config.global.set_root_path(&Path::new(root.as_os_str().as_encoded_bytes()).map_err(|cause| no_path(&cause))?);
        Ok(Self { name, protocol: PROTOCOL, rate_hz: DEFAULT_RATE_HZ, root, config })
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

    /// The folder of the instance's files.
    pub fn folder(&self) -> &std::path::Path {
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

    /// Removes everything that former processes have left behind: killed ones much, cleanly exited ones a few bytes.
    /// While any process is connected, only the leftovers of dead processes are removed. Too slow for the control loop.
    ///
    /// # Errors
    /// The folder of the instance cannot be read or removed.
    pub fn remove_leftovers(&self) -> Result<(), ConnectError> {
        let _lock = self.connect_lock()?;
        let mut in_use = false;
        Node::<Ipc>::list(&self.config, |state| {
            match state {
                NodeState::Alive(_) | NodeState::Inaccessible(_) => in_use = true,
                // If it fails, the files are removed below or by the next attempt.
                NodeState::Dead(dead) => drop(dead.try_remove_stale_resources()),
                // The process was killed while it connected.
                NodeState::Undefined(_) => {}
            }
            CallbackProgression::Continue
        })
        .map_err(|cause| self.memory_error("list the processes of", cause))?;
        if in_use {
            return Ok(());
        }

        for file in self.files_in_shared_memory()? {
            removed(std::fs::remove_file(file)).map_err(|cause| self.memory_error("remove the files of", cause))?;
        }
        removed(std::fs::remove_dir_all(&self.root)).map_err(|cause| self.memory_error("remove the files of", cause))
    }

    /// A guard that removes the leftovers when it is dropped: for tests, and for instance names that are used once.
    pub fn leftovers(&self) -> Leftovers {
        Leftovers(self.clone())
    }

    pub(crate) fn protocol(&self) -> u32 {
        self.protocol
    }

    pub(crate) fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    pub(crate) fn config(&self) -> &Config {
        &self.config
    }

    /// Waits until this process may connect.
    pub(crate) fn connect_lock(&self) -> Result<ConnectLock, ConnectError> {
        silence_log();
        ConnectLock::acquire(&self.root).map_err(|cause| self.memory_error("connect to the instance", cause))
    }

    /// Connects to the instance, and cleans up after processes that died in it. Needs the lock.
    pub(crate) fn open_node(&self, _lock: &ConnectLock, role: &str) -> Result<Node<Ipc>, ConnectError> {
        let node = NodeBuilder::new()
            .name(&NodeName::new(role).expect("a role is a short word"))
            .config(&self.config)
            // Signals belong to the process, not to a library.
            .signal_handling_mode(SignalHandlingMode::Disabled)
            .create()
            .map_err(|cause| self.memory_error("join the instance", cause))?;
        // One of iceoryx2's own files is open to everyone.
        for file in self.files_in_shared_memory()? {
            let _ = std::fs::set_permissions(file, Permissions::from_mode(0o600));
        }
        Ok(node)
    }

    /// The instance's files in shared memory.
    fn files_in_shared_memory(&self) -> Result<Vec<PathBuf>, ConnectError> {
        let prefix = self.prefix();
        let files = std::fs::read_dir(SHARED_MEMORY).map_err(|cause| self.memory_error("read the files of", cause))?;
        let is_ours = |file: &DirEntry| file.file_name().as_encoded_bytes().starts_with(prefix.as_bytes());
        Ok(files.flatten().filter(is_ours).map(|file| file.path()).collect())
    }

    pub(crate) fn service_name(&self, service: &str) -> ServiceName {
        let name = format!("halfstep/{}/{service}", self.name);
        ServiceName::new(&name).expect("an instance's name is short and plain")
    }

    pub(crate) fn no_controller(&self) -> ConnectError {
        ConnectError::NoController { instance: self.name.to_string() }
    }

    fn memory_error(&self, action: &'static str, cause: impl fmt::Display) -> ConnectError {
        ConnectError::Memory { action, what: self.name.to_string(), cause: cause.to_string() }
    }
}

/// Removes what is left of an instance when dropped; see [`Instance::remove_leftovers`].
#[derive(Debug)]
#[must_use = "dropping it removes the leftovers at once"]
pub struct Leftovers(Instance);

impl Drop for Leftovers {
    fn drop(&mut self) {
        // A destructor cannot return the error; leftovers only take space.
        let _ = self.0.remove_leftovers();
    }
}

/// The FNV-1a hash of some bytes, 64 bits.
fn fnv_1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// The result of a removal: what is already gone needs none.
fn removed(result: std::io::Result<()>) -> std::io::Result<()> {
    match result {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        result => result,
    }
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
