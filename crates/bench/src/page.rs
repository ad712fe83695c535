//! The report of a benchmark as an HTML page: table, verdict, and histograms of the times.

use std::fmt::Write;

use plots::html::{data_url, escape};

use crate::BenchReport;
use crate::histograms::histograms;

/// Writes the report as a page that needs no other file.
pub fn bench_page(report: &BenchReport) -> String {
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>halfstep bench {what}</title>\n\
         <style>body{{font-family:Helvetica,Arial,sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}\
         pre{{overflow-x:auto}}img{{max-width:100%}}</style></head>\n<body><h1>halfstep bench \
         {what}</h1>\n<pre>{text}</pre>\n",
        what = report.what,
        text = escape(report.to_string()),
    );
    for group in report.series.chunk_by(|one, next| one.group == next.group) {
        let picture = histograms(group);
        let _ = writeln!(html, "<img alt=\"{}\" src=\"{}\">", escape(&group[0].group), data_url(&picture));
    }
    html + "</body></html>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Machine, Reduction, Series};

    #[test]
    fn page_has_one_histogram_per_group_of_series() {
        let series = |group: &str, name: &str| {
            let mut series = Series::new(group, name, Reduction::Median);
            series.begin_round();
            (1..1000).for_each(|ns| series.add(f64::from(ns)));
            series
        };
        let report = BenchReport {
            what: "latency",
            machine: Machine::of_this_process(),
            series: vec![series("one", "a < b"), series("one", "c"), series("two", "d")],
            ratios: Vec::new(),
            notes: Vec::new(),
        };
        let page = bench_page(&report);
        assert_eq!(page.matches("<img").count(), 2);
        assert!(page.contains("a &lt; b") && !page.contains("NaN"), "{page}");
    }
}
