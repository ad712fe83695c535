//! A run as one HTML page that needs no other file.

use std::fmt::Write;

use record::Provenance;

use crate::html::{data_url, escape};
use crate::picture::RunPictures;
use crate::run_log::JointLoad;
use crate::run_summary::RunSummary;

pub(crate) const STYLE: &str = "\
body { font: 15px/1.45 Helvetica, Arial, sans-serif; color: #222; max-width: 1200px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums }
th, td { text-align: right; padding: .15em .7em; border-bottom: 1px solid #ddd }
th { border-bottom-color: #888 }
td.word, th.word { text-align: left }
figure { margin: 0 0 1.5em; padding: .6em; border: 1px solid #ddd }
figure img { max-width: 100% }
pre { overflow-x: auto; background: #f6f6f6; padding: .6em; font-size: 13px }
nav a { margin-right: 1em }
.note { background: #fdf3dc; padding: .4em .8em }
";

/// A longer file is named only (bytes).
const FILE_MAX: usize = 100_000;

/// Writes the page of a run.
///
/// * `title` – heading of the page
/// * `notes` – what the reader must know of the recording, one text each
pub fn run_page(
    title: &str,
    summary: &RunSummary,
    pictures: &RunPictures,
    notes: &[String],
    provenance: &Provenance,
) -> String {
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n",
        title = escape(title)
    );
    html += "<nav><a href=\"#summary\">Summary</a><a href=\"#pictures\">Pictures</a><a href=\"#drives\">Drives</a>\
             <a href=\"#configuration\">Configuration</a></nav>\n";
    for note in notes.iter().chain(&pictures.missing) {
        // Writing to a string cannot fail.
        let _ = writeln!(html, "<p class=\"note\">{}</p>", escape(note));
    }
    html += "<h2 id=\"summary\">Summary</h2>\n<table>\n";
    for (name, value) in summary.lines() {
        let _ = writeln!(html, "<tr><td class=\"word\">{name}</td><td class=\"word\">{}</td></tr>", escape(value));
    }
    html += "</table>\n<p>A fall counts as unavoidable from when the capture point left the soles for good. Terms: \
             docs/glossary.md of Halfstep.</p>\n<h2 id=\"pictures\">Pictures</h2>\n";
    for picture in &pictures.drawn {
        let (file, shows, source) = (picture.file, escape(picture.shows), data_url(&picture.svg));
        let _ = writeln!(
            html,
            "<figure id=\"{file}\"><img alt=\"{shows}\" src=\"{source}\"><figcaption><b>{file}</b>: {shows}\
             </figcaption></figure>"
        );
    }
    html += "<h2 id=\"drives\">Drives</h2>\n";
    html += &loads_table(&summary.measures.joint_loads);
    html += "<h2 id=\"configuration\">Configuration</h2>\n";
    for metadata in &provenance.metadata {
        let entries: Vec<String> = metadata.entries.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        let _ = writeln!(
            html,
            "<details><summary>{}</summary><pre>{}</pre></details>",
            escape(&metadata.name),
            escape(entries.join("\n"))
        );
    }
    for (name, text) in &provenance.files {
        if text.len() > FILE_MAX {
            let _ = writeln!(html, "<p>{}: {} bytes, attached to the recording</p>", escape(name), text.len());
        } else {
            let (name, text) = (escape(name), escape(text));
            let _ = writeln!(html, "<details><summary>{name}</summary><pre>{text}</pre></details>");
        }
    }
    html + "</body>\n</html>\n"
}

/// The greatest loads on the drives as a table.
fn loads_table(loads: &[JointLoad]) -> String {
    if loads.is_empty() {
        return "<p>No measurement was recorded: nothing is known of the drives.</p>\n".to_owned();
    }
    let mut html = "<table>\n<tr><th class=\"word\">joint</th><th>peak torque [N·m]</th><th>share of its limit at \
                    standstill [%]</th><th>greatest share of the voltage [%]</th><th>peak current [A]</th></tr>\n"
        .to_owned();
    let or_blank =
        |value: Option<f64>, decimals: usize| value.map_or("–".to_owned(), |value| format!("{value:.decimals$}"));
    for load in loads {
        let _ = writeln!(
            html,
            "<tr><td class=\"word\">{}</td><td>{:.1}</td><td>{:.0}</td><td>{}</td><td>{}</td></tr>",
            load.joint.name(),
            load.peak_torque_n_m,
            load.torque_share * 100.0,
            or_blank(load.voltage_share.map(|share| share * 100.0), 0),
            or_blank(load.peak_current_a, 1),
        );
    }
    html + "</table>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{FloorHeights, of_run};
    use crate::run_log::synthetic;

    #[test]
    fn the_page_has_every_picture_what_is_missing_and_the_configuration() {
        let (log, mechanism) = (synthetic::log(4, 0.1), synthetic::mechanism());
        let pictures = of_run(&log, &mechanism, &FloorHeights::PLANE);
        let files = vec![
            ("controller.toml".to_owned(), "gain = 1 # < 2\n".to_owned()),
            ("nominal.csv".to_owned(), "0\n".repeat(FILE_MAX)),
        ];
        let provenance = Provenance { metadata: vec![record::Metadata::new("plant", [("seed", "3".into())])], files };
        let notes = ["it is truncated".to_owned()];
        let page = run_page("A run", &RunSummary::of(&log, &mechanism), &pictures, &notes, &provenance);
        assert_eq!(page.matches("<img").count(), pictures.drawn.len());
        assert_eq!(page.matches("class=\"note\"").count(), 1 + pictures.missing.len());
        for text in ["it is truncated", "gain = 1 # &lt; 2", "nominal.csv: 200000 bytes", "seed = 3", "walking at"] {
            assert!(page.contains(text), "{text}");
        }
        let outside = page.split("src=\"").skip(1).filter(|source| !source.starts_with("data:")).count();
        assert_eq!(outside, 0);
    }
}
