//! Why a controller in another process could not be commanded.

use wire::{ConnectError, MessageFault, RequestError, TransportError};

/// Why a controller in another process could not be commanded.
#[derive(Debug, thiserror::Error)]
pub enum OperatorError {
    /// There is no connection to the controller.
    #[error(transparent)]
    Connect(#[from] ConnectError),
    /// A request could not be sent or got no reply.
    #[error(transparent)]
    Ask(#[from] RequestError),
    /// Shared memory failed.
    #[error(transparent)]
    Wire(#[from] TransportError),
    /// The controller's reply is invalid.
    #[error(transparent)]
    Reply(#[from] MessageFault),
}
