//! A table of a file: looks up keys, and notes those that are missing or of the wrong type.

use std::ops::Range;
use std::time::Duration;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::place::Place;
use crate::source::{Missing, Source, path_of};
use crate::{Number, Numbers};

/// Most tables of an array `[[key]]`.
const TABLES_MAX: usize = 1000;
/// Longest text (bytes).
const TEXT_MAX: usize = 1000;

/// A table of a file. A missing table yields placeholders without further errors.
pub struct Table<'d> {
    source: &'d Source<'d>,
    path: String,
    entries: Option<&'d DeTable<'d>>,
    span: Range<usize>,
}

impl<'d> Table<'d> {
    pub(crate) fn new(source: &'d Source<'d>, path: String, entries: &'d DeTable<'d>, span: Range<usize>) -> Self {
        // Even a table of which no key is looked up has been visited: all its keys are unknown.
        source.notes.borrow_mut().expected.entry(path.clone()).or_default();
        Self { source, path, entries: Some(entries), span }
    }

    /// The name of the table's file, for messages.
    pub fn file(&self) -> &str {
        self.source.file()
    }

    /// The table's path in the file: `joint.right_knee`.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether an optional key is present.
    pub fn has(&self, key: &str) -> bool {
        self.find(key).is_some()
    }

    /// How many entries an array has; `None` if the key is missing or no array.
    pub fn array_len(&self, key: &str) -> Option<usize> {
        self.find(key).and_then(|value| value.get_ref().as_array()).map(|array| array.len())
    }

