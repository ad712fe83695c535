//! Every `DESIGN §…` in a comment refers to a heading of docs/design.md.

use crate::offence::Offence;
use crate::sources::Sources;

/// References to sections that are missing in `headings`.
pub fn dangling(sources: &Sources, headings: &[String]) -> Vec<Offence> {
    let mut offences = Vec::new();
    // This package quotes such references.
    for (file, text) in sources.iter().filter(|(file, _)| !file.starts_with("tests/tidy/")) {
        for (index, line) in text.lines().enumerate() {
            for reference in line.split("DESIGN").skip(1) {
                let section = section_of(reference);
                if section.as_ref().is_none_or(|section| !headings.contains(section)) {
                    let what = match section {
                        Some(section) => format!("docs/design.md has no section {section}"),
                        None => "names no section of docs/design.md".to_owned(),
                    };
                    offences.push(Offence::new(file, index + 1, what));
                }
            }
        }
    }
    offences
}

/// Extracts `4.2` from ` §4.2, eq. 4`.
fn section_of(reference: &str) -> Option<String> {
    let number = reference.trim_start().strip_prefix('§')?;
    let end = number.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(number.len());
    let number = number[..end].trim_end_matches('.');
    (!number.is_empty()).then(|| number.to_owned())
}

/// Section numbers in the headings of a page: `4.2` for `### 4.2 The ramp` or `### §4.2 The ramp`.
pub fn headings(page: &str) -> Vec<String> {
    let titles =
        page.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim_start());
    titles.filter_map(|title| section_of(&format!("§{}", title.trim_start_matches('§')))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;
    use crate::workspace::repository;

    #[test]
    fn comments_cite_sections_that_the_design_page_has() {
        let page = std::fs::read_to_string(repository().join("docs/design.md")).unwrap_or_default();
        let remedy = "Cite a heading of docs/design.md, or nothing.";
        assert_none(&dangling(&Sources::of_repository(), &headings(&page)), remedy);
    }

    #[test]
    fn a_reference_to_a_missing_section_is_found() {
        let headings = headings("# Design\n## 4. The gait\n### 4.2 Speed\n");
        assert_eq!(headings, ["4", "4.2"]);
        let text = "//! Speed (DESIGN §4.2, eq. 4).\n// DESIGN §4.\n// DESIGN §5.3's way\n// DESIGN says so";
        let found = dangling(&Sources::sample(&[("crates/gait/src/speed.rs", text)]), &headings);
        assert_eq!(found.iter().map(|offence| offence.line).collect::<Vec<_>>(), [3, 4]);
    }
}
