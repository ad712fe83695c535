//! The path of a stop that needs neither shared memory nor a place among the operators: a socket in the instance's
//! folder.
//!
//! An operator needs memory, one of a limited number of places, and the lock under which processes connect. Whoever
//! fills the memory, takes all places, or hangs while connecting must not keep a stop from the controller. A stop sent
//! through the socket is one datagram, and its reply another: the protocol number, then the message.

use std::fs::File;
use std::io::ErrorKind;
use std::os::fd::AsRawFd;
use std::os::linux::net::SocketAddrExt;
use std::os::unix::net::{SocketAddr, UnixDatagram};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use crate::{
    ConnectError, FieldValue, Instance, ReplyMessage, RequestError, RequestMessage, TransportError, WireLayout,
    runtime_folder, shared_memory,
};

/// Name of the socket in the instance's folder.
const FILE: &str = "urgent";
/// Room for any message of the socket (bytes).
const SIZE: usize = 1024;

/// The controller's end.
#[derive(Debug)]
pub(crate) struct UrgentServer {
    socket: Arc<UnixDatagram>,
    path: PathBuf,
    protocol: u32,
}

/// The means to reply to a stop that came through the socket.
#[derive(Debug)]
pub(crate) struct UrgentResponder {
    socket: Arc<UnixDatagram>,
    sender: SocketAddr,
    protocol: u32,
}

/// Sends a stop past everything: it needs no shared memory and no place among the operators.
#[derive(Debug)]
pub struct UrgentClient {
    socket: UnixDatagram,
    instance: String,
    protocol: u32,
}

/// The path of the socket, short enough for any folder: through the opened folder.
fn path_through(folder: &File) -> PathBuf {
    PathBuf::from(format!("/proc/self/fd/{}/{FILE}", folder.as_raw_fd()))
}

fn encode(protocol: u32, message: &impl WireLayout) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(SIZE);
    protocol.encode(&mut bytes);
    message.encode(&mut bytes);
    bytes
}

/// The protocol, and the message if it is one of this version.
fn decode<M: WireLayout>(mut bytes: &[u8]) -> Option<(u32, Option<M>)> {
    let protocol = u32::decode(&mut bytes)?;
    Some((protocol, M::decode(bytes)))
}

impl UrgentServer {
    /// Takes the place of a former controller; this one must be the only one.
    pub(crate) fn bind(instance: &Instance) -> Result<Self, ConnectError> {
        let failed = |cause| instance.memory_error("listen for urgent requests of", cause);
        let folder = runtime_folder::open_own(instance.folder()).map_err(failed)?;
        let path = instance.folder().join(FILE);
        // What a killed controller has left.
        let _ = std::fs::remove_file(&path);
        let socket = UnixDatagram::bind(path_through(&folder)).map_err(failed)?;
        socket.set_nonblocking(true).map_err(failed)?;
        Ok(Self { socket: Arc::new(socket), path, protocol: instance.protocol() })
    }

    /// The next stop. Anything else is dropped: it may take the usual way.
    pub(crate) fn receive(&self) -> Option<(RequestMessage, UrgentResponder)> {
        let mut bytes = [0; SIZE];
        loop {
            let (length, sender) = self.socket.recv_from(&mut bytes).ok()?;
            let Some((protocol, message)) = decode::<RequestMessage>(&bytes[..length]) else { continue };
            let is_stop = |message: &RequestMessage| {
                message.checked().is_ok_and(|request| request.is_stop() && request.not_before == 0)
            };
            if let Some(message) = message.filter(|message| protocol == self.protocol && is_stop(message)) {
                let socket = Arc::clone(&self.socket);
                return Some((message, UrgentResponder { socket, sender, protocol }));
            }
        }
    }
}

impl Drop for UrgentServer {
    fn drop(&mut self) {
        // A leftover only takes a name.
        let _ = std::fs::remove_file(&self.path);
    }
}

impl UrgentResponder {
    /// Sends the reply; `false` if the operator has gone.
    pub(crate) fn reply(&self, reply: &ReplyMessage) -> bool {
        self.socket.send_to_addr(&encode(self.protocol, reply), &self.sender).is_ok()
    }
}

impl UrgentClient {
    /// Connects to the socket of an instance's controller. Nothing is created in shared memory.
    ///
    /// # Errors
    /// There is no controller, or the system refuses.
    pub fn connect(instance: &Instance) -> Result<Self, ConnectError> {
        let failed = |cause: std::io::Error| match cause.kind() {
            ErrorKind::NotFound | ErrorKind::ConnectionRefused => instance.no_controller(),
            _ => instance.memory_error("send an urgent request to", cause),
        };
        // The controller may wait for a client that was killed. This one must not wait.
        shared_memory::remove_half_made(&instance.prefix(), Duration::ZERO);
        let folder = runtime_folder::open_own(instance.folder()).map_err(failed)?;
        let socket = own_socket().map_err(|cause| instance.memory_error("send an urgent request to", cause))?;
        // From now on only the controller's messages arrive.
        socket.connect(path_through(&folder)).map_err(failed)?;
        Ok(Self { socket, instance: instance.name().to_string(), protocol: instance.protocol() })
    }

    /// Sends a stop for at once, and waits for the reply.
    ///
    /// # Errors
    /// The controller has gone, is of another version, or takes longer than `timeout`.
    pub fn stop(&self, request: &RequestMessage, timeout: Duration) -> Result<ReplyMessage, RequestError> {
        let failed = |cause: std::io::Error| match cause.kind() {
            ErrorKind::WouldBlock | ErrorKind::TimedOut => {
                RequestError::TimedOut { seconds: timeout.as_secs_f64().to_string() }
            }
            ErrorKind::ConnectionRefused | ErrorKind::ConnectionReset | ErrorKind::NotConnected => {
                RequestError::NoController { instance: self.instance.clone() }
            }
            _ => TransportError { action: "send an urgent request", cause: cause.to_string() }.into(),
        };
        self.socket.set_write_timeout(Some(timeout)).map_err(failed)?;
        self.socket.set_read_timeout(Some(timeout)).map_err(failed)?;
        self.socket.send(&encode(self.protocol, request)).map_err(failed)?;
        let mut bytes = [0; SIZE];
        let length = self.socket.recv(&mut bytes).map_err(failed)?;
        match decode(&bytes[..length]) {
            Some((protocol, Some(reply))) if protocol == self.protocol => Ok(reply),
            _ => Err(RequestError::Dropped),
        }
    }
}

/// A socket with a name of its own, to which replies can be sent. The name lies in no folder and ends with the process.
fn own_socket() -> std::io::Result<UnixDatagram> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    /// Names to try: another user may have taken some.
    const NAMES: u32 = 100;
    for _ in 0..NAMES {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("halfstep-urgent-{}-{number}", std::process::id());
        match UnixDatagram::bind_addr(&SocketAddr::from_abstract_name(name)?) {
            Err(error) if error.kind() == ErrorKind::AddrInUse => {}
            bound => return bound,
        }
    }
    Err(ErrorKind::AddrInUse.into())
}
