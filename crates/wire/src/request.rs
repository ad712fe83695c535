//! Requests and their replies: several operators ask, the one controller answers each question once.

use std::fmt;
use std::time::{Duration, Instant};

use iceoryx2::active_request::ActiveRequest;
use iceoryx2::pending_response::PendingResponse;
use iceoryx2::port::client::{Client, RequestSendError};
use iceoryx2::port::server::Server;
use iceoryx2::prelude::{BackpressureStrategy, MessagingPattern, Node, PortFactory as _};
use iceoryx2::service::builder::request_response::Builder;
use iceoryx2::service::port_factory::request_response::PortFactory;
use iceoryx2::service::port_factory::server::ServerCreateError;

use crate::agreement::Agreement;
use crate::{AskError, ConnectError, Instance, Ipc, ReplyMessage, RequestMessage, WireFault};

const MAX_CLIENTS: usize = 8;
const MAX_NODES: usize = 24;
const MAX_UNANSWERED: usize = 256;

/// How often an operator who waits looks whether the answer has come.
const GLANCE: Duration = Duration::from_millis(1);
/// How often it looks whether the controller is still alive, which costs more.
const HEARTBEAT: Duration = Duration::from_millis(200);

type Service = PortFactory<Ipc, RequestMessage, (), ReplyMessage, ()>;

fn agreement(instance: &Instance) -> Agreement<'_> {
    Agreement::new(instance, "request", MessagingPattern::RequestResponse, None)
}

fn builder(agreement: &Agreement, node: &Node<Ipc>) -> Builder<RequestMessage, (), ReplyMessage, (), Ipc> {
    node.service_builder(&agreement.name)
        .request_response::<RequestMessage, ReplyMessage>()
        // A question that was sent is not pushed out by a later one.
        .enable_safe_overflow_for_requests(false)
        .enable_safe_overflow_for_responses(false)
        .enable_fire_and_forget_requests(false)
        .max_active_requests_per_client(MAX_UNANSWERED)
        .max_response_buffer_size(1)
        .max_borrowed_responses_per_pending_response(1)
        .max_servers(1)
        .max_clients(MAX_CLIENTS)
        .max_nodes(MAX_NODES)
}

/// The controller's side: takes requests and answers them.
#[derive(Debug)]
pub struct RequestServer {
    server: Server<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl RequestServer {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let agreement = agreement(instance).at_rate();
        let service: Service = agreement.open_or_create(
            || builder(&agreement, node).open(),
            |terms| builder(&agreement, node).create_with_attributes(terms),
        )?;
        let taken = ServerCreateError::ExceedsMaxSupportedServers;
        let create = || {
            // An operator that does not read must not hold up the controller.
            service.server_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create()
        };
        let server = agreement.only_one("controller", taken, &service, create)?;
        Ok(Self { server })
    }

    /// The next request, first come first served, and the means to answer it; `None` if nobody asks.
    ///
    /// # Errors
    /// The memory of an operator could not be reached. Later calls may succeed.
    pub fn next_request(&mut self) -> Result<Option<(RequestMessage, Answer)>, WireFault> {
        match self.server.receive() {
            Ok(request) => Ok(request.map(|request| (*request, Answer { request }))),
            Err(cause) => Err(WireFault { action: "receive a request", cause: cause.to_string() }),
        }
    }
}

/// The means to answer one request. It may be kept, for instance until the request takes effect; dropped without an
/// answer, the operator is told so.
pub struct Answer {
    request: ActiveRequest<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl Answer {
    /// Sends the answer. `false` if it could not be delivered: the operator has left.
    pub fn reply(self, reply: &ReplyMessage) -> bool {
        self.request.send_copy(*reply).is_ok()
    }
}

impl fmt::Debug for Answer {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("Answer").finish_non_exhaustive()
    }
}

/// An operator's side: asks and is answered.
#[derive(Debug)]
pub struct RequestClient {
    instance: String,
    service: Service,
    client: Client<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl RequestClient {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let agreement = agreement(instance);
        let service: Service = agreement.open(|| builder(&agreement, node).open())?;
        let client = service
            .client_builder()
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .create()
            .map_err(|cause| agreement.memory("connect to", cause))?;
        let client = Self { instance: instance.name().to_string(), service, client };
        if client.controller_is_there() { Ok(client) } else { Err(instance.no_controller()) }
    }

    /// Sends a request without waiting for the answer. Up to 256 may be waiting.
    ///
    /// # Errors
    /// No controller is there, too many requests are waiting, or the shared memory failed.
    pub fn send(&self, request: &RequestMessage) -> Result<Waiting, AskError> {
        let response = self.client.send_copy(*request).map_err(|cause| match cause {
            RequestSendError::ExceedsMaxActiveRequests => AskError::TooMany { limit: MAX_UNANSWERED },
            cause => WireFault { action: "send a request", cause: cause.to_string() }.into(),
        })?;
        if response.number_of_server_connections() == 0 {
            return Err(self.no_controller());
        }
        Ok(Waiting { response })
    }

    /// Sleeps until the answer to a request is there.
    ///
    /// # Errors
    /// The controller is gone, dropped the request, or takes longer than `timeout`.
    pub fn wait(&self, waiting: &Waiting, timeout: Duration) -> Result<ReplyMessage, AskError> {
        let began = Instant::now();
        let mut heartbeats = 0;
        loop {
            match waiting.poll() {
                Ok(Some(reply)) => return Ok(reply),
                Ok(None) => {}
                Err(AskError::Dropped) if !self.controller_is_there() => return Err(self.no_controller()),
                Err(error) => return Err(error),
            }
            let waited = began.elapsed();
            if waited >= HEARTBEAT * heartbeats {
                heartbeats += 1;
                if !self.controller_is_there() {
                    return Err(self.no_controller());
                }
            }
            if waited >= timeout {
                return Err(AskError::TimedOut { seconds: timeout.as_secs_f64().to_string() });
            }
            std::thread::sleep(GLANCE.min(timeout - waited));
        }
    }

    /// Sends a request and waits for the answer.
    ///
    /// # Errors
    /// Those of [`send`](Self::send) and [`wait`](Self::wait).
    pub fn ask(&self, request: &RequestMessage, timeout: Duration) -> Result<ReplyMessage, AskError> {
        self.wait(&self.send(request)?, timeout)
    }

    /// Whether a controller is alive; looks after dead ones first, which takes some 0.1 ms.
    pub fn controller_is_there(&self) -> bool {
        self.service.try_cleanup_dead_nodes();
        self.service.dynamic_config().number_of_servers() > 0
    }

    fn no_controller(&self) -> AskError {
        AskError::NoController { instance: self.instance.clone() }
    }
}

/// A request that waits for its answer. Dropped, the answer is not wanted any more.
pub struct Waiting {
    response: PendingResponse<Ipc, RequestMessage, (), ReplyMessage, ()>,
}

impl Waiting {
    /// The answer, if it has come.
    ///
    /// # Errors
    /// The controller dropped the request, or left, or the shared memory failed.
    pub fn poll(&self) -> Result<Option<ReplyMessage>, AskError> {
        // In this order: an answer may come and the connection end between the two.
        let connected = self.response.is_connected();
        match self.response.receive() {
            Ok(Some(reply)) => Ok(Some(*reply)),
            Ok(None) if connected => Ok(None),
            Ok(None) => Err(AskError::Dropped),
            Err(cause) => Err(WireFault { action: "receive a reply", cause: cause.to_string() }.into()),
        }
    }
}

impl fmt::Debug for Waiting {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("Waiting").finish_non_exhaustive()
    }
}
