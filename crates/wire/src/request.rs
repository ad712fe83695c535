//! The request service: operators send requests, and the controller replies to each of them once.

use std::fmt;
use std::time::{Duration, Instant};

use iceoryx2::active_request::ActiveRequest;
use iceoryx2::pending_response::PendingResponse;
use iceoryx2::port::client::{Client, RequestSendError};
use iceoryx2::port::server::Server;
use iceoryx2::prelude::{BackpressureStrategy, MessagingPattern, Node, PortFactory as _};
use iceoryx2::service::builder::request_response::Builder;
use iceoryx2::service::port_factory::client::ClientCreateError;
use iceoryx2::service::port_factory::request_response::PortFactory;
use iceoryx2::service::port_factory::server::ServerCreateError;

use crate::service_contract::ServiceContract;
use crate::shared_memory::Role;
use crate::urgent_socket::{UrgentResponder, UrgentServer};
use crate::{ConnectError, Instance, Ipc, ReplyMessage, RequestError, RequestMessage, TransportError};

/// Most operators at a time: more than anyone needs, so that a stop always finds a place.
pub const MAX_OPERATORS: usize = 32;
/// Most processes that may use the service at a time.
const MAX_NODES: usize = 64;
/// Most unanswered requests of one operator. The memory that an operator takes grows with its square: 0.6 MB for 32.
pub const MAX_UNANSWERED: usize = 32;

/// Time between two checks of a waiting operator for its reply.
const POLL_INTERVAL: Duration = Duration::from_millis(1);
/// Time between two checks of a waiting operator whether the controller is still alive, which cost more.
const LIVENESS_INTERVAL: Duration = Duration::from_millis(200);

type RequestService = PortFactory<Ipc, RequestMessage, (), ReplyMessage, ()>;

fn contract(instance: &Instance) -> ServiceContract<'_> {
    ServiceContract::new(instance, "request", MessagingPattern::RequestResponse, None)
}

fn builder(contract: &ServiceContract, node: &Node<Ipc>) -> Builder<RequestMessage, (), ReplyMessage, (), Ipc> {
    node.service_builder(&contract.name)
        .request_response::<RequestMessage, ReplyMessage>()
        // A later request never displaces one that was sent.
        .enable_safe_overflow_for_requests(false)
        .enable_safe_overflow_for_responses(false)
        .enable_fire_and_forget_requests(false)
        .max_active_requests_per_client(MAX_UNANSWERED)
        .max_response_buffer_size(1)
        .max_borrowed_responses_per_pending_response(1)
        .max_servers(1)
        .max_clients(MAX_OPERATORS)
        .max_nodes(MAX_NODES)
}

/// The controller's end of the request service.
#[derive(Debug)]
pub struct RequestServer {
    // First: its name is free again before another controller may connect.
    urgent: UrgentServer,
    /// Whether the next request is to be taken from the socket first: both ways take turns.
    is_urgent_next: bool,
    server: Server<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl RequestServer {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let contract = contract(instance).at_rate();
        let service: RequestService = contract.open_or_create(
            || builder(&contract, node).open(),
            |attributes| builder(&contract, node).create_with_attributes(attributes),
        )?;
        let taken = ServerCreateError::ExceedsMaxSupportedServers;
        let create = || {
            // An operator that does not read its replies must not block the controller.
            service.server_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create()
        };
        let server = contract.claim(Role::Controller, taken, &service, create)?;
        Ok(Self { urgent: UrgentServer::bind(instance)?, is_urgent_next: true, server })
    }

    /// The next request and the means to reply to it; `None` if there is none. Those of an operator come in the order
    /// in which they were sent; stops of [`UrgentClient`](crate::UrgentClient) and other requests take turns.
    ///
    /// # Errors
    /// The memory of an operator could not be reached. Later calls may succeed.
    pub fn next_request(&mut self) -> Result<Option<(RequestMessage, Responder)>, TransportError> {
        if std::mem::replace(&mut self.is_urgent_next, false)
            && let Some(urgent) = self.next_urgent()
        {
            return Ok(Some(urgent));
        }
        self.is_urgent_next = true;
        match self.server.receive() {
            Ok(Some(request)) => Ok(Some((*request, Responder(ReplyPath::SharedMemory(request))))),
            Ok(None) => Ok(self.next_urgent()),
            Err(cause) => Err(TransportError { action: "receive a request", cause: cause.to_string() }),
        }
    }

    fn next_urgent(&self) -> Option<(RequestMessage, Responder)> {
        self.urgent.receive().map(|(message, responder)| (message, Responder(ReplyPath::Socket(responder))))
    }
}

/// The means to reply to one request. It may be kept, for instance until the request takes effect. If it is dropped
/// without a reply, the operator gets [`RequestError::Dropped`].
pub struct Responder(ReplyPath);

/// The way on which a request came, and its reply goes.
enum ReplyPath {
    SharedMemory(ActiveRequest<Ipc, RequestMessage, (), ReplyMessage, ()>),
    Socket(UrgentResponder),
}