    /// A number in the unit that its key ends with.
    pub fn number(&self, key: &str) -> Number<'d> {
        self.scaled(key, 1.0)
    }

    /// An angle or a rate of angle: its key ends with `_deg` or `_deg_per_s`, the value is returned in rad or rad/s.
    pub fn angle(&self, key: &str) -> Number<'d> {
        debug_assert!(key.ends_with("_deg") || key.ends_with("_deg_per_s"), "{key} must name degrees");
        self.scaled(key, f64::to_radians(1.0))
    }

    /// A length of time from `min` to `max`, in the unit of its key, which ends with `_s`, `_ms` or `_us`.
    pub fn duration(&self, key: &str, min: f64, max: f64) -> Duration {
        let unit = match key.rsplit('_').next() {
            Some("ms") => 1e-3,
            Some("us") => 1e-6,
            _ => 1.0,
        };
        Duration::try_from_secs_f64(self.scaled(key, unit).between(min, max)).unwrap_or_default()
    }

    /// `N` numbers in one array, in the unit that the key ends with.
    pub fn numbers<const N: usize>(&self, key: &str) -> Numbers<'d, N> {
        Numbers { place: self.place(key), written: self.array(key), unit: 1.0 }
    }

    /// `N` angles in one array: the key ends with `_deg`, the values are returned in rad.
    pub fn angles<const N: usize>(&self, key: &str) -> Numbers<'d, N> {
        debug_assert!(key.ends_with("_deg"), "{key} must name degrees");
        Numbers { place: self.place(key), written: self.array(key), unit: f64::to_radians(1.0) }
    }

    /// A whole number from `min` to `max`; `min` after noting what is wrong.
    pub fn integer(&self, key: &str, min: u64, max: u64) -> u64 {
        let must = format!("must be a whole number between {min} and {max}");
        let Some(value) = self.require(key, &must) else { return min };
        let number = match value.get_ref() {
            DeValue::Integer(written) => u64::from_str_radix(written.as_str(), written.radix()).ok(),
            _ => None,
        };
        number.filter(|number| (min..=max).contains(number)).unwrap_or_else(|| {
            self.refuse(key, &must);
            min
        })
    }

    /// `true` or `false`; `false` after noting what is wrong.
    pub fn flag(&self, key: &str) -> bool {
        let must = "must be true or false";
        let Some(value) = self.require(key, must) else { return false };
        value.get_ref().as_bool().unwrap_or_else(|| {
            self.refuse(key, must);
            false
        })
    }

    /// A text that is not blank; empty after noting what is wrong.
    pub fn text(&self, key: &str) -> &'d str {
        let must = "must be a text in quotes";
        let Some(value) = self.require(key, must) else { return "" };
        let text = value.get_ref().as_str().filter(|text| !text.trim().is_empty());
        if text.is_some_and(|text| text.len() > TEXT_MAX) {
            self.refuse(key, &format!("must have at most {TEXT_MAX} bytes"));
            return "";
        }
        text.unwrap_or_else(|| {
            self.refuse(key, must);
            ""
        })
    }

    /// A text that names one of `choices`, pairs of name and value; `None` after noting what is wrong.
    pub fn choice<'c, T>(&self, key: &str, choices: impl IntoIterator<Item = (&'c str, T)>) -> Option<T> {
        let mut names = Vec::new();
        let mut by_name = Vec::new();
        for (name, choice) in choices {
            names.push(format!("\"{name}\""));
            by_name.push((name, choice));
        }
        let must = format!("must be one of {}", names.join(", "));
        let written = self.require(key, &must)?.get_ref().as_str();
        let found = by_name.into_iter().find(|(name, _)| Some(*name) == written);
        if found.is_none() {
            self.refuse(key, &must);
        }
        found.map(|(_, choice)| choice)
    }

    /// An array that names each of `choices` once: the choices in the order of the array; `None` after noting what is
    /// wrong.
    pub fn order<T: Copy, const N: usize>(&self, key: &str, choices: [(&str, T); N]) -> Option<[T; N]> {
        let names = choices.map(|(name, _)| format!("\"{name}\""));
        let must = format!("must be an array that names each of {} once", names.join(", "));
        let written = self.require(key, &must)?.get_ref().as_array();
        let places = written.filter(|written| written.len() == N).and_then(|written| {
            let place = |name| choices.iter().position(|(choice, _)| Some(*choice) == name);
            let places: Option<Vec<usize>> = written.iter().map(|value| place(value.get_ref().as_str())).collect();
            places.filter(|places| (0..N).all(|place| places.contains(&place)))
        });
        if places.is_none() {
            self.refuse(key, &must);
        }
        places.map(|places| std::array::from_fn(|rank| choices[places[rank]].1))
    }

    /// The table at a key.
    pub fn table(&self, key: &str) -> Table<'d> {
        let must = "must be a table";
        let found = self.require(key, must).and_then(|value| {
            let table = self.sub_table(key, value);
            if table.is_none() {
                self.refuse(key, must);
            }
            table
        });
        found.unwrap_or(Table { source: self.source, path: self.path_of(key), entries: None, span: 0..0 })
    }

    /// All tables at a key, by the names that the file gives them: `[motor.leg]`, `[motor.arm]`.
    pub fn named_tables(&self, key: &str) -> Vec<(&'d str, Table<'d>)> {
        let parent = self.table(key);
        let names = parent.entries.into_iter().flat_map(|entries| entries.keys());
        names.map(|name| (name.get_ref().as_ref(), parent.table(name.get_ref()))).collect()
    }

    /// The tables of an array `[[key]]`; none when the key is left out.
    pub fn tables(&self, key: &str) -> Vec<Table<'d>> {
        let Some(value) = self.find(key) else { return Vec::new() };
        let array = value.get_ref().as_array();
        if array.is_some_and(|array| array.len() > TABLES_MAX) {
            self.refuse(key, &format!("must be at most {TABLES_MAX} tables"));
            return Vec::new();
        }
        let found = array.and_then(|array| {
            let tables = array.iter().enumerate();
            tables.map(|(index, value)| self.sub_table(&format!("{key}[{index}]"), value)).collect()
        });
        found.unwrap_or_else(|| {
            self.refuse(key, &format!("must be tables, each with the header [[{}]]", self.path_of(key)));
            Vec::new()
        })
    }

    /// Notes that a key's value is wrong; `must` states what would be right. An absent key is noted where its table
    /// begins.
    pub fn refuse(&self, key: &str, must: &str) {
        if self.entries.is_some() {
            self.place(key).refuse(must);
        }
    }

    /// Refuses a key that older files had, where it is present; `must` states what became of it. It is not among the
    /// keys that are suggested for unknown ones.
    pub fn refuse_former(&self, key: &str, must: &str) {
        if self.entries.is_some_and(|entries| entries.get(key).is_some()) && self.has(key) {
            self.refuse(key, must);
        }
    }

    fn place(&self, key: &str) -> Place<'d> {
        let value = self.entries.and_then(|entries| entries.get(key)).map(Spanned::span);
        Place { source: self.source, path: self.path_of(key), value, table: self.span.clone() }
    }

    fn scaled(&self, key: &str, unit: f64) -> Number<'d> {
        let must = "must be a finite number";
        let written = self.require(key, must).map_or(f64::NAN, |value| {
            finite(value.get_ref()).unwrap_or_else(|| {
                self.refuse(key, must);
                f64::NAN
            })
        });
        Number { place: self.place(key), written, unit }
    }

    fn array<const N: usize>(&self, key: &str) -> [f64; N] {
        let must = format!("must be an array of {N} finite numbers");
        let Some(value) = self.require(key, &must) else { return [f64::NAN; N] };
        let numbers: Option<Vec<f64>> =
            value.get_ref().as_array().and_then(|array| array.iter().map(|value| finite(value.get_ref())).collect());
        numbers.and_then(|numbers| numbers.try_into().ok()).unwrap_or_else(|| {
            self.refuse(key, &must);
            [f64::NAN; N]
        })
    }

    /// The value of a required key.
    fn require(&self, key: &str, must: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        let value = self.find(key);
        if value.is_none() && self.entries.is_some() {
            let error =
                self.source.error(&self.path_of(key), self.span.clone(), None, format!("is missing: it {must}"));
            let missing = Missing { table: self.path.clone(), key: key.to_string(), error };
            self.source.notes.borrow_mut().missing.push(missing);
        }
        value
    }

    /// The value of a key, which from now on counts as expected.
    fn find(&self, key: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        let entries = self.entries?;
        let mut notes = self.source.notes.borrow_mut();
        let expected = notes.expected.entry(self.path.clone()).or_default();
        if !expected.iter().any(|known| known == key) {
            expected.push(key.to_string());
        }
        entries.get(key)
    }

    fn sub_table(&self, key: &str, value: &'d Spanned<DeValue<'d>>) -> Option<Table<'d>> {
        let entries = value.get_ref().as_table()?;
        Some(Table::new(self.source, self.path_of(key), entries, value.span()))
    }

    fn path_of(&self, key: &str) -> String {
        path_of(&self.path, key)
    }
}

fn finite(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        DeValue::Integer(written) => i64::from_str_radix(written.as_str(), written.radix()).ok()? as f64,
        DeValue::Float(written) => written.as_str().parse().ok()?,
        _ => return None,
    };
    Some(number).filter(|number: &f64| number.is_finite())
}
