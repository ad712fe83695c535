//! Setpoint and measurement services: one writer, several readers, only the latest message counts. Neither side ever
//! blocks or allocates.
//!
//! Underneath is a blackboard: two copies of the message, of which the writer fills one while readers read the other. A
//! writer's claim to its slot is a flag in that memory, which is never released when the writer is killed; hence
//! several slots, see the crate's documentation.

use std::fmt;

use iceoryx2::port::reader::{BlackboardValue, EntryHandle, Reader};
use iceoryx2::port::writer::{EntryHandleMut, EntryHandleMutError, Writer, WriterCreateError};
use iceoryx2::prelude::{MessagingPattern, Node};
use iceoryx2::service::port_factory::blackboard;

use crate::service_contract::{ServiceContract, is_lockstep, mechanism};
use crate::shared_memory::Role;
use crate::{ConnectError, Instance, Ipc, Latest, NEVER_WRITTEN};

/// Slots of a blackboard, one for each writer: how often a writer may be killed while its readers keep running.
pub const WRITER_SLOTS: u64 = 64;

/// Most readers at a time.
const MAX_READERS: usize = 16;
/// Most processes that may use the service at a time.
const MAX_NODES: usize = 24;

/// Number of a slot.
type Slot = u64;

/// The slot that no writer ever takes, to compare the others with.
const UNTOUCHED: Slot = WRITER_SLOTS;

/// A service of which only the latest message counts.
pub(crate) struct LatestService<'a> {
    contract: ServiceContract<'a>,
    blackboard: blackboard::PortFactory<Ipc, Slot>,
}

impl<'a> LatestService<'a> {
    pub(crate) fn open<M: Latest>(
        instance: &'a Instance,
        node: &Node<Ipc>,
        service: &'static str,
        mechanism: u64,
    ) -> Result<Self, ConnectError> {
        let contract = ServiceContract::new(instance, service, MessagingPattern::Blackboard, Some(mechanism)).of_pair();
        let blackboard = contract.open_or_create(
            || node.service_builder(&contract.name).blackboard_opener::<Slot>().open(),
            |attributes| {
                let creator = node.service_builder(&contract.name).blackboard_creator::<Slot>();
                (0..=UNTOUCHED)
                    .fold(creator, |creator, slot| creator.add(slot, M::EMPTY))
                    .max_readers(MAX_READERS)
                    .max_nodes(MAX_NODES)
                    .create_with_attributes(attributes)
            },
        )?;
        Ok(Self { contract, blackboard })
    }

    /// A reader of the service for a process that is neither side of it, the fingerprint of the robot, and whether both
    /// sides are in lockstep.
    pub(crate) fn watch<M: Latest>(
        instance: &'a Instance,
        node: &Node<Ipc>,
        service: &'static str,
    ) -> Result<(LatestReader<M>, u64, bool), ConnectError> {
        let contract = ServiceContract::new(instance, service, MessagingPattern::Blackboard, None);
        let blackboard = contract.open(|| node.service_builder(&contract.name).blackboard_opener::<Slot>().open())?;
        let (mechanism, is_lockstep) = (mechanism(&blackboard), is_lockstep(&blackboard));
        Ok((Self { contract, blackboard }.reader()?, mechanism, is_lockstep))
    }

    /// Compares what both sides must begin with: for a robot that has not moved yet.
    pub(crate) fn check_start(&self) -> Result<(), ConnectError> {
        self.contract.check_start(&self.blackboard)
    }

    /// Creates the only writer, which makes this process the `role` of the instance.
    pub(crate) fn writer<M: Latest>(&self, role: Role) -> Result<LatestWriter<M>, ConnectError> {
        let taken = WriterCreateError::ExceedsMaxSupportedWriters;
        let create = || self.blackboard.writer_builder().create();
        let writer = self.contract.claim(role, taken, &self.blackboard, create)?;
        for slot in 0..WRITER_SLOTS {
            match writer.entry(&slot) {
                Ok(entry) => return Ok(LatestWriter { entry, _port: writer }),
                // The writer of this slot was killed.
                Err(EntryHandleMutError::HandleAlreadyExists) => {}
                Err(cause) => return Err(self.contract.memory_error("write to", cause)),
            }
        }
        Err(ConnectError::UsedUp { service: self.contract.name.to_string(), writers: WRITER_SLOTS })
    }

