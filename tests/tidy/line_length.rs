//! Lines have at most 120 characters, even where rustfmt cannot break them.
//!
//! A raw string that is a line of another format, e.g. of XML, may be longer.

use crate::offence::Offence;
use crate::sources::Sources;

/// Longest line allowed (characters); the same as `max_width` in rustfmt.toml.
pub const LENGTH_MAX: usize = 120;

/// Lines longer than [`LENGTH_MAX`].
pub fn too_long(sources: &Sources) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.iter() {
        for (index, line) in text.lines().enumerate() {
            let length = line.chars().count();
            if length > LENGTH_MAX && !line.trim_start().starts_with("r#\"") {
                offences.push(Offence::new(file, index + 1, format!("{length} characters")));
            }
        }
    }
    offences
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    #[test]
    fn no_line_is_longer_than_120_characters() {
        let remedy = "Break the line; rustfmt breaks neither comments nor strings nor macro calls.";
        assert_none(&too_long(&Sources::of_repository()), remedy);
    }

    #[test]
    fn characters_are_counted_and_not_bytes() {
        let (fits, too_long_by_one) = ("α".repeat(LENGTH_MAX), "a".repeat(LENGTH_MAX + 1));
        let text = format!("{fits}\n{too_long_by_one}\n");
        assert_eq!(too_long(&Sources::sample(&[("a.rs", &text)])), [Offence::new("a.rs", 2, "121 characters")]);
    }
}
