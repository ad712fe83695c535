//! Bridge between the loop and the operators: takes requests out of shared memory and sends the replies.
//!
//! Both allocate and may map memory when an operator comes or goes, so that in real time a thread beside the loop does
//! it, with a lock-free queue each way. In lockstep the loop does it itself: a request that was sent before a tick is
//! handled in that tick.

use std::collections::{HashMap, VecDeque};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use controller::RequestId;
use crossbeam::queue::ArrayQueue;
use runtime::Scheduling;
use wire::{MAX_OPERATORS, MAX_UNANSWERED, ReplyMessage, RequestMessage, RequestServer, Responder};

use crate::cycle::Clock;
use crate::error::NodeError;

/// A request as the loop receives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncomingRequest {
    /// Routes the reply back to the operator.
    pub id: RequestId,
    /// The request as the operator sent it, unchecked.
    pub message: RequestMessage,
}

/// Delivers requests to the loop and takes its replies.
pub enum RequestBridge {
    /// The loop itself reads and writes shared memory.
    Inline(RequestIo),
    /// A thread beside the loop reads and writes shared memory.
    Threaded {
        /// Shared between loop and thread.
        queues: Arc<Queues>,
        /// Returns its [`RequestIo`] when it ends.
        thread: JoinHandle<RequestIo>,
    },
}

/// Reads requests from shared memory, and remembers where each reply has to go.
pub struct RequestIo {
    server: RequestServer,
    unanswered: HashMap<RequestId, Responder>,
    last: RequestId,
    /// Stops that were received and not yet passed on.
    stops: VecDeque<IncomingRequest>,
    /// All other requests that were received and not yet passed on.
    others: VecDeque<IncomingRequest>,
    /// Requests whose operators have gone, not yet told.
    abandoned: Vec<RequestId>,
    /// Calls of [`receive`](Self::receive) until it looks for operators that have gone.
    until_check: u32,
}

/// The queues between the loop and the thread.
#[derive(Debug)]
pub struct Queues {
    requests: ArrayQueue<IncomingRequest>,
    abandoned: ArrayQueue<RequestId>,
    replies: ArrayQueue<(RequestId, ReplyMessage)>,
    closed: AtomicBool,
}

/// Most requests that the loop takes at a time, so that their replies find room.
const REQUESTS: usize = 8;
/// How long the thread sleeps when there is nothing to do: a fraction of a period.
const POLL_INTERVAL: Duration = Duration::from_micros(100);
/// Most requests that wait for the loop beside stops: as many as all operators can have without a reply.
const BACKLOG: usize = MAX_OPERATORS * MAX_UNANSWERED;
/// Calls of [`RequestIo::receive`] between two checks for operators that have gone.
const CHECK_INTERVAL: u32 = 100;

impl RequestBridge {
    /// A bridge for a clock; at most `unanswered` requests will be without a reply at a time. A thread asks the system
    /// for `scheduling` and runs on with whatever it is granted.
    ///
    /// # Errors
    /// The operating system refused another thread.
    pub fn new(
        server: RequestServer,
        clock: Clock,
        unanswered: usize,
        scheduling: Scheduling,
    ) -> Result<Self, NodeError> {
        let mut io = RequestIo::new(server);
        if clock == Clock::Lockstep {
            return Ok(RequestBridge::Inline(io));
        }
        let queues = Arc::new(Queues {
            requests: ArrayQueue::new(REQUESTS),
            abandoned: ArrayQueue::new(REQUESTS),
            // A stop may refuse all that wait, in a period in which others are refused on arrival.
            replies: ArrayQueue::new(2 * unanswered),
            closed: AtomicBool::new(false),
        });
        let shared = Arc::clone(&queues);
        let thread = std::thread::Builder::new()
            .name("request-bridge".to_owned())
            .spawn(move || {
                let _granted = scheduling.request();
                io.serve(&shared);
                io
            })
            .map_err(NodeError::Thread)?;
        Ok(RequestBridge::Threaded { queues, thread })
    }

    /// Whether the loop itself serves the operators: in lockstep.
    pub fn is_inline(&self) -> bool {
        matches!(self, RequestBridge::Inline(_))
    }

    /// Receives what operators have sent, unless a thread does. Returns the most requests to take now.
    pub fn receive(&mut self) -> usize {
        match self {
            RequestBridge::Inline(io) => {
                io.receive();
                usize::MAX
            }
            RequestBridge::Threaded { .. } => REQUESTS,
        }
    }

