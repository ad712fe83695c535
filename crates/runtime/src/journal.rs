//! The journal: entries from the loop, processed by another thread.
//!
//! The loop pushes `Copy` values into a bounded ring; another thread takes them out and does what the loop must not:
//! format, send, write files. When the thread falls behind, the *newest* entry is refused and counted, since the first
//! entries explain the later ones. Every accepted entry is delivered once and in order.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crossbeam::queue::ArrayQueue;

/// Time that the thread sleeps when the ring is empty. The loop does not wake it, since that would be a system call.
const POLL_INTERVAL: Duration = Duration::from_millis(1);

/// The loop's end of a journal. Dropping it closes the journal.
#[derive(Debug)]
pub struct Journal<T: Copy + Send + 'static> {
    ring: Arc<Ring<T>>,
}

/// The other end of a journal: the thread that takes the entries out.
#[derive(Debug)]
#[must_use = "the last entries are certain to be written only after `join`"]
pub struct JournalEnd<S> {
    thread: JoinHandle<Written<S>>,
}

/// The result of a closed journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written<S> {
    /// The sink that received the entries.
    pub sink: S,
    /// Number of entries that were lost because the ring was full.
    pub dropped: u64,
}

/// The bounded ring between the two threads.
#[derive(Debug)]
struct Ring<T> {
    entries: ArrayQueue<T>,
    /// Number of entries that were lost.
    dropped: AtomicU64,
    /// Whether the loop has dropped its end.
    closed: AtomicBool,
    /// Whether the thread has ended.
    ended: AtomicBool,
}

/// Notes that the thread has ended, also by a panic.
struct EndMark<T>(Arc<Ring<T>>);

impl<T> Drop for EndMark<T> {
    fn drop(&mut self) {
        self.0.ended.store(true, Ordering::Release);
    }
}

impl<T: Copy + Send + 'static> Journal<T> {
    /// Opens a journal with room for `capacity` entries, and starts a thread called `name` that passes each entry to
    /// `take` together with the `sink`.
    ///
    /// # Errors
    /// The system cannot start another thread.
    ///
    /// # Panics
    /// `capacity` is 0.
    pub fn open<S: Send + 'static>(
        name: &str,
        capacity: usize,
        mut sink: S,
        mut take: impl FnMut(&mut S, T) + Send + 'static,
    ) -> std::io::Result<(Self, JournalEnd<S>)> {
        let ring = Arc::new(Ring {
            entries: ArrayQueue::new(capacity),
            dropped: AtomicU64::new(0),
            closed: AtomicBool::new(false),
            ended: AtomicBool::new(false),
        });
        let mark = EndMark(Arc::clone(&ring));
        let thread = std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            let reader = &mark.0;
            loop {
                // In this order: nothing is pushed after closing, so that an empty ring is the end.
                let closed = reader.closed.load(Ordering::Acquire);
                while let Some(entry) = reader.entries.pop() {
                    take(&mut sink, entry);
                }
                if closed {
                    return Written { sink, dropped: reader.dropped.load(Ordering::Relaxed) };
                }
                std::thread::sleep(POLL_INTERVAL);
            }
        })?;
        Ok((Self { ring }, JournalEnd { thread }))
    }

    /// Adds an entry; `false` if the ring was full and the entry is lost. Neither allocates nor waits.
    #[inline]
    pub fn push(&mut self, entry: T) -> bool {
        let accepted = self.ring.entries.push(entry).is_ok();
        if !accepted {
            self.ring.dropped.fetch_add(1, Ordering::Relaxed);
        }
        accepted
    }

    /// Whether the thread has ended though this end is open: it panicked. What is pushed now is lost.
    pub fn has_ended(&self) -> bool {
        self.ring.ended.load(Ordering::Acquire)
    }

    /// Number of entries lost so far.
    pub fn dropped(&self) -> u64 {
        self.ring.dropped.load(Ordering::Relaxed)
    }
}

impl<T: Copy + Send + 'static> Drop for Journal<T> {
    fn drop(&mut self) {
        self.ring.closed.store(true, Ordering::Release);
    }
}

impl<S> JournalEnd<S> {
    /// Waits until the [`Journal`] is dropped and its last entry taken, and returns the sink; `None` if taking an entry
    /// panicked.
    pub fn join(self) -> Option<Written<S>> {
        self.thread.join().ok()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn a_closed_journal_has_delivered_every_accepted_entry_in_order() {
        let (mut journal, end) = Journal::open("test", 100_000, Vec::new(), Vec::push).unwrap();
        let entries: Vec<u32> = (0..100_000).collect();
        assert!(entries.iter().all(|&entry| journal.push(entry)));
        drop(journal);
        assert_eq!(end.join(), Some(Written { sink: entries, dropped: 0 }));
    }

    #[test]
    fn a_full_journal_refuses_the_newest_entry_and_counts_it() {
        // The thread takes the first entry and is then held up until the ring has overflowed.
        let (taken, first_is_taken) = mpsc::channel();
        let (go_on, held_up) = mpsc::channel::<()>();
        let take = move |sink: &mut Vec<u32>, entry| {
            sink.push(entry);
            if entry == 0 {
                taken.send(()).unwrap();
                held_up.recv().unwrap();
            }
        };
        let (mut journal, end) = Journal::open("test", 4, Vec::new(), take).unwrap();
        journal.push(0);
        first_is_taken.recv().unwrap();
        let accepted: Vec<bool> = (1..8).map(|entry| journal.push(entry)).collect();
        assert_eq!(accepted, [true, true, true, true, false, false, false]);
        assert_eq!(journal.dropped(), 3);
        go_on.send(()).unwrap();
        drop(journal);
        assert_eq!(end.join(), Some(Written { sink: vec![0, 1, 2, 3, 4], dropped: 3 }));
    }

    #[test]
    fn a_journal_whose_thread_panicked_has_ended_and_nobody_waits_for_it() {
        let (mut journal, end) = Journal::open("test", 4, (), |_, _: u8| panic!("no space left")).unwrap();
        assert!(!journal.has_ended());
        journal.push(0);
        while !journal.has_ended() {
            std::thread::yield_now();
        }
        drop(journal);
        assert_eq!(end.join(), None);
    }
}
