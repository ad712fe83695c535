//! The command arbiter: which source has control authority, and for how long.
//!
//! A *streamed* request gives its source **control authority** for the request's command timeout. Each further request
//! of the source, an empty heartbeat included, restarts the timeout. A source that sends nothing for longer loses its
//! authority and its requests are obsolete: the robot is to stop. The next source that sends takes authority again.
//!
//! While a source has authority, sources of lower priority are refused. The controller grants a stop to them, too.
//! Sources of higher priority are granted what they request; with a stream they take authority over.
//!
//! A *latched* request holds no authority beyond its instant. From the source in control it ends the stream: what it
//! requested stays in effect. From a source of higher priority it leaves the stream in control, whose timeout still
//! stops the robot, unless that walks to a destination of the other source.

use interface::{COMMAND_TIMEOUT_MAX, ControlAuthority, Lifetime, Request, Source};

/// Command timeout and priorities of the sources.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArbiterParameters {
    /// Command timeout of streamed requests that have none of their own (s). `None` switches it off: what they request
    /// stays in effect until replaced.
    pub timeout: Option<f64>,
    /// All sources, highest priority first.
    pub priority: [Source; Source::OPERATORS.len()],
}

/// Grants control authority to one source at a time. It has no clock: [`advance`](Self::advance) passes the time.
#[derive(Clone, Debug)]
pub struct CommandArbiter {
    parameters: ArbiterParameters,
    authority: Option<Authority>,
}

/// Control authority of one source.
#[derive(Clone, Copy, Debug)]
struct Authority {
    source: Source,
    /// Command timeout (s).
    timeout: f64,
    /// Time since the source's last request (s).
    age: f64,
    /// Whether a request arrived in this very period, which then does not count.
    is_fresh: bool,
}

/// Tolerance for sums of periods (s).
const ROUNDING: f64 = 1e-6;
/// Longest time for which a source that waits for the reply to a request counts as sending (s). An evaluation takes
/// less; if it never ends, the source's authority still does.
const EVALUATION_MAX: f64 = 1.0;

impl CommandArbiter {
    /// No source has authority yet.
    pub fn new(parameters: ArbiterParameters) -> Self {
        Self { parameters, authority: None }
    }

    /// Admits the source of a request, and gives it authority if the request is streamed. A refused request changes
    /// nothing.
    ///
    /// # Errors
    /// A source of higher priority has control authority. Of such a request only a stop may be granted.
    pub fn admit(&mut self, request: &Request) -> Result<(), ControlAuthority> {
        let source = request.source;
        if let Some(other) = self.other_in_control(source)
            && self.outranks(other.source, source)
        {
            return Err(other);
        }
        match self.timeout(request) {
            Some(timeout) => self.authority = Some(Authority { source, timeout, age: 0.0, is_fresh: true }),
            None if self.in_control() == Some(source) => self.authority = None,
            // A source of lower priority keeps its authority: its timeout must still stop the robot.
            None => {}
        }
        Ok(())
    }

    /// Ends a period of `dt` seconds and gives the source whose authority has just expired. To be called after
    /// [`admit`](Self::admit) in each period: a request that has arrived counts, however late the period is.
    ///
    /// * `waiting` – the source whose request is under evaluation: it is not silent, it waits
    pub fn advance(&mut self, dt: f64, waiting: Option<Source>) -> Option<Source> {
        let authority = self.authority.as_mut()?;
        if std::mem::take(&mut authority.is_fresh) {
            return None;
        }
        // A NaN counts as no time.
        authority.age += dt.max(0.0);
        let waits = if waiting == Some(authority.source) { EVALUATION_MAX } else { 0.0 };
        if authority.age <= authority.timeout + waits + ROUNDING {
            return None;
        }
        self.authority.take().map(|authority| authority.source)
    }

    /// The source that has control authority, if any.
    pub fn in_control(&self) -> Option<Source> {
        self.authority.map(|authority| authority.source)
    }

    /// The authority of another source than this one, if any has it.
    pub fn other_in_control(&self, than: Source) -> Option<ControlAuthority> {
        let authority = self.authority.filter(|authority| authority.source != than)?;
        let remaining = (authority.timeout - authority.age).max(0.0);
        Some(ControlAuthority { source: authority.source, remaining })
    }

