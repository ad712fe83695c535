//! The tick allocates nothing: walking, swapping feet, answering requests, braking, standing, and with bad measurements.
//!
//! Method: an allocator that counts what this thread asks of it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use controller::Intent;
use gait::Request;
use halfstep_tests::walking::Walking;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: hands everything to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn whatever_happens() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1]))) > 0, "the allocator does not count");

    let mut walking = Walking::begin(1);
    let change = Request { turn: Some(0.05), speed: Some(1.05), extension: Some(0.03) };
    let nonsense = Request { turn: Some(f64::NAN), speed: Some(9.0), extension: None };
    let count = allocations(|| {
        for tick in 0..6000 {
            let request = match tick {
                500 => Some((&change, None)),
                900 => Some((&nonsense, None)),
                3000 => Some((&change, Some(Intent::Hold))),
                5000 => Some((&change, Some(Intent::Walk))),
                _ => None,
            };
            walking.tick(request);
        }
        for _ in 0..100 {
            walking.controller.tick(1e-3, None, None);
        }
    });
    assert_eq!(count, 0, "in 6100 ticks of controller and plant");
}
