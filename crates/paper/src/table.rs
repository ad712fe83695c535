//! The figures as a table, for people and as JSON.

use crate::{LeanAt, PaperLean};
use serde::Serialize;

use super::Figure;

/// A figure as a row of the table, for JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableRow {
    figure: u64,
    zmp_x_min_cm: f64,
    zmp_x_max_cm: f64,
    zmp_y_min_cm: f64,
    zmp_y_max_cm: f64,
    margin_mm: f64,
    verdict: &'static str,
    paper_verdict: &'static str,
    agrees: Option<bool>,
}

impl TableRow {
    /// The row of a figure.
    pub fn of(figure: &Figure) -> Self {
        let extents = &figure.extents;
        Self {
            figure: figure.scenario.figure,
            zmp_x_min_cm: extents.min.x * 1e2,
            zmp_x_max_cm: extents.max.x * 1e2,
            zmp_y_min_cm: extents.min.y * 1e2,
            zmp_y_max_cm: extents.max.y * 1e2,
            margin_mm: extents.margin * 1e3,
            verdict: verdict(figure),
            paper_verdict: figure.scenario.paper_verdict.text(),
            agrees: figure.agrees(),
        }
    }
}

/// Headings of the columns.
const HEADINGS: [&str; 10] = [
    "fig",
    "gait",
    "lean",
    "ZMP x [cm]",
    "ZMP y [cm]",
    "margin [mm]",
    "verdict",
    "paper",
    "agree?",
    "best lean → margin [mm]",
];

/// Writes all figures as a table, with the number of verdicts that agree.
pub fn table(figures: &[Figure]) -> String {
    let rows: Vec<[String; HEADINGS.len()]> = figures.iter().map(cells).collect();
    let headings = HEADINGS.map(str::to_owned);
    let width = |column: usize| {
        let cells = rows.iter().chain([&headings]).map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: [usize; HEADINGS.len()] = std::array::from_fn(width);
    let mut text = String::new();
    for row in [&headings].into_iter().chain(&rows) {
        let cells = row.iter().zip(widths).enumerate().map(|(column, (cell, width))| {
            // Numbers are aligned right, words left.
            if matches!(column, 0 | 3..=5) { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
        });
        text += cells.collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    let stated = figures.iter().filter_map(Figure::agrees);
    let (agreeing, all) = stated.fold((0, 0), |(agreeing, all), agrees| (agreeing + usize::from(agrees), all + 1));
    let ways_differ = figures.iter().map(|figure| figure.ways_differ).fold(0.0, f64::max);
    let same = if ways_differ < 1e-9 { "below 1e-9 m".to_owned() } else { format!("{ways_differ:.1e} m") };
    text + &format!("{agreeing} of {all} stated verdicts agree. Newton–Euler and the c² law differ by {same}.\n")
}

/// `speed 1.1, ankle −2.0° / 0.5°: in; the paper: in`
pub fn summary(figure: &Figure) -> String {
    let scenario = &figure.scenario;
    let lean = scenario.lean.map_or(String::new(), |lean| format!(", {}", lean_text(&lean, 1)));
    format!("{}{lean}: {}; the paper: {}", scenario.title, verdict(figure), scenario.paper_verdict.text())
}

/// `in` or `out`.
pub(crate) fn verdict(figure: &Figure) -> &'static str {
    if figure.is_inside() { "in" } else { "out" }
}

/// `yes` or `NO`; nothing when the paper says nothing.
pub(crate) fn agreement(figure: &Figure) -> &'static str {
    figure.agrees().map_or("", |agrees| if agrees { "yes" } else { "NO" })
}

/// `ankle −2.5° / 0.5°`: the joints in the paper's order.
pub(crate) fn lean_text(lean: &PaperLean, digits: usize) -> String {
    let at = match lean.at {
        LeanAt::Ankle => "ankle",
        LeanAt::Trunk => "trunk",
    };
    let [first, second] = [lean.angles.x, lean.angles.y].map(|angle| number(angle.to_degrees(), digits));
    format!("{at} {first}° / {second}°")
}

/// A number with a typographic minus, without a sign before zero.
pub(crate) fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|digit| matches!(digit, '0' | '.')) => zero.to_owned(),
        Some(size) => format!("−{size}"),
        None => text,
    }
}

fn cells(figure: &Figure) -> [String; HEADINGS.len()] {
    let (scenario, extents) = (&figure.scenario, &figure.extents);
    let range = |min: f64, max: f64| format!("{} … {:>5}", number(min * 1e2, 1), number(max * 1e2, 1));
    [
        scenario.figure.to_string(),
        scenario.title.clone(),
        scenario.lean.map_or(String::new(), |lean| lean_text(&lean, 1)),
        range(extents.min.x, extents.max.x),
        range(extents.min.y, extents.max.y),
        number(extents.margin * 1e3, 1),
        verdict(figure).to_owned(),
        scenario.paper_verdict.text().to_owned(),
        agreement(figure).to_owned(),
        figure
            .best
            .map_or(String::new(), |best| format!("{} → {}", lean_text(&best.lean, 1), number(best.margin * 1e3, 1))),
    ]
}