    pub(crate) fn reader<M: Latest>(&self) -> Result<LatestReader<M>, ConnectError> {
        let reader = self
            .blackboard
            .reader_builder()
            .create()
            .map_err(|cause| self.contract.memory_error("read from", cause))?;
        let entry = |slot| reader.entry(&slot).map_err(|cause| self.contract.memory_error("read from", cause));
        let slots = (0..WRITER_SLOTS).map(entry).collect::<Result<_, _>>()?;
        let untouched = entry(UNTOUCHED)?;
        let (last, untouched) = (untouched.get(), untouched.get());
        let mut reader = LatestReader { slots, current: 0, last, probe: 0, untouched, _port: reader };
        reader.find_highest();
        Ok(reader)
    }
}

/// The only writer of a service of which only the latest message counts.
pub struct LatestWriter<M: Latest> {
    // First: dropped before the port, the slot is free again before another writer may connect.
    entry: EntryHandleMut<Ipc, Slot, M>,
    // Without it, a killed writer would not be recognised as dead.
    _port: Writer<Ipc, Slot>,
}

impl<M: Latest> LatestWriter<M> {
    /// Replaces the latest message. Does not allocate or block, whatever readers do.
    #[inline]
    pub fn write(&mut self, message: &M) {
        debug_assert_ne!(message.tick(), NEVER_WRITTEN, "this tick means that nothing was written");
        self.entry.update_with_copy(*message);
    }
}

/// A reader of a service of which only the latest message counts.
pub struct LatestReader<M: Latest> {
    slots: Vec<EntryHandle<Ipc, Slot, M>>,
    /// Index of the slot that the present writer writes to.
    current: usize,
    /// The message read last.
    last: BlackboardValue<M>,
    /// The higher slot to check next if the current one has no new message.
    probe: usize,
    /// The content of a slot that was never written.
    untouched: BlackboardValue<M>,
    _port: Reader<Ipc, Slot>,
}

impl<M: Latest> LatestReader<M> {
    /// The latest message, whether or not it was read before; `None` as long as none was ever written.
    #[inline]
    pub fn latest(&mut self) -> Option<M> {
        self.refresh();
        (self.last.tick() != NEVER_WRITTEN).then_some(*self.last)
    }

    /// The latest message, if it was not read before. Cheaper to poll than [`latest`](Self::latest).
    #[inline]
    pub fn take_new(&mut self) -> Option<&M> {
        self.refresh().then_some(&self.last)
    }

    /// Reads the latest message; `true` if it was not read before.
    #[inline]
    fn refresh(&mut self) -> bool {
        // A writer in a higher slot has connected after the current one was killed. While there is no new message, each
        // call checks the next slot and one other: checking all of them would take longer than a message takes to
        // arrive.
        let is_written = |slot: usize| self.slots.get(slot).is_some_and(|slot| !slot.is_up_to_date(&self.untouched));
        let mut is_succeeded = is_written(self.current + 1);
        let is_new = !self.slots[self.current].is_up_to_date(&self.last);
        if !is_succeeded && !is_new {
            self.probe = if self.probe + 1 < self.slots.len() { self.probe + 1 } else { self.current + 1 };
            is_succeeded = is_written(self.probe);
        }
        if is_succeeded {
            self.find_highest();
        } else if is_new {
            self.last = self.slots[self.current].get();
        }
        is_succeeded || is_new
    }

    /// Moves on to the last writer: writers take the first free slot, and the slots of killed ones never become free,
    /// so that the highest slot written belongs to the last writer.
    fn find_highest(&mut self) {
        let later = self.current + 1..self.slots.len();
        if let Some(slot) = later.rev().find(|&slot| !self.slots[slot].is_up_to_date(&self.untouched)) {
            self.current = slot;
            self.probe = slot;
        }
        self.last = self.slots[self.current].get();
    }
}

impl<M: Latest> fmt::Debug for LatestWriter<M> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("LatestWriter").finish_non_exhaustive()
    }
}

impl<M: Latest> fmt::Debug for LatestReader<M> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("LatestReader").field("slot", &self.current).finish_non_exhaustive()
    }
}
