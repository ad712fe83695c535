//! The report of a benchmark: the times of a run, and the ratios that decide.

use std::fmt;

use serde::{Serialize, Serializer, ser::SerializeStruct};

use crate::{Machine, Series};

/// The result of a benchmark run.
#[derive(Clone, Debug)]
pub struct BenchReport {
    /// Which benchmark: `compute`, `latency` or `jitter`.
    pub what: &'static str,
    /// The machine on which it ran.
    pub machine: Machine,
    /// The measured times.
    pub series: Vec<Series>,
    /// The verdict, which consists of ratios.
    pub ratios: Vec<Ratio>,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// The ratio of two measured numbers of the same run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ratio {
    /// Name of the number in the numerator.
    pub of: String,
    /// Name of the reference in the denominator.
    pub to: String,
    /// Which quantile of both is compared: `p50`, …
    pub number: String,
    /// The measured ratio.
    pub ratio: f64,
    /// Its 95 % confidence interval, see [`Series::interval`].
    pub interval: Option<[f64; 2]>,
    /// The largest ratio that passes.
    pub at_most: f64,
}

impl Ratio {
    /// The ratio of a quantile of two series, see [`Series::times`].
    pub fn of(ours: &Series, theirs: &Series, quantile: f64, at_most: f64) -> Self {
        Self {
            of: ours.name.clone(),
            to: theirs.name.clone(),
            number: number(quantile),
            ratio: ours.times(theirs, quantile),
            interval: ours.interval(theirs, quantile),
            at_most,
        }
    }

    /// Whether the ratio passes, as far as the rounds can tell.
    pub fn verdict(&self) -> RatioVerdict {
        let [low, high] = self.interval.unwrap_or([self.ratio; 2]);
        if high <= self.at_most {
            RatioVerdict::Reached
        } else if low > self.at_most || self.ratio.is_nan() {
            RatioVerdict::Missed
        } else {
            RatioVerdict::Unclear
        }
    }
}

/// Whether a ratio passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RatioVerdict {
    /// It does, and so does all of its interval.
    Reached,
    /// The largest ratio that passes lies within its interval: more or longer rounds would tell.
    Unclear,
    /// It does not, and nothing of its interval does.
    Missed,
}

impl RatioVerdict {
    fn text(self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::Unclear => "unclear",
            Self::Missed => "missed",
        }
    }
}

/// The reported quantiles.
const QUANTILES: [f64; 4] = [0.5, 0.9, 0.99, 0.999];

fn number(quantile: f64) -> String {
    format!("p{}", (quantile * 1e4).round() / 1e2)
}

impl fmt::Display for BenchReport {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        writeln!(out, "{}", self.machine)?;
        let wide = self.series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0);
        let mut group = "";
        for series in &self.series {
            if series.group != group {
                group = &series.group;
                writeln!(out, "\n{group:wide$}   {:>9} {:>9} {:>9} {:>9} {:>9}", "p50", "p90", "p99", "p99.9", "max")?;
            }
            write!(out, "{:wide$} µs", series.name)?;
            for (place, quantile) in QUANTILES.into_iter().enumerate() {
                if place > 0 && series.is_one_per_round() {
                    write!(out, "{:>9} ", "–")?;
                } else {
                    write!(out, "{} ", Micro(series.quantile(quantile)))?;
                }
            }
            writeln!(out, "{}", Micro(series.max()))?;
        }
        if !self.ratios.is_empty() {
            writeln!(out, "\nratios within this run")?;
        }
        for ratio in &self.ratios {
            let Ratio { of, to, number, ratio: value, at_most, interval } = ratio;
            let verdict = ratio.verdict().text();
            let interval = interval.map_or(String::new(), |[low, high]| format!("({low:.2} to {high:.2})"));
            writeln!(out, "{value:8.2} {interval:14} of at most {at_most:4.2} {verdict:7}  {number} of {of} / {to}")?;
        }
        for note in &self.notes {
            writeln!(out, "\n{note}")?;
        }
        Ok(())
    }
}

