//! The lines of a stream that were read and not sent yet.
//!
//! Timed lines are sent in their order, each at its time. The others are for at once: what a newer one overrides is
//! passed over, so that the newest position of a stick counts and no old one is carried out late. A stop overtakes
//! everything, and takes the place of all lines before it.

use std::collections::VecDeque;

use crate::script::TimedRequest;

/// Most lines that wait: with more the input is not read on.
pub const CAPACITY: usize = 65_536;

/// A line that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadLine {
    /// Number of the line, from 1.
    pub number: u64,
    /// What it says.
    pub timed: TimedRequest,
    /// When it was read, in the reader's count (ns).
    pub read_ns: u64,
}

/// A line that is not sent, because a newer one took its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Superseded {
    /// The line.
    pub line: ReadLine,
    /// Number of the newer line.
    pub by: u64,
}

/// The lines that wait to be sent.
#[derive(Clone, Debug, Default)]
pub struct LineQueue {
    for_at_once: VecDeque<ReadLine>,
    timed: VecDeque<ReadLine>,
}

impl LineQueue {
    /// Adds a line, and returns those whose place it takes.
    pub fn push(&mut self, line: ReadLine) -> Vec<Superseded> {
        let Self { for_at_once, timed } = self;
        if line.timed.time.is_some() {
            timed.push_back(line);
            return Vec::new();
        }
        let mut older = Vec::new();
        if line.timed.request.is_stop() {
            older.extend(for_at_once.drain(..).chain(timed.drain(..)));
            older.sort_by_key(|line| line.number);
        } else {
            for_at_once.retain(|waiting| {
                let is_overridden = waiting.timed.request.is_overridden_by(&line.timed.request);
                older.extend(is_overridden.then_some(*waiting));
                !is_overridden
            });
        }
        for_at_once.push_back(line);
        older.into_iter().map(|older| Superseded { line: older, by: line.number }).collect()
    }

    /// Takes out the next line for at once. While the line before has no reply (`is_waiting`), only a stop.
    pub fn next_for_at_once(&mut self, is_waiting: bool) -> Option<ReadLine> {
        let first = self.for_at_once.front()?;
        if is_waiting && !first.timed.request.is_stop() { None } else { self.for_at_once.pop_front() }
    }

    /// The timed line that comes next.
    pub fn next_timed(&self) -> Option<&ReadLine> {
        self.timed.front()
    }

    /// Takes out the timed line that comes next.
    pub fn take_timed(&mut self) -> Option<ReadLine> {
        self.timed.pop_front()
    }

    /// Number of lines that wait.
    pub fn len(&self) -> usize {
        self.for_at_once.len() + self.timed.len()
    }

    /// Whether no line waits.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::Reader;

    /// Reads lines and gives the queue with the numbers of superseded lines and of those that took their places.
    fn queued(text: &str) -> (LineQueue, Vec<(u64, u64)>) {
        let mut queue = LineQueue::default();
        let mut superseded = Vec::new();
        for (line, number) in Reader::read_all("f", text.as_bytes()).unwrap().into_iter().zip(1..) {
            let line = ReadLine { number, timed: line, read_ns: 0 };
            superseded.extend(queue.push(line).into_iter().map(|old| (old.line.number, old.by)));
        }
        (queue, superseded)
    }

    fn sent(mut queue: LineQueue) -> Vec<u64> {
        let mut sent: Vec<u64> = Vec::new();
        sent.extend(std::iter::from_fn(|| queue.next_for_at_once(false)).map(|line| line.number));
        sent.extend(std::iter::from_fn(|| queue.take_timed()).map(|line| line.number));
        sent
    }

    #[test]
    fn only_the_newest_position_of_a_stick_is_sent() {
        let text = "{\"turn_deg\":5,\"speed\":1}\n".repeat(1000) + "{\"turn_deg\":0,\"speed\":1}\n";
        let (queue, superseded) = queued(&text);
        assert_eq!(superseded.first(), Some(&(1, 2)));
        assert_eq!((superseded.len(), sent(queue)), (1000, vec![1001]));
    }

    #[test]
    fn nothing_is_passed_over_that_the_newer_line_does_not_set() {
        let (queue, superseded) = queued("{\"turn_deg\":5}\n{\"speed\":1}\n{\"turn_deg\":6}\n");
        assert_eq!((sent(queue), superseded), (vec![2, 3], vec![(1, 3)]));
        let (queue, superseded) = queued("{\"intent\":\"reset\"}\n{\"intent\":\"walk\"}\n{\"turn_deg\":6}\n");
        assert_eq!((sent(queue), superseded), (vec![1, 2, 3], vec![]));
    }

    #[test]
    fn a_stop_overtakes_everything_before_it_and_nothing_after_it() {
        let text = "{\"t\":30,\"speed\":1.1}\n{\"intent\":\"walk\"}\n{\"intent\":\"stop\"}\n{\"t\":40,\"turn_deg\":1}\n\
                    {\"intent\":\"walk\"}\n";
        let (mut queue, superseded) = queued(text);
        assert_eq!(superseded, [(1, 3), (2, 3)]);
        assert_eq!(queue.next_for_at_once(true).map(|line| line.number), Some(3), "it waits for no reply");
        assert_eq!(queue.next_for_at_once(true), None, "the walk does");
        assert_eq!(sent(queue), [5, 4]);
    }

    #[test]
    fn timed_lines_keep_their_order_and_are_never_passed_over() {
        let (queue, superseded) = queued("{\"t\":1,\"speed\":1}\n{\"t\":2,\"speed\":1.1}\n{\"speed\":1.2}\n");
        assert_eq!((sent(queue), superseded), (vec![3, 1, 2], vec![]));
    }
}
