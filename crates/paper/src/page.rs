//! All figures as one HTML page that needs no other file.

use std::fmt::Write;

use charts::html::{data_url, escape};
use gait::DeflectionPhase;

use super::Figure;
use super::table::{agreement, lean_text, number, summary, verdict};

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<title>The paper, figure by figure</title>
<style>
body { font: 15px/1.45 Helvetica, Arial, sans-serif; color: #222; max-width: 1500px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1.5em 0; font-variant-numeric: tabular-nums }
th, td { text-align: right; padding: .15em .7em; border-bottom: 1px solid #ddd; white-space: nowrap }
th { border-bottom-color: #888 }
td.word, th.word { text-align: left }
.no { background: #fbe3e0 }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(440px, 1fr)); gap: 1.2em }
figure { margin: 0; padding: .6em; border: 1px solid #ddd }
figure img { width: 100% }
a { color: inherit }
</style>
</head>
<body>
<h1>The paper, figure by figure</h1>
<p>One mechanism, one nominal, the paper's own degrees. A figure is <em>in</em> when every ZMP point of the steady
half-steps lies inside the support foot's sole. Lengths are relative to O, under the ankle of the support foot; x along
the foot, y to the middle. Leans are of joints 3 / 4 (ankle) or 15 / 16 (trunk).</p>
";

/// Writes the page; `pictures` are the figures' SVG texts.
pub fn page(figures: &[Figure], pictures: &[String]) -> String {
    let mut html = HEAD.to_owned();
    html += "<table><tr><th>Fig.</th><th class=\"word\">gait</th><th class=\"word\">lean</th>\
             <th>x [cm]</th><th>y [cm]</th><th>margin [mm]</th>\
             <th class=\"word\">verdict</th><th class=\"word\">paper</th><th class=\"word\">agree?</th>\
             <th class=\"word\">best lean</th><th>its margin [mm]</th></tr>\n";
    for figure in figures {
        row(&mut html, figure);
    }
    html += "</table>\n<div class=\"figures\">\n";
    for (figure, picture) in figures.iter().zip(pictures) {
        caption(&mut html, figure, picture);
    }
    html + "</div>\n</body>\n</html>\n"
}

fn row(html: &mut String, figure: &Figure) {
    let (scenario, extents) = (&figure.scenario, &figure.extents);
    let range = |min: f64, max: f64| format!("{} … {}", number(min * 1e2, 1), number(max * 1e2, 1));
    let [best, its_margin] = figure
        .best
        .map_or([String::new(), String::new()], |best| [lean_text(&best.lean, 1), number(best.margin * 1e3, 1)]);
    let class = if figure.agrees() == Some(false) { " class=\"no\"" } else { "" };
    // Writing to a string cannot fail.
    let _ = writeln!(
        html,
        "<tr{class}><td><a href=\"#figure-{number}\">{number}</a></td><td class=\"word\">{title}</td>\
         <td class=\"word\">{lean}</td><td>{x}</td><td>{y}</td><td>{margin}</td><td class=\"word\">{verdict}</td>\
         <td class=\"word\">{paper}</td><td class=\"word\">{agreement}</td>\
         <td class=\"word\">{best}</td><td>{its_margin}</td></tr>",
        number = scenario.figure,
        title = escape(&scenario.title),
        lean = scenario.lean.map_or(String::new(), |lean| lean_text(&lean, 1)),
        x = range(extents.min.x, extents.max.x),
        y = range(extents.min.y, extents.max.y),
        margin = number(extents.margin * 1e3, 1),
        verdict = verdict(figure),
        paper = scenario.paper_verdict.text(),
        agreement = agreement(figure),
    );
}

fn caption(html: &mut String, figure: &Figure, picture: &str) {
    let scenario = &figure.scenario;
    let mut words = format!("<b>Figure {}.</b> {}.", scenario.figure, escape(summary(figure)));
    if figure.half_steps[0].phase != DeflectionPhase::Straight {
        for (half_step, extents) in figure.half_steps.iter().zip(&figure.extents_of) {
            let phase = if half_step.phase == DeflectionPhase::Deflect { "Deflecting" } else { "Restoring" };
            words += &format!(" {phase}: margin {} mm.", number(extents.margin * 1e3, 1));
        }
    }
    if let Some(note) = &scenario.note {
        words += &format!(" {}", escape(note));
    }
    let _ = writeln!(
        html,
        "<figure id=\"figure-{number}\"><img alt=\"Figure {number}: soles and ZMP path\" src=\"{source}\">\
         <figcaption>{words}</figcaption></figure>",
        number = scenario.figure,
        source = data_url(picture),
    );
}
