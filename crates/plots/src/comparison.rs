//! Two runs over each other: a table of both summaries, pictures, and a page.

use std::fmt::Write;

use crate::html::{data_url, escape};
use crate::picture::{ComparedRun, RunPicture, compared_footprints, compared_over_time};
use crate::run_page::STYLE;
use crate::run_summary::RunSummary;

/// A line of a comparison: what it is, and its values in the first and in the second run.
pub type ComparedLine = (&'static str, [String; 2]);

/// The lines of both summaries side by side; what a run does not have is `–`.
pub fn compared_lines(summaries: [&RunSummary; 2]) -> Vec<ComparedLine> {
    let [one, other] = summaries.map(RunSummary::lines);
    let value = |lines: &[(&'static str, String)], name: &str| {
        let line = lines.iter().find(|(found, _)| *found == name);
        line.map_or("–".to_owned(), |(_, value)| value.clone())
    };
    let mut names: Vec<&'static str> = one.iter().map(|(name, _)| *name).collect();
    names.extend(other.iter().map(|(name, _)| *name).filter(|name| one.iter().all(|(found, _)| found != name)));
    names.into_iter().map(|name| (name, [value(&one, name), value(&other, name)])).collect()
}

/// The pictures of two runs over each other, as far as both have something to draw.
pub fn compared_pictures(runs: &[ComparedRun; 2]) -> Vec<RunPicture> {
    let mut pictures = vec![RunPicture {
        file: "compared_over_time.svg",
        shows: "Least measured margin of each half-step, ZMP error off support changes, feedback, tilt of the trunk, \
                and the greatest share of its torque at standstill that any drive yields.",
        svg: compared_over_time(runs),
    }];
    if runs.iter().all(|run| !run.log.plant.is_empty()) {
        pictures.push(RunPicture {
            file: "compared_footprints.svg",
            shows: "Soles and centre of mass from above.",
            svg: compared_footprints(runs),
        });
    }
    pictures
}

/// Writes the comparison as a page that needs no other file.
///
/// * `notes` – what the reader must know of the recordings, one text each
pub fn comparison_page(names: [&str; 2], lines: &[ComparedLine], pictures: &[RunPicture], notes: &[String]) -> String {
    let [one, other] = names.map(|name| escape(name).into_owned());
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{one} and {other}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{one} and {other}</h1>\n"
    );
    for note in notes {
        // Writing to a string cannot fail.
        let _ = writeln!(html, "<p class=\"note\">{}</p>", escape(note));
    }
    let _ = writeln!(html, "<table>\n<tr><th></th><th class=\"word\">{one}</th><th class=\"word\">{other}</th></tr>");
    for (name, values) in lines {
        let [first, second] = values.each_ref().map(|value| escape(value.as_str()));
        let _ = writeln!(
            html,
            "<tr><td class=\"word\">{name}</td><td class=\"word\">{first}</td><td class=\"word\">{second}</td></tr>"
        );
    }
    html += "</table>\n";
    for RunPicture { file, shows, svg } in pictures {
        let (shows, source) = (escape(*shows), data_url(svg));
        let _ = writeln!(
            html,
            "<figure><img alt=\"{shows}\" src=\"{source}\"><figcaption><b>{file}</b>: {shows}</figcaption></figure>"
        );
    }
    html + "</body>\n</html>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run_log::{RunLog, synthetic};

    #[test]
    fn the_table_has_the_lines_of_both_runs() {
        let (log, mechanism) = (synthetic::log(4, 0.0), synthetic::mechanism());
        let mut other = synthetic::log(6, 0.0);
        other.controller[10].margin = Some(0.0071);
        let summaries = [&log, &other].map(|log| RunSummary::of(log, &mechanism));
        let lines = compared_lines(summaries.each_ref());
        let margin = lines.iter().find(|line| line.0.starts_with("least margin")).unwrap();
        assert!(margin.1[0].starts_with("20 mm") && margin.1[1].starts_with("7 mm"), "{margin:?}");

        let runs = [("a", &log), ("b", &other)].map(|(name, log)| ComparedRun { name, log, mechanism: &mechanism });
        let pictures = compared_pictures(&runs);
        let page = comparison_page(["a", "b < a"], &lines, &pictures, &["cut".to_owned()]);
        assert_eq!((page.matches("<img").count(), page.matches("<tr>").count()), (2, 1 + lines.len()));
        assert!(page.contains("b &lt; a") && page.contains("class=\"note\">cut"), "{page}");

        let alone = RunLog { plant: Vec::new(), ..other };
        let runs = [&log, &alone].map(|log| ComparedRun { name: "x", log, mechanism: &mechanism });
        assert_eq!(compared_pictures(&runs).len(), 1);
    }
}