impl Responder {
    /// Whether the operator still waits for the reply. A stop that came through the socket is carried out in any case.
    pub fn is_wanted(&self) -> bool {
        match &self.0 {
            ReplyPath::SharedMemory(request) => request.is_connected(),
            ReplyPath::Socket(_) => true,
        }
    }

    /// Sends the reply; `false` if it could not be delivered because the operator has disconnected.
    pub fn reply(self, reply: &ReplyMessage) -> bool {
        match self.0 {
            ReplyPath::SharedMemory(request) => request.send_copy(*reply).is_ok(),
            ReplyPath::Socket(responder) => responder.reply(reply),
        }
    }
}

impl fmt::Debug for Responder {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("Responder").finish_non_exhaustive()
    }
}

/// An operator's end of the request service.
#[derive(Debug)]
pub struct RequestClient {
    instance: String,
    service: RequestService,
    client: Client<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl RequestClient {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let contract = contract(instance);
        let service: RequestService = contract.open(|| builder(&contract, node).open())?;
        let client =
            service.client_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create().map_err(
                |cause| match cause {
                    ClientCreateError::ExceedsMaxSupportedClients => {
                        let processes = instance.processes(Role::Operator);
                        ConnectError::Full { max: MAX_OPERATORS, instance: instance.name().to_string(), processes }
                    }
                    cause => contract.memory_error("connect to", cause),
                },
            )?;
        let client = Self { instance: instance.name().to_string(), service, client };
        if client.controller_is_there() { Ok(client) } else { Err(instance.no_controller()) }
    }

    /// Sends a request without waiting for the reply. Up to 32 requests may be unanswered at a time.
    ///
    /// # Errors
    /// No controller is running, too many requests are unanswered, or the shared memory failed.
    pub fn send(&self, request: &RequestMessage) -> Result<PendingReply, RequestError> {
        let response = self.client.send_copy(*request).map_err(|cause| match cause {
            RequestSendError::ExceedsMaxActiveRequests => RequestError::TooMany { limit: MAX_UNANSWERED },
            cause => TransportError { action: "send a request", cause: cause.to_string() }.into(),
        })?;
        if response.number_of_server_connections() == 0 {
            return Err(self.no_controller());
        }
        Ok(PendingReply { response })
    }

    /// Blocks until the reply to a request has arrived.
    ///
    /// # Errors
    /// The controller has disconnected, dropped the request, or takes longer than `timeout`.
    pub fn wait(&self, pending: &PendingReply, timeout: Duration) -> Result<ReplyMessage, RequestError> {
        let began = Instant::now();
        let mut liveness_checks = 0;
        loop {
            match pending.poll() {
                Ok(Some(reply)) => return Ok(reply),
                Ok(None) => {}
                Err(RequestError::Dropped) if !self.controller_is_there() => return Err(self.no_controller()),
                Err(error) => return Err(error),
            }
            let waited = began.elapsed();
            if waited >= LIVENESS_INTERVAL * liveness_checks {
                liveness_checks += 1;
                if !self.controller_is_there() {
                    return Err(self.no_controller());
                }
            }
            if waited >= timeout {
                return Err(RequestError::TimedOut { seconds: timeout.as_secs_f64().to_string() });
            }
            std::thread::sleep(POLL_INTERVAL.min(timeout - waited));
        }
    }

    /// Sends a request and waits for the reply.
    ///
    /// # Errors
    /// Those of [`send`](Self::send) and [`wait`](Self::wait).
    pub fn ask(&self, request: &RequestMessage, timeout: Duration) -> Result<ReplyMessage, RequestError> {
        self.wait(&self.send(request)?, timeout)
    }

    /// Whether a controller is running. Cleans up after dead processes first, which takes about 0.1 ms.
    pub fn controller_is_there(&self) -> bool {
        self.service.try_cleanup_dead_nodes();
        self.service.dynamic_config().number_of_servers() > 0
    }

    fn no_controller(&self) -> RequestError {
        RequestError::NoController { instance: self.instance.clone() }
    }
}

/// A request that was sent and not yet replied to. Dropping it discards the reply.
pub struct PendingReply {
    response: PendingResponse<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl PendingReply {
    /// The reply, if it has arrived.
    ///
    /// # Errors
    /// The controller dropped the request, or disconnected, or the shared memory failed.
    pub fn poll(&self) -> Result<Option<ReplyMessage>, RequestError> {
        // In this order: a reply may arrive and the connection end between the two.
        let connected = self.response.is_connected();
        match self.response.receive() {
            Ok(Some(reply)) => Ok(Some(*reply)),
            Ok(None) if connected => Ok(None),
            Ok(None) => Err(RequestError::Dropped),
            Err(cause) => Err(TransportError { action: "receive a reply", cause: cause.to_string() }.into()),
        }
    }
}

impl fmt::Debug for PendingReply {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("PendingReply").finish_non_exhaustive()
    }
}
