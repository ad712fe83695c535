//! A bench's page: the table, the verdict, and how the times are spread.

use std::fmt::Write;

use bench::Findings;

use crate::html::{as_address, escaped};
use crate::picture::spread_of_times;

/// The findings as a page that needs no other file.
pub fn bench_page(findings: &Findings) -> String {
    let mut html = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>halfstep bench {what}</title>\n\
         <style>body{{font-family:Helvetica,Arial,sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}\
         pre{{overflow-x:auto}}img{{max-width:100%}}</style></head>\n<body><h1>halfstep bench {what}</h1>\n<pre>{text}</pre>\n",
        what = findings.what,
        text = escaped(&findings.to_string()),
    );
    for group in findings.series.chunk_by(|one, next| one.group == next.group) {
        let picture = spread_of_times(group);
        let _ = writeln!(html, "<img alt=\"{}\" src=\"{}\">", escaped(&group[0].group), as_address(&picture));
    }
    html + "</body></html>\n"
}

#[cfg(test)]
mod tests {
    use bench::{Machine, Over, Series};

    use super::*;

    #[test]
    fn every_group_has_a_picture() {
        let series = |group: &str, name: &str| {
            let mut series = Series::new(group, name, Over::Median);
            series.begin_round();
            (1..1000).for_each(|ns| series.add(f64::from(ns)));
            series
        };
        let findings = Findings {
            what: "latency",
            machine: Machine::of_this_process(),
            series: vec![series("one", "a < b"), series("one", "c"), series("two", "d")],
            ratios: Vec::new(),
            notes: Vec::new(),
        };
        let page = bench_page(&findings);
        assert_eq!(page.matches("<img").count(), 2);
        assert!(page.contains("a &lt; b") && !page.contains("NaN"), "{page}");
    }
}
