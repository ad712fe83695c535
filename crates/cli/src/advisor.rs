//! Who settles the controller's inquiries: the loop itself in lockstep, so that a run depends on its inputs only; another
//! thread in real time, so that no tick waits for it.

use std::thread::JoinHandle;

use controller::{Controller, Inquiry};
use crossbeam::channel::{Receiver, Sender, bounded};
use runtime::Scheduling;

use crate::turns::Clock;

/// Settles one inquiry after the other.
pub enum Advisor {
    /// Within the loop.
    Here,
    /// Beside the loop.
    Beside {
        /// Inquiries to settle; `None` once it is to end.
        open: Option<Sender<Box<Inquiry>>>,
        /// Settled ones.
        settled: Receiver<Box<Inquiry>>,
        /// Ends with the sender.
        thread: Option<JoinHandle<()>>,
    },
}

impl Advisor {
    /// For a clock. A thread asks the system for `scheduling`, and does with what it gets.
    pub fn new(clock: Clock, scheduling: Scheduling) -> Self {
        if clock == Clock::Lockstep {
            return Advisor::Here;
        }
        let (open, inbox) = bounded::<Box<Inquiry>>(1);
        let (outbox, settled) = bounded(1);
        let thread = std::thread::spawn(move || {
            let _granted = scheduling.ask();
            for mut inquiry in inbox {
                inquiry.settle();
                if outbox.send(inquiry).is_err() {
                    break;
                }
            }
        });
        Advisor::Beside { open: Some(open), settled, thread: Some(thread) }
    }

    /// Takes what is to be settled and gives back what is; says whether it gave something back. Waits for nothing beside
    /// the loop.
    pub fn serve(&mut self, controller: &mut Controller) -> bool {
        match self {
            Advisor::Here => {
                let Some(mut inquiry) = controller.inquiry() else { return false };
                inquiry.settle();
                controller.give_back(inquiry);
                true
            }
            Advisor::Beside { open, settled, .. } => {
                let given_back = settled.try_recv().map(|inquiry| controller.give_back(inquiry)).is_ok();
                // There is one inquiry at most, so there is room for it.
                if let (Some(open), Some(inquiry)) = (open, controller.inquiry()) {
                    let _ = open.try_send(inquiry);
                }
                given_back
            }
        }
    }
}

impl Drop for Advisor {
    fn drop(&mut self) {
        if let Advisor::Beside { open, thread, .. } = self {
            open.take();
            if let Some(thread) = thread.take() {
                let _ = thread.join();
            }
        }
    }
}