    /// The next request whose operator has gone without waiting for the reply, if any.
    pub fn next_abandoned(&mut self) -> Option<RequestId> {
        match self {
            RequestBridge::Inline(io) => io.abandoned.pop(),
            RequestBridge::Threaded { queues, .. } => queues.abandoned.pop(),
        }
    }

    /// The next request that was received, stops first. With a thread it neither allocates nor waits, and neither does
    /// [`reply`](Self::reply).
    pub fn next_request(&mut self) -> Option<IncomingRequest> {
        match self {
            RequestBridge::Inline(io) => io.next_request(),
            RequestBridge::Threaded { queues, .. } => queues.requests.pop(),
        }
    }

    /// Sends the reply to a request.
    pub fn reply(&mut self, id: RequestId, reply: ReplyMessage) {
        match self {
            RequestBridge::Inline(io) => io.reply(id, &reply),
            // There is room for as many as can be unanswered.
            RequestBridge::Threaded { queues, .. } => drop(queues.replies.push((id, reply))),
        }
    }

    /// Ends the thread, if there is one, after it has sent all replies. Returns the requests that the loop never took.
    pub fn close(self) -> (RequestIo, Vec<IncomingRequest>) {
        match self {
            RequestBridge::Inline(io) => (io, Vec::new()),
            RequestBridge::Threaded { queues, thread } => {
                queues.closed.store(true, Ordering::Release);
                let io = thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                (io, std::iter::from_fn(|| queues.requests.pop()).collect())
            }
        }
    }
}

impl RequestIo {
    fn new(server: RequestServer) -> Self {
        Self {
            server,
            unanswered: HashMap::new(),
            last: RequestId::default(),
            stops: VecDeque::new(),
            others: VecDeque::new(),
            abandoned: Vec::new(),
            until_check: CHECK_INTERVAL,
        }
    }

    /// Receives all requests that operators have sent. No reply leaves meanwhile, and an operator can have only so many
    /// requests without one: so each operator is served, however many requests another one sends.
    pub fn receive(&mut self) {
        for _ in 0..BACKLOG {
            // An operator whose memory cannot be reached has gone; the next call finds the others.
            let Some((message, answer)) = self.server.next_request().ok().flatten() else { break };
            let is_stop = message.checked().is_ok_and(|request| request.is_stop());
            let received = if is_stop { &mut self.stops } else { &mut self.others };
            if received.len() >= BACKLOG {
                // Only an operator that does not wait for its replies can send more. Dropping the answer tells it so.
                continue;
            }
            let id = self.last.next();
            self.last = id;
            self.unanswered.insert(id, answer);
            received.push_back(IncomingRequest { id, message });
        }
        self.until_check -= 1;
        if self.until_check == 0 {
            self.until_check = CHECK_INTERVAL;
            let Self { unanswered, abandoned, others, .. } = self;
            let gone: Vec<RequestId> =
                unanswered.extract_if(|_, answer| !answer.is_wanted()).map(|(id, _)| id).collect();
            // Those that were passed on already wait in the loop's queue.
            others.retain(|waiting| !gone.contains(&waiting.id));
            abandoned.extend(gone);
        }
    }

    /// The next request that was received, stops first.
    pub fn next_request(&mut self) -> Option<IncomingRequest> {
        self.stops.pop_front().or_else(|| self.others.pop_front())
    }

    /// Sends the reply to a request.
    pub fn reply(&mut self, id: RequestId, reply: &ReplyMessage) {
        if let Some(answer) = self.unanswered.remove(&id) {
            // Whether the operator is still there to receive it changes nothing.
            answer.reply(reply);
        }
    }

    /// Moves requests and replies between shared memory and the queues until the queues are closed.
    fn serve(&mut self, queues: &Queues) {
        loop {
            // In this order: after closing nothing is replied, so that an empty queue is the end.
            let closed = queues.closed.load(Ordering::Acquire);
            while let Some((id, reply)) = queues.replies.pop() {
                self.reply(id, &reply);
            }
            if closed {
                return;
            }
            self.receive();
            // The loop only takes out: there is still room.
            while !queues.requests.is_full()
                && let Some(request) = self.next_request()
            {
                let _ = queues.requests.push(request);
            }
            while !queues.abandoned.is_full()
                && let Some(id) = self.abandoned.pop()
            {
                let _ = queues.abandoned.push(id);
            }
            std::thread::sleep(POLL_INTERVAL);
        }
    }
}