/// A time (ns), in microseconds.
struct Micro(f64);

impl fmt::Display for Micro {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let micro = self.0 * 1e-3;
        let digits = if micro < 10.0 {
            3
        } else if micro < 1000.0 {
            1
        } else {
            0
        };
        write!(out, "{micro:9.digits$}")
    }
}

impl Serialize for BenchReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_struct("BenchReport", 5)?;
        object.serialize_field("what", self.what)?;
        object.serialize_field("machine", &self.machine)?;
        object.serialize_field("series", &self.series.iter().map(SeriesInJson::from).collect::<Vec<_>>())?;
        object.serialize_field("ratios", &self.ratios.iter().map(RatioInJson::from).collect::<Vec<_>>())?;
        object.serialize_field("notes", &self.notes)?;
        object.end()
    }
}

/// A ratio as JSON.
#[derive(Serialize)]
struct RatioInJson<'r> {
    #[serde(flatten)]
    ratio: &'r Ratio,
    verdict: RatioVerdict,
}

impl<'r> From<&'r Ratio> for RatioInJson<'r> {
    fn from(ratio: &'r Ratio) -> Self {
        Self { ratio, verdict: ratio.verdict() }
    }
}

/// A series as JSON; times in nanoseconds.
#[derive(Serialize)]
struct SeriesInJson<'s> {
    group: &'s str,
    name: &'s str,
    count: u64,
    p50_ns: f64,
    p90_ns: f64,
    p99_ns: f64,
    p99_9_ns: f64,
    max_ns: f64,
    p50_ns_of_rounds: Vec<f64>,
}

impl<'s> From<&'s Series> for SeriesInJson<'s> {
    fn from(series: &'s Series) -> Self {
        let [p50_ns, p90_ns, p99_ns, p99_9_ns] = QUANTILES.map(|quantile| series.quantile(quantile));
        Self {
            group: &series.group,
            name: &series.name,
            count: series.count(),
            p50_ns,
            p90_ns,
            p99_ns,
            p99_9_ns,
            max_ns: series.max(),
            p50_ns_of_rounds: series.quantile_of_rounds(0.5),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Reduction;

    #[test]
    fn report_is_written_as_text_and_as_json() {
        let series = |name: &str, ns: f64| {
            let mut series = Series::new("group", name, Reduction::Median);
            series.begin_round();
            series.add(ns);
            series
        };
        let (ours, theirs) = (series("ours", 1500.0), series("theirs", 1000.0));
        let ratios = vec![Ratio::of(&ours, &theirs, 0.999, 1.15)];
        let machine = Machine::of_this_process();
        let report = BenchReport { what: "latency", machine, series: vec![ours, theirs], ratios, notes: Vec::new() };
        let text = report.to_string();
        let line = format!("1.50 {:14} of at most 1.15 missed   p99.9 of ours / theirs", "");
        assert!(text.contains(&line), "{text}");
        let json = serde_json::to_value(&report).unwrap();
        assert_eq!((&json["ratios"][0]["number"], &json["series"][1]["name"]), (&"p99.9".into(), &"theirs".into()));
        assert_eq!(json["ratios"][0]["verdict"], "missed");
    }

    #[test]
    fn a_bound_within_the_interval_is_neither_reached_nor_missed() {
        let verdict = |interval| {
            let ratio = Ratio {
                of: String::new(),
                to: String::new(),
                number: String::new(),
                ratio: 1.0,
                interval: Some(interval),
                at_most: 1.1,
            };
            ratio.verdict()
        };
        assert_eq!(verdict([0.9, 1.1]), RatioVerdict::Reached);
        assert_eq!(verdict([0.9, 1.2]), RatioVerdict::Unclear);
        assert_eq!(verdict([1.11, 1.2]), RatioVerdict::Missed);
    }
}
