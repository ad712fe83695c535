//! Every file begins with a `//!` line that describes it.

use crate::offence::Offence;
use crate::sources::Sources;

/// Files whose first line is no description.
pub fn without_purpose(sources: &Sources) -> Vec<Offence> {
    let says = |text: &str| text.strip_prefix("//! ").is_some_and(|line| !line.trim_start().is_empty());
    let others = sources.iter().filter(|(_, text)| !says(text));
    others.map(|(file, _)| Offence::new(file, 1, "does not begin with `//! ` and what the file is")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn every_file_begins_with_what_it_is() {
        assert_none(
            &without_purpose(&Sources::of_repository()),
            "Write one sentence that is understandable on its own.",
        );
    }

    #[test]
    fn a_file_that_begins_with_code_is_found() {
        let sources = Sources::sample(&[("a.rs", "//! Ankles.\nuse b;"), ("b.rs", "use a;\n//! Knees."), ("c.rs", "")]);
        let files: Vec<String> = without_purpose(&sources).into_iter().map(|offence| offence.file).collect();
        assert_eq!(files, ["b.rs", "c.rs"]);
    }
}
