//! Pieces of TOML.

use std::fmt::Write;

use nalgebra::Vector3;

/// Steps per unit to which lengths and parts of axes are rounded: less is noise.
pub(super) const FINE: f64 = 1e12;
/// Steps per unit to which angles and what else is no length are rounded.
pub(super) const COARSE: f64 = 1e9;

/// Keys with their values, written.
pub(super) type Keys = Vec<(&'static str, String)>;

/// A rounded number; zero has no sign.
pub(super) fn number(value: f64, per_unit: f64) -> String {
    ((value * per_unit).round() / per_unit + 0.0).to_string()
}

/// A number with twelve digits, however small it is.
pub(super) fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    let rounded = rounded + 0.0;
    if rounded != 0.0 && rounded.abs() < 1e-4 { format!("{rounded:e}") } else { rounded.to_string() }
}

/// An array of numbers already written.
pub(super) fn array(numbers: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", numbers.into_iter().collect::<Vec<_>>().join(", "))
}

/// An array of a vector's rounded numbers.
pub(super) fn vector(vector: &Vector3<f64>, per_unit: f64) -> String {
    array(vector.iter().map(|value| number(*value, per_unit)))
}

/// A text in quotes, or a key: letters of all scripts stand as they are, control characters as escapes.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            _ if letter.is_control() => {
                // Writing into a text cannot fail.
                let _ = write!(quoted, "\\u{:04X}", u32::from(letter));
            }
            _ => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// Writes a table with its keys.
pub(super) fn table(text: &mut String, header: &str, keys: &[(&str, String)]) {
    let _ = writeln!(text, "\n{header}");
    for (key, value) in keys {
        let _ = writeln!(text, "{key} = {value}");
    }
}
