//! Many walks, on all cores.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Size of a thread's stack (bytes): several walks fit, each of which is a large value.
const STACK: usize = 64 << 20;

/// `walk(0)` to `walk(count - 1)`, in this order whoever is first. Somebody who watches is told how far it is.
pub(crate) fn on_all_cores<T: Send>(count: usize, walk: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let results: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let is_watched = std::io::stderr().is_terminal();
    let worker = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(place) = results.get(index) else { break };
            let result = walk(index);
            *place.lock().expect("no walk panicked") = Some(result);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            if is_watched {
                eprint!("\r{done}/{count} ");
            }
        }
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, worker);
            thread.expect("a thread for each core");
        }
    });
    if is_watched {
        eprintln!();
    }
    results.into_iter().map(|place| place.into_inner().expect("no walk panicked").expect("all were walked")).collect()
}