    /// The command timeout of a request, if it is streamed and not exempt (s).
    fn timeout(&self, request: &Request) -> Option<f64> {
        match request.lifetime {
            Lifetime::Latched | Lifetime::Release => None,
            Lifetime::Streamed => {
                let own = request.timeout.filter(|own| own.is_finite() && *own > 0.0);
                own.map(|own| own.min(COMMAND_TIMEOUT_MAX)).or(self.parameters.timeout)
            }
        }
    }

    /// Whether the first source has the higher priority.
    pub fn outranks(&self, first: Source, second: Source) -> bool {
        first != second
            && self.parameters.priority.into_iter().find(|&source| source == first || source == second) == Some(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1e-3;
    fn arbiter() -> CommandArbiter {
        let priority = [Source::Teleop, Source::Console, Source::Program, Source::Script];
        CommandArbiter::new(ArbiterParameters { timeout: Some(0.5), priority })
    }

    /// A heartbeat of a stream with a timeout of its own.
    fn streamed_for(source: Source, timeout: Option<f64>) -> Request {
        Request { lifetime: Lifetime::Streamed, timeout, ..Request::new(source) }
    }

    fn streamed(source: Source) -> Request {
        streamed_for(source, None)
    }

    /// Passes so many periods, and gives the one, from 1, at which a source's authority expired.
    fn pass(arbiter: &mut CommandArbiter, periods: u32) -> Option<(u32, Source)> {
        let mut expired = None;
        for period in 1..=periods {
            expired = arbiter.advance(DT, None).map(|source| (period, source)).or(expired);
        }
        expired
    }

    #[test]
    fn authority_expires_a_period_after_the_timeout() {
        for (own, timeout_in_periods) in [(None, 500), (Some(0.2), 200), (Some(2.0), 2000), (Some(1e-4), 0)] {
            let mut arbiter = arbiter();
            arbiter.admit(&streamed_for(Source::Script, own)).unwrap();
            assert_eq!(arbiter.advance(DT, None), None, "the request is of this period");
            assert_eq!(pass(&mut arbiter, timeout_in_periods), None, "exactly the timeout");
            assert_eq!(arbiter.in_control(), Some(Source::Script));
            assert_eq!(arbiter.advance(DT, None), Some(Source::Script));
            assert_eq!(arbiter.in_control(), None);
            assert_eq!(pass(&mut arbiter, 5000), None, "authority expires once");
        }
    }

    #[test]
    fn heartbeats_keep_authority() {
        let mut arbiter = arbiter();
        for period in 0..100_000 {
            if period % 500 == 0 {
                arbiter.admit(&streamed(Source::Program)).unwrap();
            }
            assert_eq!(arbiter.advance(DT, None), None);
        }
    }

    #[test]
    fn a_source_takes_authority_again_after_its_timeout() {
        let mut arbiter = arbiter();
        for _ in 0..3 {
            arbiter.admit(&streamed(Source::Script)).unwrap();
            assert_eq!(pass(&mut arbiter, 1000), Some((502, Source::Script)));
            assert_eq!(arbiter.in_control(), None);
        }
    }

    #[test]
    fn a_request_in_the_last_period_counts_however_long_the_period_is() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed(Source::Script)).unwrap();
        assert_eq!(pass(&mut arbiter, 501), None);
        arbiter.admit(&streamed(Source::Script)).unwrap();
        assert_eq!(arbiter.advance(10.0, None), None);
        assert_eq!(arbiter.advance(0.5, None), None);
        assert_eq!(arbiter.advance(DT, None), Some(Source::Script));
    }

    #[test]
    fn a_huge_period_expires_authority_and_a_nan_does_not() {
        for huge in [0.6, 1e300, f64::INFINITY] {
            let mut arbiter = arbiter();
            arbiter.admit(&streamed(Source::Teleop)).unwrap();
            for nothing in [0.0, f64::NAN, -1.0, f64::NEG_INFINITY] {
                assert_eq!(arbiter.advance(nothing, None), None);
            }
            assert_eq!(arbiter.advance(huge, None), Some(Source::Teleop));
        }
    }

    #[test]
    fn an_invalid_timeout_gives_way_to_the_configured_one() {
        for own in [f64::NAN, -1.0, 0.0, f64::INFINITY, f64::NEG_INFINITY] {
            let mut arbiter = arbiter();
            arbiter.admit(&streamed_for(Source::Script, Some(own))).unwrap();
            assert_eq!(pass(&mut arbiter, 1000), Some((502, Source::Script)), "{own}");
        }
    }

