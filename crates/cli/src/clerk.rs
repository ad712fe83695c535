//! The clerk: takes requests out of shared memory and sends the replies, so that the loop does not have to.
//!
//! Both allocate and may map memory when an operator comes or goes. In real time the clerk is a thread beside the loop,
//! with a lock-free queue each way; in lockstep the loop does its work, so that what has come before a tick is heard in it.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crossbeam::queue::ArrayQueue;
use runtime::Scheduling;
use wire::{Answer, ReplyMessage, RequestMessage, RequestServer};

use crate::failure::Failure;
use crate::turns::Clock;

/// A request as the loop hears of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Letter {
    /// By which its reply finds the way back.
    pub id: LetterId,
    /// What the operator wrote.
    pub message: RequestMessage,
}

/// Which letter it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LetterId(u32);

/// What the loop writes to, and hears from.
pub enum Clerk {
    /// The loop does it by itself.
    Here(Counter),
    /// A thread beside the loop does.
    Beside {
        /// What lies between the two.
        trays: Arc<Trays>,
        /// Gives the counter back at its end.
        thread: JoinHandle<Counter>,
    },
}

/// Where operators come to.
pub struct Counter {
    server: RequestServer,
    open: HashMap<LetterId, Answer>,
    last: LetterId,
}

/// What lies between the loop and the thread.
#[derive(Debug)]
pub struct Trays {
    letters: ArrayQueue<Letter>,
    replies: ArrayQueue<(LetterId, ReplyMessage)>,
    closed: AtomicBool,
}

/// How many letters the loop may find at once: taking them in is part of a period.
const LETTERS: usize = 8;
/// How long the thread sleeps when there is nothing to do: a fraction of a period.
const NAP: Duration = Duration::from_micros(100);

impl LetterId {
    /// What the loop asks by itself: no letter, and answered to nobody.
    pub const LOOP: Self = Self(u32::MAX);

    /// Letters count from 1 in the order in which they came.
    pub const fn number(self) -> u32 {
        self.0
    }
}

impl Clerk {
    /// For a clock; of no more than `unanswered` letters the reply will be outstanding at a time. A thread asks the system
    /// for `scheduling`, and does with what it gets.
    ///
    /// # Errors
    /// The system refuses another thread.
    pub fn new(
        server: RequestServer,
        clock: Clock,
        unanswered: usize,
        scheduling: Scheduling,
    ) -> Result<Self, Failure> {
        let mut counter = Counter { server, open: HashMap::new(), last: LetterId(0) };
        if clock == Clock::Lockstep {
            return Ok(Clerk::Here(counter));
        }
        let trays = Arc::new(Trays {
            letters: ArrayQueue::new(LETTERS),
            replies: ArrayQueue::new(unanswered + LETTERS),
            closed: AtomicBool::new(false),
        });
        let shared = Arc::clone(&trays);
        let thread = std::thread::Builder::new()
            .name("clerk".to_owned())
            .spawn(move || {
                let _granted = scheduling.ask();
                counter.serve(&shared);
                counter
            })
            .map_err(|error| Failure::new(format!("cannot start a thread: {error}")))?;
        Ok(Clerk::Beside { trays, thread })
    }

    /// The next letter, if one has come. Beside the loop it neither allocates nor waits, and neither does [`reply`](Self::reply).
    pub fn next_letter(&mut self) -> Option<Letter> {
        match self {
            Clerk::Here(counter) => counter.next_letter(),
            Clerk::Beside { trays, .. } => trays.letters.pop(),
        }
    }

    /// Sends the reply to a letter.
    pub fn reply(&mut self, id: LetterId, reply: ReplyMessage) {
        match self {
            Clerk::Here(counter) => counter.reply(id, &reply),
            // There is room for as many as can be outstanding.
            Clerk::Beside { trays, .. } => drop(trays.replies.push((id, reply))),
        }
    }

    /// Ends the thread, if there is one, once its replies are sent. Gives the letters that nobody read.
    pub fn close(self) -> (Counter, Vec<Letter>) {
        match self {
            Clerk::Here(counter) => (counter, Vec::new()),
            Clerk::Beside { trays, thread } => {
                trays.closed.store(true, Ordering::Release);
                let counter = thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                (counter, std::iter::from_fn(|| trays.letters.pop()).collect())
            }
        }
    }
}

impl Counter {
    /// The next request that an operator has sent.
    pub fn next_letter(&mut self) -> Option<Letter> {
        // An operator whose memory cannot be reached has gone; the next look finds the others.
        let (message, answer) = self.server.next_request().ok().flatten()?;
        let id = LetterId(self.last.0 + 1);
        self.last = id;
        self.open.insert(id, answer);
        Some(Letter { id, message })
    }

    /// Sends the reply to a letter.
    pub fn reply(&mut self, id: LetterId, reply: &ReplyMessage) {
        if let Some(answer) = self.open.remove(&id) {
            // Whether the operator is still there to hear it changes nothing.
            answer.reply(reply);
        }
    }

    /// Carries letters and replies to and fro until the trays are closed.
    fn serve(&mut self, trays: &Trays) {
        loop {
            // In this order: after closing nothing is replied, so that an empty tray is the end.
            let closed = trays.closed.load(Ordering::Acquire);
            while let Some((id, reply)) = trays.replies.pop() {
                self.reply(id, &reply);
            }
            if closed {
                return;
            }
            while !trays.letters.is_full()
                && let Some(letter) = self.next_letter()
            {
                // The loop only takes out: there is still room.
                let _ = trays.letters.push(letter);
            }
            std::thread::sleep(NAP);
        }
    }
}
