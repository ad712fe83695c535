//! Keys that no loader looked up, and the key that was probably meant.
//!
//! A wrong unit is an unknown key too: `range_rad` or `range` stands where `range_deg` is expected.

use toml::de::{DeTable, DeValue};

use crate::ConfigError;
use crate::source::{ERRORS_MAX, Source, path_of};

/// The words that units at the end of keys are made of: `range_deg`, `torque_constant_n_m_per_a`.
const UNIT_WORDS: [&str; 26] = [
    "a", "cm", "cm2", "deg", "g", "hz", "kg", "m", "m2", "ma", "mm", "ms", "mv", "n", "ohm", "per", "percent", "rad",
    "rpm", "s", "s2", "turns", "us", "v", "w", "mn",
];

/// The error of every unknown key in the tables that were visited, from `root` down. A missing key is no longer missing
/// when an unknown one was probably meant to be it.
pub(crate) fn unknown_keys(source: &Source<'_>, root: &DeTable<'_>) -> Vec<ConfigError> {
    let mut errors = Vec::new();
    visit(source, "", root, &mut errors);
    errors
}

fn visit(source: &Source<'_>, path: &str, table: &DeTable<'_>, errors: &mut Vec<ConfigError>) {
    let Some(expected) = source.notes.borrow().expected.get(path).cloned() else { return };
    for (key, value) in table {
        if errors.len() >= ERRORS_MAX {
            return;
        }
        let name = key.get_ref().as_ref();
        let key_path = path_of(path, name);
        if !expected.iter().any(|known| known == name) {
            let free: Vec<&str> =
                expected.iter().map(String::as_str).filter(|known| !table.contains_key(*known)).collect();
            let found = (!value.get_ref().is_table()).then(|| value.span());
            let message = match meant(name, &free) {
                Some(meant) => {
                    source.notes.borrow_mut().missing.retain(|m| m.table != path || m.key != meant);
                    format!("unknown key; write `{meant}`")
                }
                None if expected.is_empty() => "unknown key; none is expected here".to_string(),
                None => format!("unknown key; expected one of {}", expected.join(", ")),
            };
            errors.push(source.error(&key_path, key.span(), found, message));
            continue;
        }
        match value.get_ref() {
            DeValue::Table(inner) => visit(source, &key_path, inner, errors),
            DeValue::Array(array) => {
                for (index, value) in array.iter().enumerate() {
                    if let DeValue::Table(inner) = value.get_ref() {
                        visit(source, &format!("{key_path}[{index}]"), inner, errors);
                    }
                }
            }
            _ => {}
        }
    }
}

/// The expected key that `name` was probably meant to be: the same quantity in another unit, or nearly the same word.
fn meant<'a>(name: &str, expected: &[&'a str]) -> Option<&'a str> {
    let same_quantity = expected.iter().find(|key| without_unit(key) == without_unit(name));
    let nearest = || {
        let nearest = expected.iter().min_by_key(|key| distance(key, name))?;
        (distance(nearest, name) <= nearest.len().div_ceil(4)).then_some(nearest)
    };
    same_quantity.or_else(nearest).copied()
}

/// The key up to the unit that it ends with.
fn without_unit(key: &str) -> &str {
    match key.rsplit_once('_') {
        Some((quantity, word)) if UNIT_WORDS.contains(&word) => without_unit(quantity),
        _ => key,
    }
}

/// Levenshtein's distance: how many letters to insert, remove or change.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let change = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_with_another_unit_suggests_the_right_key() {
        let expected = ["range_deg", "mass_kg", "rate_max_deg_per_s", "com_m"];
        assert_eq!(meant("range_rad", &expected), Some("range_deg"));
        assert_eq!(meant("range", &expected), Some("range_deg"));
        assert_eq!(meant("mass_g", &expected), Some("mass_kg"));
        assert_eq!(meant("rate_max_rad_per_s", &expected), Some("rate_max_deg_per_s"));
    }

    #[test]
    fn a_misspelt_key_suggests_the_nearest_key() {
        assert_eq!(meant("parnet", &["number", "parent"]), Some("parent"));
        assert_eq!(meant("colour", &["number", "parent"]), None);
    }

    #[test]
    fn levenshtein_distances_are_the_textbook_ones() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("same", "same"), 0);
    }
}
