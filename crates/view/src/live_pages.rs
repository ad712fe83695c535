//! The pages of a robot that is running: what they all get, and which of them drives.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

use scene::{AskedPush, ToPage};
use tokio::sync::broadcast;

use crate::live_feed::LiveTexts;
use crate::teleoperation::Order;

/// Answers that a slow page may be behind before it misses some.
const ANSWERS: usize = 256;
/// Among the answers: another page may drive now.
pub(crate) const HANDOVER: &str = "";

/// The pages of a robot that is running.
pub(crate) struct LivePages {
    pub(crate) texts: LiveTexts,
    pub(crate) answers: broadcast::Sender<Arc<str>>,
    orders: Sender<Order>,
    pushes: Sender<AskedPush>,
    numbers: Mutex<PageNumbers>,
}

#[derive(Default)]
struct PageNumbers {
    /// The page that drives.
    driver: Option<u64>,
    /// The page that came last.
    last: u64,
}

impl LivePages {
    /// No page yet, and where the orders of pages and their pushes arrive.
    pub(crate) fn new(texts: LiveTexts) -> (Self, Receiver<Order>, Receiver<AskedPush>) {
        let (answers, _) = broadcast::channel(ANSWERS);
        let ((orders, ordered), (pushes, pushed)) = (channel(), channel());
        (Self { texts, answers, orders, pushes, numbers: Mutex::default() }, ordered, pushed)
    }

    /// A number for a new page.
    pub(crate) fn enter(&self) -> u64 {
        let mut numbers = self.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        numbers.last += 1;
        numbers.last
    }

    /// Lets a page drive, if no other does, or ends its driving.
    pub(crate) fn set_driver(&self, page: u64, drives: bool) {
        let mut numbers = self.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        let next = match numbers.driver {
            None if drives => Some(page),
            Some(driver) if driver == page && !drives => None,
            same => same,
        };
        if std::mem::replace(&mut numbers.driver, next) != next {
            self.order(Order::Handover);
        }
        drop(numbers);
        // Every page is to know.
        let _ = self.answers.send(Arc::from(HANDOVER));
    }

    /// Who drives, as a page is told.
    pub(crate) fn driver_text(&self, page: u64) -> Arc<str> {
        let driver = self.numbers.lock().unwrap_or_else(PoisonError::into_inner).driver;
        ToPage::Driver { you: driver == Some(page), taken: driver.is_some() }.text()
    }

    /// Whether a page drives.
    pub(crate) fn is_driver(&self, page: u64) -> bool {
        self.numbers.lock().unwrap_or_else(PoisonError::into_inner).driver == Some(page)
    }

    /// Passes an order on.
    pub(crate) fn order(&self, order: Order) {
        // Without the thread of teleoperation nothing can be carried out; both end with this process.
        let _ = self.orders.send(order);
    }

    /// Passes a push on.
    pub(crate) fn push(&self, push: AskedPush) {
        // The thread of pushes ends with this process, too.
        let _ = self.pushes.send(push);
    }
}
