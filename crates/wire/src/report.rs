//! The report service: the controller publishes its state once per period, and any process may subscribe.

use std::fmt;

use iceoryx2::port::publisher::{Publisher, PublisherCreateError};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::{BackpressureStrategy, MessagingPattern, Node};
use iceoryx2::service::builder::publish_subscribe::Builder;
use iceoryx2::service::port_factory::publish_subscribe::PortFactory;

use crate::service_contract::{ServiceContract, rate_hz};
use crate::shared_memory::Role;
use crate::{ConnectError, Instance, Ipc, ReportMessage, TransportError};

/// Most subscribers at a time.
const MAX_SUBSCRIBERS: usize = 16;
/// Most processes that may use the service at a time.
const MAX_NODES: usize = 24;
/// Reports kept for each subscriber until it reads them.
const BUFFER: usize = 64;

type ReportService = PortFactory<Ipc, ReportMessage, ()>;

fn contract(instance: &Instance) -> ServiceContract<'_> {
    ServiceContract::new(instance, "report", MessagingPattern::PublishSubscribe, None)
}

fn builder(contract: &ServiceContract, node: &Node<Ipc>) -> Builder<ReportMessage, (), Ipc> {
    node.service_builder(&contract.name)
        .publish_subscribe::<ReportMessage>()
        // A slow subscriber loses the oldest reports and never blocks the publisher.
        .enable_safe_overflow(true)
        .subscriber_max_buffer_size(BUFFER)
        .history_size(0)
        .max_publishers(1)
        .max_subscribers(MAX_SUBSCRIBERS)
        .max_nodes(MAX_NODES)
}

/// The controller's end of the report service.
pub struct ReportPublisher {
    publisher: Publisher<Ipc, ReportMessage, ()>,
}

impl ReportPublisher {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let contract = contract(instance).at_rate();
        let service: ReportService = contract.open_or_create(
            || builder(&contract, node).open(),
            |attributes| builder(&contract, node).create_with_attributes(attributes),
        )?;
        let taken = PublisherCreateError::ExceedsMaxSupportedPublishers;
        let create = || service.publisher_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create();
        let publisher = contract.claim(Role::Controller, taken, &service, create)?;
        Ok(Self { publisher })
    }

    /// Sends a report to all subscribers and returns their number. The first call allocates, and so does the next call
    /// after a subscriber connects or disconnects: do not call it in the control loop.
    ///
    /// # Errors
    /// The memory of a subscriber could not be reached. Later calls may succeed.
    pub fn publish(&mut self, report: &ReportMessage) -> Result<usize, TransportError> {
        let fault = |cause: &dyn fmt::Display| TransportError { action: "publish a report", cause: cause.to_string() };
        let sample = self.publisher.loan_uninit().map_err(|cause| fault(&cause))?;
        sample.write_payload(*report).send().map_err(|cause| fault(&cause))
    }
}

/// An observer's end of the report service.
pub struct ReportSubscriber {
    subscriber: Subscriber<Ipc, ReportMessage, ()>,
    rate_hz: u32,
}

impl ReportSubscriber {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let contract = contract(instance);
        let service: ReportService = contract.open(|| builder(&contract, node).open())?;
        let subscriber =
            service.subscriber_builder().create().map_err(|cause| contract.memory_error("connect to", cause))?;
        Ok(Self { subscriber, rate_hz: rate_hz(&service) })
    }

    /// Control rate of the instance (Hz): the reports' ticks in a second.
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// The oldest report that has not been read; `None` when there is no new one. A gap in the ticks means that reports
    /// were lost because they were not read in time.
    ///
    /// # Errors
    /// The memory of the controller could not be reached. Later calls may succeed.
    pub fn next_report(&mut self) -> Result<Option<ReportMessage>, TransportError> {
        match self.subscriber.receive() {
            Ok(sample) => Ok(sample.map(|sample| *sample)),
            Err(cause) => Err(TransportError { action: "receive a report", cause: cause.to_string() }),
        }
    }
}

impl fmt::Debug for ReportPublisher {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("ReportPublisher").finish_non_exhaustive()
    }
}

impl fmt::Debug for ReportSubscriber {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("ReportSubscriber").finish_non_exhaustive()
    }
}
