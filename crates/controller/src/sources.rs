//! Sources of requests: who is in command, and for how long.
//!
//! A request that lasts *while its source speaks* belongs to a stream: with it the source takes **command**, and holds it
//! for the request's age limit. Each further word of the source, be it a request for nothing, begins the limit anew. A
//! source in command that is silent for longer has lost it, and what it asked is too old: the walk is to come to a stand.
//! Whoever speaks next takes command again.
//!
//! While a source is in command, those that come after it in the order of priority are refused, save that anyone may ask
//! for a stop. Those that go before it are granted what they ask; with a stream they take command over.
//!
//! A request that lasts *until changed* holds no command beyond its instant. From the source in command it is the end of
//! its stream: what it asked lasts.

/// Who asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A person at a command line.
    Console,
    /// A file or a pipe.
    Script,
    /// A person with keys under the fingers.
    Teleop,
    /// Another program.
    Program,
}

/// How long what is asked lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lasting {
    /// Until another request changes it.
    UntilChanged,
    /// Until its source has been silent for longer than this [s]; [`SourcesParameters::age_limit`] if there is no number,
    /// or none that is positive and finite.
    WhileSpeaking(Option<f64>),
}

/// Why a source is not heard: another one is in command, and goes before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outranked {
    /// Who is in command.
    pub by: Source,
    /// For how long, if it says no more [s].
    pub remaining: f64,
}

/// Shortest age limit that may be configured [s]. Streams that leave the limit to the controller give a sign of life
/// several times within it.
pub const AGE_LIMIT_MIN: f64 = 0.1;

/// How long sources are believed, and who goes before whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourcesParameters {
    /// Age limit of streams that name none [s]. `None` is off: what they ask lasts until changed.
    pub age_limit: Option<f64>,
    /// All sources; each goes before those after it.
    pub priority: [Source; Source::ALL.len()],
}

/// The sources as heard until now. Knows no clock: [`advance`](Self::advance) tells the time.
#[derive(Clone, Debug)]
pub struct Sources {
    parameters: SourcesParameters,
    command: Option<Command>,
}

/// Command, as one source holds it.
#[derive(Clone, Copy, Debug)]
struct Command {
    source: Source,
    /// [s]
    age_limit: f64,
    /// How long the source has been silent [s].
    silence: f64,
    /// Whether it spoke in this very period, which then is no silence.
    has_spoken: bool,
}

/// What sums of periods may be off by [s].
const ROUNDING: f64 = 1e-6;

impl Source {
    /// All sources.
    pub const ALL: [Source; 4] = [Source::Console, Source::Script, Source::Teleop, Source::Program];
}

impl Sources {
    /// Nobody is in command yet.
    pub fn new(parameters: SourcesParameters) -> Self {
        Self { parameters, command: None }
    }

    /// A source speaks. Refused, it changes nothing. A stop is refused to nobody, but takes command from nobody either
    /// who goes before.
    ///
    /// # Errors
    /// A source that goes before this one is in command.
    pub fn hear(&mut self, source: Source, lasting: Lasting, is_stop: bool) -> Result<(), Outranked> {
        if let Some(command) = &self.command
            && self.goes_before(command.source, source)
        {
            let remaining = (command.age_limit - command.silence).max(0.0);
            return if is_stop { Ok(()) } else { Err(Outranked { by: command.source, remaining }) };
        }
        match self.age_limit(lasting) {
            Some(age_limit) => self.command = Some(Command { source, age_limit, silence: 0.0, has_spoken: true }),
            None if self.in_command() == Some(source) => self.command = None,
            // Somebody of lower priority is in command and stays it: its silence must still stop the walk.
            None => {}
        }
        Ok(())
    }

    /// A period of `dt` seconds ends; gives the source in command if it has just been silent for too long. To be called
    /// after [`hear`](Self::hear) in each period: what has arrived counts, however late the period is.
    pub fn advance(&mut self, dt: f64) -> Option<Source> {
        let command = self.command.as_mut()?;
        if std::mem::take(&mut command.has_spoken) {
            return None;
        }
        // What is no number is no time, either.
        command.silence += dt.max(0.0);
        if command.silence <= command.age_limit + ROUNDING {
            return None;
        }
        self.command.take().map(|command| command.source)
    }

