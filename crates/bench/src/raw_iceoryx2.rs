//! Plain iceoryx2, without what `wire` adds: the same payload over a blackboard and by publish–subscribe.

use std::fmt::Debug;

use iceoryx2::port::publisher::Publisher;
use iceoryx2::port::reader::{BlackboardValue, EntryHandle, Reader};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::port::writer::{EntryHandleMut, Writer};
use iceoryx2::prelude::{
    Config, FileName, Node, NodeBuilder, Path, SemanticString, ServiceName, SignalHandlingMode, ZeroCopySend, ipc,
};
use wire::{Instance, Latest};

use crate::BenchError;

type IpcService = ipc::Service;

/// Creates and opens services beside the instance's other files, so that they are removed together.
pub(crate) struct Services {
    node: Node<IpcService>,
    /// Whether services are created, or opened.
    makes: bool,
}

/// One end of two blackboards with one entry each, one for each direction.
pub(crate) struct Blackboards<Out: Latest, In: Latest> {
    out: EntryHandleMut<IpcService, u64, Out>,
    into: EntryHandle<IpcService, u64, In>,
    last: BlackboardValue<In>,
    _ports: (Writer<IpcService, u64>, Reader<IpcService, u64>),
}

/// One end of two publish–subscribe services, one for each direction, in which the newest message replaces older ones.
pub(crate) struct PubSub<Out: Latest, In: Latest> {
    out: Publisher<IpcService, Out, ()>,
    into: Subscriber<IpcService, In, ()>,
}

const KEY: u64 = 0;

fn failed(cause: impl Debug) -> BenchError {
    BenchError { what: "iceoryx2 by itself", cause: format!("{cause:?}") }
}

impl Services {
    pub(crate) fn new(instance: &Instance, makes: bool) -> Result<Self, BenchError> {
        let mut config = Config::default();
        config.global.prefix = FileName::new(instance.prefix().as_bytes()).map_err(failed)?;
        let root = instance.folder().as_os_str().as_encoded_bytes();
        config.global.set_root_path(&Path::new(root).map_err(failed)?);
        let node = NodeBuilder::new().config(&config).signal_handling_mode(SignalHandlingMode::Disabled);
        Ok(Self { node: node.create().map_err(failed)?, makes })
    }

    /// Opens the blackboards of the services `out` and `into`.
    pub(crate) fn blackboards<Out: Latest, In: Latest>(
        &self,
        out: &str,
        into: &str,
    ) -> Result<Blackboards<Out, In>, BenchError> {
        let writer = self.blackboard::<Out>(out)?.writer_builder().create().map_err(failed)?;
        let reader = self.blackboard::<In>(into)?.reader_builder().create().map_err(failed)?;
        let (out, into) = (writer.entry(&KEY).map_err(failed)?, reader.entry(&KEY).map_err(failed)?);
        Ok(Blackboards { out, last: into.get(), into, _ports: (writer, reader) })
    }

    /// Opens publisher and subscriber of the services `out` and `into`.
    pub(crate) fn pub_sub<Out: Latest, In: Latest>(
        &self,
        out: &str,
        into: &str,
    ) -> Result<PubSub<Out, In>, BenchError> {
        let out = self.publishing::<Out>(out)?.publisher_builder().create().map_err(failed)?;
        let into = self.publishing::<In>(into)?.subscriber_builder().create().map_err(failed)?;
        Ok(PubSub { out, into })
    }

    fn blackboard<M: Latest>(
        &self,
        name: &str,
    ) -> Result<iceoryx2::service::port_factory::blackboard::PortFactory<IpcService, u64>, BenchError> {
        let builder = self.node.service_builder(&name_of(name)?);
        if self.makes {
            builder.blackboard_creator::<u64>().add(KEY, M::EMPTY).create().map_err(failed)
        } else {
            builder.blackboard_opener::<u64>().open().map_err(failed)
        }
    }

    fn publishing<M: Latest>(
        &self,
        name: &str,
    ) -> Result<iceoryx2::service::port_factory::publish_subscribe::PortFactory<IpcService, M, ()>, BenchError> {
        let builder = self.node.service_builder(&name_of(name)?).publish_subscribe::<M>();
        builder
            .enable_safe_overflow(true)
            .subscriber_max_buffer_size(1)
            .max_publishers(1)
            .open_or_create()
            .map_err(failed)
    }
}

fn name_of(name: &str) -> Result<ServiceName, BenchError> {
    ServiceName::new(name).map_err(failed)
}

impl<Out: Latest, In: Latest> Blackboards<Out, In> {
    pub(crate) fn send(&mut self, message: &Out) {
        self.out.update_with_copy(*message);
    }

    pub(crate) fn receive(&mut self) -> Option<&In> {
        if self.into.is_up_to_date(&self.last) {
            return None;
        }
        self.last = self.into.get();
        Some(&self.last)
    }
}

impl<Out: Latest + ZeroCopySend, In: Latest + ZeroCopySend> PubSub<Out, In> {
    pub(crate) fn send(&mut self, message: &Out) {
        // Within a run this cannot fail after it succeeded once; a lost message is noticed by its missing answer.
        if let Ok(sample) = self.out.loan_uninit() {
            let _ = sample.write_payload(*message).send();
        }
    }

    pub(crate) fn receive(&mut self) -> Option<In> {
        self.into.receive().ok().flatten().map(|sample| *sample)
    }
}
