//! A table of a file: asked for its keys, it notes what is missing or of the wrong type.

use std::ops::Range;
use std::time::Duration;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::document::Missing;
use super::{Document, Number, Numbers};

/// A table of a file. A table that is missing gives placeholders without further complaint.
pub struct Table<'d> {
    document: &'d Document<'d>,
    path: String,
    entries: Option<&'d DeTable<'d>>,
    span: Range<usize>,
}

impl<'d> Table<'d> {
    pub(super) fn new(document: &'d Document<'d>, path: String, entries: &'d DeTable<'d>, span: Range<usize>) -> Self {
        // Even a table that is asked for nothing has been visited: all its keys are unknown.
        document.notes().borrow_mut().asked.entry(path.clone()).or_default();
        Self { document, path, entries: Some(entries), span }
    }

    /// Where the table is in the file: `joint.right_knee`.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether a key is there, for keys that may be left out.
    pub fn has(&self, key: &str) -> bool {
        self.find(key).is_some()
    }

    /// A number in the unit that its key ends with.
    pub fn number<'a>(&'a self, key: &'a str) -> Number<'a> {
        self.scaled(key, 1.0)
    }

    /// An angle or a rate of angle: its key ends with `_deg` or `_deg_per_s`, the value is given in [rad] or [rad/s].
    pub fn angle<'a>(&'a self, key: &'a str) -> Number<'a> {
        debug_assert!(key.ends_with("_deg") || key.ends_with("_deg_per_s"), "{key} must name degrees");
        self.scaled(key, f64::to_radians(1.0))
    }

    /// A length of time greater than 0: its key ends with `_s`, `_ms` or `_us`.
    pub fn duration(&self, key: &str) -> Duration {
        let unit = match key.rsplit('_').next() {
            Some("ms") => 1e-3,
            Some("us") => 1e-6,
            _ => 1.0,
        };
        Duration::try_from_secs_f64(self.scaled(key, unit).positive()).unwrap_or_default()
    }

    /// `N` numbers in one array, in the unit that the key ends with.
    pub fn numbers<'a, const N: usize>(&'a self, key: &'a str) -> Numbers<'a, N> {
        Numbers { table: self, key, written: self.array(key), unit: 1.0 }
    }

    /// `N` angles in one array: the key ends with `_deg`, the values are given in [rad].
    pub fn angles<'a, const N: usize>(&'a self, key: &'a str) -> Numbers<'a, N> {
        debug_assert!(key.ends_with("_deg"), "{key} must name degrees");
        Numbers { table: self, key, written: self.array(key), unit: f64::to_radians(1.0) }
    }

    /// A whole number of `[min, max]`; `min` after noting what is wrong.
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

    /// A text that is not empty; empty after noting what is wrong.
    pub fn text(&self, key: &str) -> &'d str {
        let must = "must be a text in quotes";
        let Some(value) = self.require(key, must) else { return "" };
        value.get_ref().as_str().filter(|text| !text.trim().is_empty()).unwrap_or_else(|| {
            self.refuse(key, must);
            ""
        })
    }

    /// A text that names one of `choices`, each given with its name; `None` after noting what is wrong.
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

    /// An array that names each of `choices` once, in an order that means something; `None` after noting what is wrong.
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

    /// The table under a key.
    pub fn table(&self, key: &str) -> Table<'d> {
        let must = "must be a table";
        let found = self.require(key, must).and_then(|value| {
            let table = self.sub_table(key, value);
            if table.is_none() {
                self.refuse(key, must);
            }
            table
        });
        found.unwrap_or(Table { document: self.document, path: self.path_of(key), entries: None, span: 0..0 })
    }

    /// All tables under a key, by the names that the file's author chose: `[motor.leg]`, `[motor.arm]`.
    pub fn named_tables(&self, key: &str) -> Vec<(&'d str, Table<'d>)> {
        let parent = self.table(key);
        let names = parent.entries.into_iter().flat_map(|entries| entries.keys());
        names.map(|name| (name.get_ref().as_ref(), parent.table(name.get_ref()))).collect()
    }

    /// The tables of an array `[[key]]`; none when the key is left out.
    pub fn tables(&self, key: &str) -> Vec<Table<'d>> {
        let Some(value) = self.find(key) else { return Vec::new() };
        let found = value.get_ref().as_array().and_then(|array| {
            let tables = array.iter().enumerate();
            tables.map(|(index, value)| self.sub_table(&format!("{key}[{index}]"), value)).collect()
        });
        found.unwrap_or_else(|| {
            self.refuse(key, &format!("must be tables, each with the header [[{}]]", self.path_of(key)));
            Vec::new()
        })
    }

    /// Notes that a key's value is wrong; `must` says what would be right. A key that is not there is noted where its
    /// table begins.
    pub fn refuse(&self, key: &str, must: &str) {
        let Some(entries) = self.entries else { return };
        let span = entries.get(key).map(Spanned::span);
        let at = span.clone().unwrap_or(self.span.clone());
        self.document.note(self.document.error(&self.path_of(key), at, span, must));
    }

    fn scaled<'a>(&'a self, key: &'a str, unit: f64) -> Number<'a> {
        let must = "must be a finite number";
        let written = self.require(key, must).map_or(f64::NAN, |value| {
            finite(value.get_ref()).unwrap_or_else(|| {
                self.refuse(key, must);
                f64::NAN
            })
        });
        Number { table: self, key, written, unit }
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

    /// The value of a key that must be there.
    fn require(&self, key: &str, must: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        let value = self.find(key);
        if value.is_none() && self.entries.is_some() {
            let error =
                self.document.error(&self.path_of(key), self.span.clone(), None, format!("is missing: it {must}"));
            let missing = Missing { table: self.path.clone(), key: key.to_string(), error };
            self.document.notes().borrow_mut().missing.push(missing);
        }
        value
    }

    /// The value of a key, which from now on counts as asked for.
    fn find(&self, key: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        let entries = self.entries?;
        let mut notes = self.document.notes().borrow_mut();
        let asked = notes.asked.entry(self.path.clone()).or_default();
        if !asked.iter().any(|known| known == key) {
            asked.push(key.to_string());
        }
        entries.get(key)
    }

    fn sub_table(&self, key: &str, value: &'d Spanned<DeValue<'d>>) -> Option<Table<'d>> {
        let entries = value.get_ref().as_table()?;
        Some(Table::new(self.document, self.path_of(key), entries, value.span()))
    }

    fn path_of(&self, key: &str) -> String {
        join(&self.path, key)
    }
}

/// The path of a key in the table at `table`.
pub(super) fn join(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_string() } else { format!("{table}.{key}") }
}

fn finite(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        DeValue::Integer(written) => i64::from_str_radix(written.as_str(), written.radix()).ok()? as f64,
        DeValue::Float(written) => written.as_str().parse().ok()?,
        _ => return None,
    };
    Some(number).filter(|number: &f64| number.is_finite())
}