    /// Who is in command, if anybody.
    pub fn in_command(&self) -> Option<Source> {
        self.command.map(|command| command.source)
    }

    fn age_limit(&self, lasting: Lasting) -> Option<f64> {
        match lasting {
            Lasting::UntilChanged => None,
            Lasting::WhileSpeaking(own) => {
                own.filter(|limit| limit.is_finite() && *limit > 0.0).or(self.parameters.age_limit)
            }
        }
    }

    fn goes_before(&self, first: Source, second: Source) -> bool {
        first != second
            && self.parameters.priority.into_iter().find(|&source| source == first || source == second) == Some(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1e-3;
    const STREAM: Lasting = Lasting::WhileSpeaking(None);

    fn sources() -> Sources {
        let priority = [Source::Teleop, Source::Console, Source::Program, Source::Script];
        Sources::new(SourcesParameters { age_limit: Some(0.5), priority })
    }

    /// Lets so many periods pass, and gives the one, from 1, at which a source fell silent.
    fn pass(sources: &mut Sources, periods: u32) -> Option<(u32, Source)> {
        let mut silent = None;
        for period in 1..=periods {
            silent = sources.advance(DT).map(|source| (period, source)).or(silent);
        }
        silent
    }

    #[test]
    fn a_stream_is_in_command_for_its_limit_and_not_a_period_longer() {
        for (own, limit_in_periods) in [(None, 500), (Some(0.2), 200), (Some(2.0), 2000), (Some(1e-4), 0)] {
            let mut sources = sources();
            sources.hear(Source::Script, Lasting::WhileSpeaking(own), false).unwrap();
            assert_eq!(sources.advance(DT), None, "it spoke in this period");
            assert_eq!(pass(&mut sources, limit_in_periods), None, "silent exactly for the limit");
            assert_eq!(sources.in_command(), Some(Source::Script));
            assert_eq!(sources.advance(DT), Some(Source::Script));
            assert_eq!(sources.in_command(), None);
            assert_eq!(pass(&mut sources, 5000), None, "it falls silent once");
        }
    }

    #[test]
    fn signs_of_life_keep_command_for_ever() {
        let mut sources = sources();
        for period in 0..100_000 {
            if period % 500 == 0 {
                sources.hear(Source::Program, STREAM, false).unwrap();
            }
            assert_eq!(sources.advance(DT), None);
        }
    }

    #[test]
    fn who_speaks_again_takes_command_again() {
        let mut sources = sources();
        for _ in 0..3 {
            sources.hear(Source::Script, STREAM, false).unwrap();
            assert_eq!(pass(&mut sources, 1000), Some((502, Source::Script)));
            assert_eq!(sources.in_command(), None);
        }
    }

    #[test]
    fn a_word_in_the_last_moment_counts_however_late_the_period_is() {
        let mut sources = sources();
        sources.hear(Source::Script, STREAM, false).unwrap();
        assert_eq!(pass(&mut sources, 501), None);
        sources.hear(Source::Script, STREAM, false).unwrap();
        assert_eq!(sources.advance(10.0), None);
        assert_eq!(sources.advance(0.5), None);
        assert_eq!(sources.advance(DT), Some(Source::Script));
    }

    #[test]
    fn a_huge_period_is_a_silence_and_one_that_is_no_number_is_nothing() {
        for huge in [0.6, 1e300, f64::INFINITY] {
            let mut sources = sources();
            sources.hear(Source::Teleop, STREAM, false).unwrap();
            for nothing in [0.0, f64::NAN, -1.0, f64::NEG_INFINITY] {
                assert_eq!(sources.advance(nothing), None);
            }
            assert_eq!(sources.advance(huge), Some(Source::Teleop));
        }
    }

    #[test]
    fn a_limit_that_is_none_gives_way_to_the_configured_one() {
        for own in [f64::NAN, -1.0, 0.0, f64::INFINITY, f64::NEG_INFINITY] {
            let mut sources = sources();
            sources.hear(Source::Script, Lasting::WhileSpeaking(Some(own)), false).unwrap();
            assert_eq!(pass(&mut sources, 1000), Some((502, Source::Script)), "{own}");
        }
    }

    #[test]
    fn with_the_limit_off_only_streams_with_their_own_hold_command() {
        let mut sources =
            Sources { parameters: SourcesParameters { age_limit: None, ..sources().parameters }, ..sources() };
        sources.hear(Source::Teleop, STREAM, false).unwrap();
        assert_eq!(sources.in_command(), None);
        sources.hear(Source::Teleop, Lasting::WhileSpeaking(Some(0.1)), false).unwrap();
        assert_eq!(pass(&mut sources, 1000), Some((102, Source::Teleop)));
    }

    #[test]
    fn each_source_is_refused_while_one_before_it_is_in_command() {
        let order = sources().parameters.priority;
        for (rank, &first) in order.iter().enumerate() {
            for (other, &second) in order.iter().enumerate() {
                for lasting in [STREAM, Lasting::UntilChanged] {
                    let mut sources = sources();
                    sources.hear(first, STREAM, false).unwrap();
                    assert_eq!(pass(&mut sources, 101), None);
                    let heard = sources.hear(second, lasting, false);
                    let Err(Outranked { by, remaining }) = heard else {
                        assert!(other <= rank, "{second:?} was heard before {first:?}");
                        continue;
                    };
                    assert!(other > rank, "{second:?} was refused for {first:?}");
                    assert_eq!(by, first);
                    assert!((remaining - 0.4).abs() < 1e-9, "{remaining}");
                    assert_eq!(pass(&mut sources, 401), Some((401, first)), "being refused it changed nothing");
                    assert_eq!(sources.hear(second, lasting, false), Ok(()), "the other fell silent");
                }
            }
        }
    }

    #[test]
    fn a_stop_is_refused_to_nobody_and_takes_no_command() {
        let mut sources = sources();
        sources.hear(Source::Teleop, STREAM, false).unwrap();
        assert_eq!(pass(&mut sources, 101), None);
        for source in Source::ALL {
            if source != Source::Teleop {
                assert_eq!(sources.hear(source, STREAM, true), Ok(()));
                assert_eq!(sources.in_command(), Some(Source::Teleop));
            }
        }
        assert_eq!(pass(&mut sources, 401), Some((401, Source::Teleop)), "it was no word of the one in command");
    }

    #[test]
    fn a_stream_with_priority_takes_over_and_leaves_nothing_behind() {
        let mut sources = sources();
        sources.hear(Source::Script, Lasting::WhileSpeaking(Some(10.0)), false).unwrap();
        sources.hear(Source::Teleop, STREAM, false).unwrap();
        assert_eq!(pass(&mut sources, 20_000), Some((502, Source::Teleop)), "the script's silence does not count");
    }

    #[test]
    fn a_single_request_blocks_nobody_and_leaves_a_stream_in_command() {
        let mut sources = sources();
        sources.hear(Source::Teleop, Lasting::UntilChanged, false).unwrap();
        assert_eq!(sources.in_command(), None);
        sources.hear(Source::Script, STREAM, false).unwrap();
        sources.hear(Source::Console, Lasting::UntilChanged, false).unwrap();
        assert_eq!(pass(&mut sources, 1000), Some((502, Source::Script)), "its silence still stops the walk");
    }

    #[test]
    fn a_source_that_takes_its_leave_does_not_fall_silent() {
        let mut sources = sources();
        sources.hear(Source::Script, STREAM, false).unwrap();
        sources.hear(Source::Script, Lasting::UntilChanged, false).unwrap();
        assert_eq!(sources.in_command(), None);
        assert_eq!(pass(&mut sources, 1000), None);
    }
}
