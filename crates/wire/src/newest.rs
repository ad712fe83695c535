//! Setpoint and measurement: one writes, others read, only the newest counts, and nobody ever waits or allocates.
//!
//! Underneath is a blackboard: two copies of the message, of which the writer fills one while readers read the other.
//! A writer's right to its place is a flag in that memory, which nobody takes back when the writer is killed; hence
//! several places, see the crate's documentation.

use std::fmt;

use iceoryx2::port::reader::{BlackboardValue, EntryHandle, Reader};
use iceoryx2::port::writer::{EntryHandleMut, EntryHandleMutError, Writer, WriterCreateError};
use iceoryx2::prelude::{MessagingPattern, Node};
use iceoryx2::service::port_factory::blackboard;

use crate::agreement::Agreement;
use crate::{ConnectError, Instance, Ipc, NOTHING_YET, Newest};

/// How often a writer may be killed while its readers go on.
pub const NEWEST_SLOTS: u64 = 64;

const MAX_READERS: usize = 16;
const MAX_NODES: usize = 24;

/// A place's number.
type Slot = u64;

/// The place that no writer ever takes, to compare the others with.
const UNTOUCHED: Slot = NEWEST_SLOTS;

/// A service of which only the newest message counts.
pub(crate) struct NewestService<'a> {
    agreement: Agreement<'a>,
    blackboard: blackboard::PortFactory<Ipc, Slot>,
}

impl<'a> NewestService<'a> {
    pub fn join<M: Newest>(
        instance: &'a Instance,
        node: &Node<Ipc>,
        service: &'static str,
        mechanism: u64,
    ) -> Result<Self, ConnectError> {
        let agreement = Agreement::new(instance, service, MessagingPattern::Blackboard, Some(mechanism)).at_rate();
        let blackboard = agreement.open_or_create(
            || node.service_builder(&agreement.name).blackboard_opener::<Slot>().open(),
            |terms| {
                let creator = node.service_builder(&agreement.name).blackboard_creator::<Slot>();
                (0..=UNTOUCHED)
                    .fold(creator, |creator, slot| creator.add(slot, M::NOTHING))
                    .max_readers(MAX_READERS)
                    .max_nodes(MAX_NODES)
                    .create_with_attributes(terms)
            },
        )?;
        Ok(Self { agreement, blackboard })
    }

    /// Becomes the one writer, which makes this process the `role` of the instance.
    pub fn writer<M: Newest>(&self, role: &'static str) -> Result<NewestWriter<M>, ConnectError> {
        let taken = WriterCreateError::ExceedsMaxSupportedWriters;
        let create = || self.blackboard.writer_builder().create();
        let writer = self.agreement.only_one(role, taken, &self.blackboard, create)?;
        for slot in 0..NEWEST_SLOTS {
            match writer.entry(&slot) {
                Ok(entry) => return Ok(NewestWriter { entry, _port: writer }),
                // Its writer was killed.
                Err(EntryHandleMutError::HandleAlreadyExists) => {}
                Err(cause) => return Err(self.agreement.memory("write to", cause)),
            }
        }
        Err(ConnectError::UsedUp { service: self.agreement.name.to_string() })
    }

    pub fn reader<M: Newest>(&self) -> Result<NewestReader<M>, ConnectError> {
        let reader =
            self.blackboard.reader_builder().create().map_err(|cause| self.agreement.memory("read from", cause))?;
        let entry = |slot| reader.entry(&slot).map_err(|cause| self.agreement.memory("read from", cause));
        let slots = (0..NEWEST_SLOTS).map(entry).collect::<Result<_, _>>()?;
        let untouched = entry(UNTOUCHED)?;
        let (last, untouched) = (untouched.get(), untouched.get());
        let mut reader = NewestReader { slots, current: 0, last, probe: 0, untouched, _port: reader };
        reader.find_highest();
        Ok(reader)
    }
}

/// The one writer of a service of which only the newest message counts.
pub struct NewestWriter<M: Newest> {
    // First: dropped before the port, the place is free again before another writer may come.
    entry: EntryHandleMut<Ipc, Slot, M>,
    // Without it, a killed writer would not be recognised as dead.
    _port: Writer<Ipc, Slot>,
}

impl<M: Newest> NewestWriter<M> {
    /// Replaces the newest message. Does not allocate or block, whatever readers do.
    #[inline]
    pub fn write(&mut self, message: &M) {
        debug_assert_ne!(message.tick(), NOTHING_YET, "this tick says that nothing was written");
        self.entry.update_with_copy(*message);
    }
}

/// A reader of a service of which only the newest message counts.
pub struct NewestReader<M: Newest> {
    slots: Vec<EntryHandle<Ipc, Slot, M>>,
    current: usize,
    /// The last message read, and the higher place at which to look next if it is still the same.
    last: BlackboardValue<M>,
    probe: usize,
    untouched: BlackboardValue<M>,
    _port: Reader<Ipc, Slot>,
}

impl<M: Newest> NewestReader<M> {
    /// The newest message, whether or not it was read before; `None` as long as none was ever written.
    #[inline]
    pub fn newest(&mut self) -> Option<M> {
        self.look();
        (self.last.tick() != NOTHING_YET).then_some(*self.last)
    }

    /// The newest message, if it was not read before. Cheaper to ask again and again than [`newest`](Self::newest).
    #[inline]
    pub fn news(&mut self) -> Option<&M> {
        self.look().then_some(&self.last)
    }

    /// Reads the newest message, if there is one that was not read before.
    #[inline]
    fn look(&mut self) -> bool {
        // Who writes beyond the current writer has come after it was killed. Besides the next place one other is looked at
        // per call, while there is no news: looking at all of them would take longer than a message takes to arrive.
        let is_written = |slot: usize| self.slots.get(slot).is_some_and(|slot| !slot.is_up_to_date(&self.untouched));
        let mut is_followed = is_written(self.current + 1);
        let is_news = !self.slots[self.current].is_up_to_date(&self.last);
        if !is_followed && !is_news {
            self.probe = if self.probe + 1 < self.slots.len() { self.probe + 1 } else { self.current + 1 };
            is_followed = is_written(self.probe);
        }
        if is_followed {
            self.find_highest();
        } else if is_news {
            self.last = self.slots[self.current].get();
        }
        is_followed || is_news
    }

    /// Moves on to the last writer: writers take the first free place, and the places of killed ones never become free,
    /// so that the highest one written is the last.
    fn find_highest(&mut self) {
        let later = self.current + 1..self.slots.len();
        if let Some(slot) = later.rev().find(|&slot| !self.slots[slot].is_up_to_date(&self.untouched)) {
            self.current = slot;
            self.probe = slot;
        }
        self.last = self.slots[self.current].get();
    }
}

impl<M: Newest> fmt::Debug for NewestWriter<M> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("NewestWriter").finish_non_exhaustive()
    }
}

impl<M: Newest> fmt::Debug for NewestReader<M> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_struct("NewestReader").field("slot", &self.current).finish_non_exhaustive()
    }
}
