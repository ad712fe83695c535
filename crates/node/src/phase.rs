//! The phase between both loops in real time: the plant's deadlines lie half a period after the controller's.
//!
//! Both loops use one clock and keep their phase. If their deadlines fell together, chance would decide whether a
//! setpoint is a little early or a whole period late. So the plant places its first deadline by the first setpoint, and
//! moves it when setpoints come at another phase for a while: after the controller was restarted.

use std::time::Duration;

use runtime::Period;

/// Setpoints from which a phase is taken: their median, since a loop that wakes late writes late.
const WINDOW: usize = 64;
/// Part of a period by which the phase may differ.
const TOLERANCE: i64 = 8;

/// Follows the phase of the other loop.
#[derive(Clone, Debug, Default)]
pub(crate) struct PhaseFollower {
    /// How much later than now the deadlines should be (ns), by each of the last setpoints.
    lags: heapless::Vec<i64, WINDOW>,
    last_written_ns: Option<u64>,
}

impl PhaseFollower {
    /// Deadlines half a period after those of the loop that wrote its first message at `written_ns`. The first one is
    /// not before that loop's second message.
    pub(crate) fn first(length: Duration, written_ns: u64) -> Period {
        Period::on_grid(length, written_ns.saturating_add(length.as_nanos() as u64 / 2), length * 3 / 4)
    }

    /// Takes in when the newest message was written, and moves the period if its phase has been wrong for a while.
    pub(crate) fn follow(&mut self, written_ns: u64, period: &mut Period) {
        if self.last_written_ns.replace(written_ns) == Some(written_ns) {
            return;
        }
        // There is room: a full window is cleared below.
        let _ = self.lags.push(lag(written_ns, period.deadline_ns(), period.length_ns()));
        if self.lags.is_full() {
            self.lags.sort_unstable();
            let median = self.lags[WINDOW / 2];
            self.lags.clear();
            if median.abs() > period.length_ns() as i64 / TOLERANCE {
                period.shift(median);
            }
        }
    }
}

/// How much later the deadlines should be (ns), at most half a period either way, if the other loop's message is
/// written half a period before them.
fn lag(written_ns: u64, deadline_ns: u64, length_ns: u64) -> i64 {
    let (length, half) = (length_ns as i64, length_ns as i64 / 2);
    (written_ns.wrapping_sub(deadline_ns) as i64).rem_euclid(length) - half + (length % 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    #[test]
    fn lag_is_zero_half_a_period_after_the_message() {
        assert_eq!(lag(10 * MS, 10 * MS + MS / 2, MS), 0);
        assert_eq!(lag(10 * MS, 17 * MS + MS / 2, MS), 0);
        assert_eq!(lag(10 * MS + 100, 10 * MS + MS / 2, MS), 100, "written later: the deadline should be later");
        assert_eq!(lag(10 * MS, 10 * MS, MS), -(MS as i64) / 2);
        assert_eq!(lag(10 * MS, 10 * MS + 1, MS), MS as i64 / 2 - 1);
    }

    #[test]
    fn first_deadline_comes_half_a_period_after_the_second_message() {
        let now = runtime::now_ns();
        let length = Duration::from_secs(4);
        let period = PhaseFollower::first(length, now);
        assert_eq!(period.deadline_ns(), now + 6_000_000_000);
    }

    /// Follows a loop that wakes late now and then, and gives the phase after each message.
    fn followed(origin_ns: u64, mut period: Period, messages: u64) -> (Period, i64) {
        let mut follower = PhaseFollower::default();
        for tick in 0..messages {
            let late = if tick % 3 == 0 { 400_000 } else { tick % 7 * 1000 };
            follower.follow(origin_ns + tick * MS + late, &mut period);
        }
        (period, lag(origin_ns, period.deadline_ns(), MS))
    }

    #[test]
    fn a_wrong_phase_is_corrected_once_and_a_right_one_is_kept() {
        let grid = Period::on_grid(Duration::from_millis(1), MS / 2, Duration::ZERO);
        let (kept, _) = followed(0, grid, 1000);
        assert_eq!(kept.deadline_ns(), grid.deadline_ns());
        for wrong in [150_000, 300_000, 499_000, 500_000, 700_000] {
            let (_, lag) = followed(wrong, grid, 1000);
            assert!(lag.abs() < 20_000, "after a controller with phase {wrong} it lags by {lag} ns");
        }
    }

    #[test]
    fn a_message_that_is_read_twice_counts_once() {
        let mut period = Period::on_grid(Duration::from_millis(1), 0, Duration::ZERO);
        let before = period.deadline_ns();
        let mut follower = PhaseFollower::default();
        (0..1000).for_each(|_| follower.follow(7, &mut period));
        assert_eq!(period.deadline_ns(), before);
    }
}
