//! The journal: what the loop has to tell, written down by somebody else.
//!
//! The loop pushes `Copy` values into a bounded ring; a thread of its own takes them out and does with them what the
//! loop must not: format, send, write files. When the thread falls behind, the *newest* entry is refused and counted:
//! what happened first explains what came after, and every accepted entry is delivered once and in order.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crossbeam::queue::ArrayQueue;

/// How long the thread sleeps when there is nothing to do: were the loop to wake it, that would be a system call.
const NAP: Duration = Duration::from_millis(1);

/// The loop's side of a journal. Dropping it closes the journal.
#[derive(Debug)]
pub struct Journal<T: Copy + Send + 'static> {
    ring: Arc<Ring<T>>,
}

/// The side of whoever opened the journal: the thread that takes the entries out.
#[derive(Debug)]
#[must_use = "the last entries are certain to be written only after `join`"]
pub struct JournalEnd<S> {
    thread: JoinHandle<Written<S>>,
}

/// What has become of a closed journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written<S> {
    /// What the entries were handed to.
    pub sink: S,
    /// How many entries found the ring full.
    pub dropped: u64,
}

#[derive(Debug)]
struct Ring<T> {
    entries: ArrayQueue<T>,
    dropped: AtomicU64,
    closed: AtomicBool,
}

impl<T: Copy + Send + 'static> Journal<T> {
    /// Opens a journal with room for `capacity` entries, and starts the thread called `name` that hands each entry to
    /// `take` together with the `sink`.
    ///
    /// # Errors
    /// The system refuses another thread.
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
        });
        let reader = Arc::clone(&ring);
        let thread = std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            loop {
                // In this order: after closing nothing is pushed, so that an empty ring is the end.
                let closed = reader.closed.load(Ordering::Acquire);
                while let Some(entry) = reader.entries.pop() {
                    take(&mut sink, entry);
                }
                if closed {
                    return Written { sink, dropped: reader.dropped.load(Ordering::Relaxed) };
                }
                std::thread::sleep(NAP);
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

    /// How many entries were lost so far.
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
    /// Waits until the [`Journal`] was dropped and its last entry taken, and gives the sink back.
    ///
    /// # Panics
    /// If taking an entry panicked, with the same panic.
    pub fn join(self) -> Written<S> {
        self.thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn closing_delivers_every_accepted_entry_in_order() {
        let (mut journal, end) = Journal::open("test", 100_000, Vec::new(), Vec::push).unwrap();
        let entries: Vec<u32> = (0..100_000).collect();
        assert!(entries.iter().all(|&entry| journal.push(entry)));
        drop(journal);
        assert_eq!(end.join(), Written { sink: entries, dropped: 0 });
    }

    #[test]
    fn a_full_ring_refuses_the_newest_and_counts_it() {
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
        assert_eq!(end.join(), Written { sink: vec![0, 1, 2, 3, 4], dropped: 3 });
    }

    #[test]
    #[should_panic(expected = "no space left")]
    fn a_panic_while_taking_is_not_swallowed() {
        let (mut journal, end) = Journal::open("test", 4, (), |_, _: u8| panic!("no space left")).unwrap();
        journal.push(0);
        drop(journal);
        end.join();
    }
}