    #[test]
    fn without_a_configured_timeout_only_streams_with_their_own_hold_authority() {
        let parameters = ArbiterParameters { timeout: None, ..arbiter().parameters };
        let mut arbiter = CommandArbiter::new(parameters);
        arbiter.admit(&streamed(Source::Teleop)).unwrap();
        assert_eq!(arbiter.in_control(), None);
        arbiter.admit(&streamed_for(Source::Teleop, Some(0.1))).unwrap();
        assert_eq!(pass(&mut arbiter, 1000), Some((102, Source::Teleop)));
    }

    #[test]
    fn a_source_is_refused_while_one_of_higher_priority_is_in_control() {
        let order = arbiter().parameters.priority;
        for (rank, &first) in order.iter().enumerate() {
            for (other, &second) in order.iter().enumerate() {
                for request in [streamed(second), Request::new(second)] {
                    let mut arbiter = arbiter();
                    arbiter.admit(&streamed(first)).unwrap();
                    assert_eq!(pass(&mut arbiter, 101), None);
                    let Err(ControlAuthority { source, remaining }) = arbiter.admit(&request) else {
                        assert!(other <= rank, "{second:?} was admitted while {first:?} was in control");
                        continue;
                    };
                    assert!(other > rank, "{second:?} was refused for {first:?}");
                    assert_eq!(source, first);
                    assert!((remaining - 0.4).abs() < 1e-9, "{remaining}");
                    assert_eq!(pass(&mut arbiter, 401), Some((401, first)), "a refused request changed nothing");
                    assert_eq!(arbiter.admit(&request), Ok(()), "the other's authority expired");
                }
            }
        }
    }

    #[test]
    fn a_source_that_waits_for_its_reply_is_not_silent() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed_for(Source::Script, Some(0.1))).unwrap();
        for _ in 0..1100 {
            assert_eq!(arbiter.advance(DT, Some(Source::Script)), None);
        }
        assert_eq!(arbiter.in_control(), Some(Source::Script));
        arbiter.advance(DT, Some(Source::Script));
        assert_eq!(arbiter.advance(DT, Some(Source::Script)), Some(Source::Script), "no evaluation takes so long");
    }

    #[test]
    fn a_source_that_waits_for_nothing_times_out_while_another_one_waits() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed_for(Source::Script, Some(0.1))).unwrap();
        for _ in 0..101 {
            assert_eq!(arbiter.advance(DT, Some(Source::Console)), None);
        }
        assert_eq!(arbiter.advance(DT, Some(Source::Console)), Some(Source::Script));
    }

    #[test]
    fn no_timeout_is_longer_than_the_longest() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed_for(Source::Teleop, Some(1e300))).unwrap();
        assert_eq!(arbiter.advance(DT, None), None);
        assert_eq!(arbiter.advance(COMMAND_TIMEOUT_MAX, None), None);
        assert_eq!(arbiter.advance(DT, None), Some(Source::Teleop));
    }

    #[test]
    fn a_stream_of_higher_priority_takes_authority_over() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed_for(Source::Script, Some(10.0))).unwrap();
        arbiter.admit(&streamed(Source::Teleop)).unwrap();
        assert_eq!(pass(&mut arbiter, 20_000), Some((502, Source::Teleop)), "the timeout of the script does not count");
    }

    #[test]
    fn a_latched_request_leaves_a_stream_in_control() {
        let mut arbiter = arbiter();
        arbiter.admit(&Request::new(Source::Teleop)).unwrap();
        assert_eq!(arbiter.in_control(), None);
        arbiter.admit(&streamed(Source::Script)).unwrap();
        arbiter.admit(&Request::new(Source::Console)).unwrap();
        assert_eq!(pass(&mut arbiter, 1000), Some((502, Source::Script)), "its timeout still stops the robot");
    }

    #[test]
    fn the_control_loops_own_hold_ends_no_stream() {
        for source in Source::OPERATORS {
            let mut arbiter = arbiter();
            arbiter.admit(&streamed(source)).unwrap();
            let outranked = arbiter.admit(&Request::new(Source::ControlLoop)).unwrap_err();
            assert_eq!(outranked.source, source, "only its stop is taken");
            assert_eq!(pass(&mut arbiter, 1000), Some((502, source)), "the stream's timeout still stops the robot");
        }
    }

    #[test]
    fn a_released_stream_does_not_time_out() {
        let mut arbiter = arbiter();
        arbiter.admit(&streamed(Source::Script)).unwrap();
        arbiter.admit(&Request::new(Source::Script)).unwrap();
        assert_eq!(arbiter.in_control(), None);
        assert_eq!(pass(&mut arbiter, 1000), None);
    }
}
