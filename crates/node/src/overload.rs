//! Whether a loop is overloaded, by the deadlines that it misses.

/// Counts missed deadlines up and kept ones down, so that a loop that misses most of its deadlines is found at any
/// rate, whether its work takes a little too long each time or it was halted once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Overload {
    limit: u64,
    level: u64,
}

impl Overload {
    /// Overload is a surplus of `limit` missed deadlines; 0 is never.
    pub(crate) fn new(limit: u64) -> Self {
        Self { limit, level: 0 }
    }

    /// Takes in how many deadlines a cycle missed. Returns whether the limit is reached, and begins anew then.
    pub(crate) fn add(&mut self, missed: u64) -> bool {
        self.level = if missed > 0 { self.level.saturating_add(missed) } else { self.level.saturating_sub(1) };
        let is_reached = self.limit > 0 && self.level >= self.limit;
        if is_reached {
            self.level = 0;
        }
        is_reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cycle in which a limit of 250 is reached, of a loop whose work takes `load` periods.
    fn reached(load: f64) -> Option<u64> {
        let (mut overload, mut done, mut next) = (Overload::new(250), 0.0, 1.0);
        (1..10_000).find(|_| {
            // The work ends at `done`, the deadline is `next`; a late loop skips whole periods.
            done += load;
            let late: f64 = done - next;
            let skipped = late.max(0.0).floor();
            next += 1.0 + skipped;
            let missed = if late > 0.0 { skipped as u64 + 1 } else { 0 };
            done = done.max(next - 1.0);
            overload.add(missed)
        })
    }

    #[test]
    fn a_loop_above_its_capacity_is_found_at_any_load() {
        for (load, cycle) in [(1.01, 250), (1.2, 250), (1.9, 132), (3.0, 84)] {
            let found = reached(load).unwrap_or_else(|| panic!("{load} is not found"));
            assert!(found <= cycle, "{load} is found after {found} cycles");
        }
        assert_eq!(reached(0.99), None);
    }

    #[test]
    fn a_stall_counts_at_once_and_single_misses_are_forgotten() {
        let mut overload = Overload::new(250);
        assert!(!overload.add(249));
        assert!(overload.add(1));
        assert!(!overload.add(1), "it begins anew");
        let mut seldom = Overload::new(250);
        assert!((0..100_000).all(|cycle| !seldom.add(u64::from(cycle % 3 == 0))));
        assert!(!Overload::new(0).add(u64::MAX));
    }
}
