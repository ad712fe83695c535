//! Bridge between the plant's loop and those who push its robot: takes requests out of shared memory and sends replies.
//!
//! As for the requests to the controller, both allocate: in real time a thread beside the loop does it, in lockstep the
//! loop does, so that a push that was asked for before a tick begins with that tick.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crossbeam::queue::ArrayQueue;
use interface::{PushOutcome, PushReply, PushRequest};
use model::{Joint, PerJoint};
use wire::{PushReplyMessage, PushResponder, PushServer};

use crate::cycle::Clock;
use crate::error::NodeError;

/// Most requests between the thread and the loop.
const REQUESTS: usize = 8;
/// How long the thread sleeps when there is nothing to do: people push by hand.
const POLL_INTERVAL: Duration = Duration::from_millis(2);

/// Delivers requests to the plant's loop and takes its replies.
pub struct PushBridge {
    path: PushPath,
    /// The links that can be pushed.
    pushable: PerJoint<bool>,
}

/// Who reads and writes shared memory.
enum PushPath {
    /// The loop itself.
    Inline(PushServer),
    /// A thread beside the loop. Dropping the bridge waits for its end: until then its files are in use.
    Threaded(Arc<PushQueues>, Option<JoinHandle<()>>),
}

/// The queues between the loop and the thread.
#[derive(Debug)]
struct PushQueues {
    requests: ArrayQueue<PushRequest>,
    replies: ArrayQueue<PushReply>,
    closed: AtomicBool,
}

impl PushBridge {
    /// A bridge for a clock.
    ///
    /// # Errors
    /// The operating system refused another thread.
    pub fn new(server: PushServer, clock: Clock) -> Result<Self, NodeError> {
        if clock == Clock::Lockstep {
            return Ok(Self { path: PushPath::Inline(server), pushable: PerJoint::from_fn(|_| true) });
        }
        let (requests, replies) = (ArrayQueue::new(REQUESTS), ArrayQueue::new(REQUESTS));
        let queues = Arc::new(PushQueues { requests, replies, closed: AtomicBool::new(false) });
        let shared = Arc::clone(&queues);
        let thread = std::thread::Builder::new()
            .name("push-bridge".to_owned())
            .spawn(move || exchange(server, &shared))
            .map_err(NodeError::Thread)?;
        Ok(Self { path: PushPath::Threaded(queues, Some(thread)), pushable: PerJoint::from_fn(|_| true) })
    }

    /// The same for a robot that can be pushed on some links only: requests for others are refused.
    #[must_use]
    pub fn on_links(mut self, pushable: impl Fn(Joint) -> bool) -> Self {
        self.pushable = PerJoint::from_fn(pushable);
        self
    }

    /// Passes all requests that have arrived to the loop's `begin`, and its replies back. With a thread it neither
    /// allocates nor waits.
    pub fn serve(&mut self, mut begin: impl FnMut(&PushRequest) -> PushReply) {
        let Self { path, pushable } = self;
        let mut begin = |request: &PushRequest| if pushable[request.link] { begin(request) } else { NO_SUCH_LINK };
        match path {
            PushPath::Inline(server) => {
                // A client whose memory cannot be reached has gone.
                while let Ok(Some((message, responder))) = server.next_push() {
                    let reply = message.checked().map_or(INVALID, |request| begin(&request));
                    responder.reply(&PushReplyMessage::from(&reply));
                }
            }
            PushPath::Threaded(queues, _) => {
                while let Some(request) = queues.requests.pop() {
                    // There is room: no more requests than that are on their way.
                    let _ = queues.replies.push(begin(&request));
                }
            }
        }
    }
}

impl Drop for PushBridge {
    fn drop(&mut self) {
        if let PushPath::Threaded(queues, thread) = &mut self.path {
            queues.closed.store(true, Ordering::Release);
            // A thread that panicked has told so.
            let _ = thread.take().map(JoinHandle::join);
        }
    }
}

/// The reply to a message that is no push.
const INVALID: PushReply = PushReply { outcome: PushOutcome::Invalid, start: 0.0 };

/// The reply to a push on a link that cannot be pushed.
const NO_SUCH_LINK: PushReply = PushReply { outcome: PushOutcome::NoSuchLink, start: 0.0 };

/// Moves requests and replies between shared memory and the queues until these are closed.
fn exchange(mut server: PushServer, queues: &PushQueues) {
    let mut waiting: VecDeque<PushResponder> = VecDeque::new();
    while !queues.closed.load(Ordering::Acquire) {
        while let Some(reply) = queues.replies.pop()
            && let Some(responder) = waiting.pop_front()
        {
            responder.reply(&PushReplyMessage::from(&reply));
        }
        while waiting.len() < REQUESTS
            && let Ok(Some((message, responder))) = server.next_push()
        {
            match message.checked() {
                Ok(request) => {
                    // There is room: as many wait at most.
                    let _ = queues.requests.push(request);
                    waiting.push_back(responder);
                }
                Err(_) => drop(responder.reply(&PushReplyMessage::from(&INVALID))),
            }
        }
        std::thread::sleep(POLL_INTERVAL);
    }
}
