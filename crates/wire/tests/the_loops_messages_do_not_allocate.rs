//! The loop's messages do not allocate: setpoint and measurement, written, read and checked. A counting allocator
//! counts.

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::time::Instant;

use common::{MECHANISM, measurement, own_instance, setpoint};
use wire::{ControllerPorts, PlantPorts, SetpointMessage};

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: everything is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn a_round_trip_of_measurement_and_setpoint_does_not_allocate() {
    let (instance, _leftovers) = own_instance();
    let mut controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    assert!(allocations(|| drop(std::hint::black_box(Box::new(1)))) > 0, "the allocator counts");

    const ROUNDS: u64 = 100_000;
    let began = Instant::now();
    let count = allocations(|| {
        for tick in 0..ROUNDS {
            plant.measurements.write(&measurement(tick));
            let message = controller.measurements.latest().unwrap();
            assert_eq!(message.measurement().sample, message.sample);
            let answer = SetpointMessage { tick: message.tick, ..setpoint(3) };
            controller.setpoints.write(&answer);
            let received = plant.setpoints.latest().unwrap();
            assert!(received.checked().is_ok());
            assert_eq!(received.tick, tick);
        }
    });
    println!("{:.0} ns for a round trip in one process", began.elapsed().as_nanos() as f64 / ROUNDS as f64);
    assert_eq!(count, 0);

    let mut nonsense = setpoint(0);
    nonsense.angles[4] = f64::NAN;
    assert_eq!(allocations(|| assert!(nonsense.checked().is_err())), 0, "refusing does not allocate either");
}
