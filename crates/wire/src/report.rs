//! Reports: the controller tells, once per period, whoever listens.

use std::fmt;

use iceoryx2::port::publisher::{Publisher, PublisherCreateError};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::{BackpressureStrategy, MessagingPattern, Node};
use iceoryx2::service::builder::publish_subscribe::Builder;
use iceoryx2::service::port_factory::publish_subscribe::PortFactory;

use crate::agreement::{Agreement, rate_hz};
use crate::{ConnectError, Instance, Ipc, ReportMessage, WireFault};

const MAX_SUBSCRIBERS: usize = 16;
const MAX_NODES: usize = 24;
const BUFFER: usize = 64;

type Service = PortFactory<Ipc, ReportMessage, ()>;

fn agreement(instance: &Instance) -> Agreement<'_> {
    Agreement::new(instance, "report", MessagingPattern::PublishSubscribe, None)
}

fn builder(agreement: &Agreement, node: &Node<Ipc>) -> Builder<ReportMessage, (), Ipc> {
    node.service_builder(&agreement.name)
        .publish_subscribe::<ReportMessage>()
        // A listener that sleeps loses the oldest reports and holds up nobody.
        .enable_safe_overflow(true)
        .subscriber_max_buffer_size(BUFFER)
        .history_size(0)
        .max_publishers(1)
        .max_subscribers(MAX_SUBSCRIBERS)
        .max_nodes(MAX_NODES)
}

/// The controller's side: tells what happened in a period.
pub struct ReportPublisher {
    publisher: Publisher<Ipc, ReportMessage, ()>,
}

impl ReportPublisher {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let agreement = agreement(instance).at_rate();
        let service: Service = agreement.open_or_create(
            || builder(&agreement, node).open(),
            |terms| builder(&agreement, node).create_with_attributes(terms),
        )?;
        let taken = PublisherCreateError::ExceedsMaxSupportedPublishers;
        let create = || service.publisher_builder().backpressure_strategy(BackpressureStrategy::DiscardData).create();
        let publisher = agreement.only_one("controller", taken, &service, create)?;
        Ok(Self { publisher })
    }

    /// Tells everyone who listens, and says how many those were. Allocates once, and more when somebody comes or goes:
    /// call it beside the loop.
    ///
    /// # Errors
    /// The memory of a listener could not be reached. Later calls may succeed.
    pub fn publish(&mut self, report: &ReportMessage) -> Result<usize, WireFault> {
        let fault = |cause: &dyn fmt::Display| WireFault { action: "publish a report", cause: cause.to_string() };
        let sample = self.publisher.loan_uninit().map_err(|cause| fault(&cause))?;
        sample.write_payload(*report).send().map_err(|cause| fault(&cause))
    }
}

/// A listener's side.
pub struct ReportSubscriber {
    subscriber: Subscriber<Ipc, ReportMessage, ()>,
    rate_hz: u32,
}

impl ReportSubscriber {
    pub(crate) fn connect(instance: &Instance, node: &Node<Ipc>) -> Result<Self, ConnectError> {
        let agreement = agreement(instance);
        let service: Service = agreement.open(|| builder(&agreement, node).open())?;
        let subscriber =
            service.subscriber_builder().create().map_err(|cause| agreement.memory("connect to", cause))?;
        Ok(Self { subscriber, rate_hz: rate_hz(&service) })
    }

    /// Periods in a second, the unit of the reports' ticks [Hz].
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// The oldest report that has not been read; `None` when there is no new one. A gap in the ticks means that the
    /// listener was too slow.
    ///
    /// # Errors
    /// The memory of the controller could not be reached. Later calls may succeed.
    pub fn next_report(&mut self) -> Result<Option<ReportMessage>, WireFault> {
        match self.subscriber.receive() {
            Ok(sample) => Ok(sample.map(|sample| *sample)),
            Err(cause) => Err(WireFault { action: "receive a report", cause: cause.to_string() }),
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
