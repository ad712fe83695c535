//! The push service: anyone asks for pushes, and a simulated plant replies to each request once.

use std::fmt;
use std::time::{Duration, Instant};

use iceoryx2::active_request::ActiveRequest;
use iceoryx2::port::client::Client;
use iceoryx2::port::server::Server;
use iceoryx2::prelude::{BackpressureStrategy, MessagingPattern, Node, PortFactory as _};
use iceoryx2::service::builder::request_response::Builder;
use iceoryx2::service::port_factory::request_response::PortFactory;
use iceoryx2::service::port_factory::server::ServerCreateError;

use crate::service_contract::ServiceContract;
use crate::shared_memory::Role;
use crate::{ConnectError, Instance, Ipc, PushError, PushReplyMessage, PushRequestMessage, TransportError};

/// Most clients at a time.
const MAX_CLIENTS: usize = 8;
/// Most processes that may use the service at a time.
const MAX_NODES: usize = 16;
/// Most unanswered requests of a client.
const MAX_UNANSWERED: usize = 4;
/// Time between two checks of a waiting client for its reply.
const POLL_INTERVAL: Duration = Duration::from_millis(1);

type PushService = PortFactory<Ipc, PushRequestMessage, (), PushReplyMessage, ()>;

fn contract(instance: &Instance) -> ServiceContract<'_> {
    ServiceContract::new(instance, "push", MessagingPattern::RequestResponse, None)
}

fn builder(contract: &ServiceContract, node: &Node<Ipc>) -> Builder<PushRequestMessage, (), PushReplyMessage, (), Ipc> {
    node.service_builder(&contract.name)
        .request_response::<PushRequestMessage, PushReplyMessage>()
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

/// The plant's end of the push service.
#[derive(Debug)]
pub struct PushServer {
    server: Server<Ipc, PushRequestMessage, (), PushReplyMessage, ()>,
}

/// The means to reply to one request. If it is dropped without a reply, the client gets [`PushError::Dropped`].
pub struct PushResponder(ActiveRequest<Ipc, PushRequestMessage, (), PushReplyMessage, ()>);

/// Asks for pushes.
#[derive(Debug)]
pub struct PushClient {
    instance: String,
    service: PushService,
    client: Client<Ipc, PushRequestMessage, (), PushReplyMessage, ()>,
}

impl PushServer {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let contract = contract(instance);
        let service: PushService = contract.open_or_create(
            || builder(&contract, node).open(),
            |attributes| builder(&contract, node).create_with_attributes(attributes),
        )?;
        let taken = ServerCreateError::ExceedsMaxSupportedServers;
        // A client that does not read its replies must not block the plant.
        let create = || service.server_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create();
        Ok(Self { server: contract.claim(Role::Plant, taken, &service, create)? })
    }

    /// The next request and the means to reply to it; `None` if there is none. It allocates and may map memory: in real
    /// time do not call it in the loop.
    ///
    /// # Errors
    /// The memory of a client could not be reached. Later calls may succeed.
    pub fn next_push(&mut self) -> Result<Option<(PushRequestMessage, PushResponder)>, TransportError> {
        match self.server.receive() {
            Ok(request) => Ok(request.map(|request| (*request, PushResponder(request)))),
            Err(cause) => Err(TransportError { action: "receive a push", cause: cause.to_string() }),
        }
    }
}

impl PushResponder {
    /// Sends the reply; `false` if the client has gone.
    pub fn reply(self, reply: &PushReplyMessage) -> bool {
        self.0.send_copy(*reply).is_ok()
    }
}

impl PushClient {
    /// Connects this process to the plant of an instance.
    ///
    /// # Errors
    /// No plant that can be pushed is running, or one of another version, or too many clients are connected.
    pub fn connect(instance: &Instance) -> Result<Self, PushError> {
        let no_plant = |error| match error {
            ConnectError::NoController { instance, .. } => PushError::NoPlant { instance },
            error => PushError::Connect(error),
        };
        let lock = instance.connect_lock_if_there().map_err(no_plant)?;
        let node = instance.open_node(&lock, Role::Observer).map_err(PushError::Connect)?;
        let contract = contract(instance);
        let service: PushService = contract.open(|| builder(&contract, &node).open()).map_err(no_plant)?;
        let client = service.client_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create();
        let client = client.map_err(|cause| PushError::Connect(contract.memory_error("connect to", cause)))?;
        instance.take_room(&lock, Role::Observer).map_err(PushError::Connect)?;
        Ok(Self { instance: instance.name().to_string(), service, client })
    }

    /// Asks for a push, and waits for the reply.
    ///
    /// # Errors
    /// The plant has gone, or takes longer than `timeout`; or too many requests are unanswered.
    pub fn ask(&self, push: &PushRequestMessage, timeout: Duration) -> Result<PushReplyMessage, PushError> {
        let failed = |action, cause: &dyn fmt::Display| TransportError { action, cause: cause.to_string() };
        self.service.try_cleanup_dead_nodes();
        let pending = self.client.send_copy(*push).map_err(|cause| failed("send a push", &cause))?;
        if pending.number_of_server_connections() == 0 {
            return Err(PushError::NoPlant { instance: self.instance.clone() });
        }
        let began = Instant::now();
        loop {
            // In this order: a reply may arrive and the connection end between the two.
            let is_connected = pending.is_connected();
            match pending.receive() {
                Ok(Some(reply)) => return Ok(*reply),
                Ok(None) if !is_connected => return Err(PushError::Dropped),
                Ok(None) if began.elapsed() >= timeout => {
                    return Err(PushError::TimedOut { seconds: timeout.as_secs_f64().to_string() });
                }
                Ok(None) => std::thread::sleep(POLL_INTERVAL),
                Err(cause) => return Err(failed("receive a reply", &cause).into()),
            }
        }
    }
}

impl fmt::Debug for PushResponder {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("PushResponder").finish_non_exhaustive()
    }
}
