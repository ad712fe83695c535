//! Replaces values in the text of a TOML file; comments and all other text stay.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text with new values, each given by the path of its key. `None` if the text is no TOML or lacks a key.
pub(super) fn replaced(text: &str, values: &[(String, String)]) -> Option<String> {
    let root = DeTable::parse(text).ok()?;
    let mut places = Vec::new();
    for (path, value) in values {
        places.push((span(root.get_ref(), path)?, value));
    }
    // From the end on, so that earlier places stay where they are.
    places.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    for (span, value) in places {
        text.replace_range(span, value);
    }
    Some(text)
}

/// The text with other lines in the place of a key of a table and its value; unchanged if it lacks the key.
pub(super) fn with_lines(text: &str, table: &str, key: &str, lines: &str) -> String {
    let found = DeTable::parse(text).ok().and_then(|root| match root.get_ref().get(table)?.get_ref() {
        DeValue::Table(table) => table.get_key_value(key).map(|(key, value)| key.span().start..value.span().end),
        _ => None,
    });
    let mut text = text.to_owned();
    if let Some(found) = found {
        text.replace_range(found, lines);
    }
    text
}

/// Where the value of a key is in the text.
fn span(root: &DeTable, path: &str) -> Option<Range<usize>> {
    match path.split_once('.') {
        None => root.get(path).map(Spanned::span),
        Some((table, rest)) => match root.get(table)?.get_ref() {
            DeValue::Table(table) => span(table, rest),
            _ => None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{replaced, with_lines};

    fn pairs(values: &[(&str, &str)]) -> Vec<(String, String)> {
        values.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect()
    }

    #[test]
    fn values_change_and_comments_stay() {
        let text = "# body\n[sole] # seen from above\nbehind_m = 0.07 # heel\n[joint.knee]\naxis = [0, 1, 0]\n";
        let values = pairs(&[("joint.knee.axis", "[1, 0, 0]"), ("sole.behind_m", "0.081")]);
        let wanted = "# body\n[sole] # seen from above\nbehind_m = 0.081 # heel\n[joint.knee]\naxis = [1, 0, 0]\n";
        assert_eq!(replaced(text, &values).as_deref(), Some(wanted));
    }

    #[test]
    fn a_key_gives_way_to_others() {
        let text = "[sole]\nwidth_m = 0.08 # both\n";
        assert_eq!(with_lines(text, "sole", "width_m", "a = 1\nb = 2"), "[sole]\na = 1\nb = 2 # both\n");
        assert_eq!(with_lines(text, "sole", "length_m", "a = 1"), text);
    }

    #[test]
    fn a_key_that_is_not_there_is_not_invented() {
        assert_eq!(replaced("[sole]\nbehind_m = 0.07\n", &pairs(&[("sole.ahead_m", "0.2")])), None);
        assert_eq!(replaced("sole = 1\n", &pairs(&[("sole.ahead_m", "0.2")])), None);
    }
}
