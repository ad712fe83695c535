//! A recorded gait: hip and knee flexion of one leg over the gait cycle, from a CSV file.
//!
//! Lines that begin with `#` are comments and should name the source. The first other line is the header
//! `gait_cycle_percent,hip_flexion_deg,knee_flexion_deg`; the cycle runs from 0 to 100, the leg is in support during
//! the first half and swings during the second.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use crate::fourier;

/// Flexion of one leg over one gait cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct GaitRecording {
    /// The samples from the start of the cycle to its end, in order.
    pub(crate) samples: Vec<Sample>,
}

/// One instant of a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    /// Share of the gait cycle, 0 to 1: the support phase begins at 0, the swing phase at 0.5.
    pub cycle: f64,
    /// Flexion of the hip: pitch of the thigh ahead of the trunk (rad).
    pub hip_flexion: f64,
    /// Flexion of the knee (rad).
    pub knee_flexion: f64,
}

/// Why a recording cannot be used; the numbers are as in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum GaitRecordingError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {reason}", file = file.display())]
    Unreadable { file: PathBuf, reason: String },
    /// The header is wrong.
    #[error(
        "{file}:{line}: the header is `{found}`; it must be `{expected}`",
        file = file.display(), expected = COLUMNS.join(",")
    )]
    WrongHeader { file: PathBuf, line: usize, found: String },
    /// A line has too few or too many fields.
    #[error(
        "{file}:{line}: {found} fields; there must be {expected}: {columns}",
        file = file.display(), expected = COLUMNS.len(), columns = COLUMNS.join(",")
    )]
    WrongFieldCount { file: PathBuf, line: usize, found: usize },
    /// The value of a field is wrong.
    #[error("{file}:{line}: {column} is `{value}`; it must be {expected}", file = file.display())]
    WrongValue { file: PathBuf, line: usize, column: &'static str, value: String, expected: String },
    /// There are too few samples to determine the shape.
    #[error("{file}: {found} samples; there must be at least {expected}, best evenly spread", file = file.display())]
    TooFewSamples { file: PathBuf, found: usize, expected: usize },
    /// The cycle does not begin at 0 or does not end at 100.
    #[error("{file}:{line}: the cycle {end}s at {value} %; it must {end} at {expected} %", file = file.display())]
    CycleIncomplete { file: PathBuf, line: usize, end: &'static str, value: f64, expected: f64 },
}

/// The names of the columns.
const COLUMNS: [&str; 3] = ["gait_cycle_percent", "hip_flexion_deg", "knee_flexion_deg"];
/// Range of each column, a wide one for people: a value beyond is a mistake of unit or sign.
const RANGES: [RangeInclusive<f64>; 3] = [0.0..=100.0, -60.0..=120.0, -15.0..=150.0];
/// Least number of samples: a few more than the coefficients of the series.
const SAMPLES_MIN: usize = fourier::COEFFICIENTS + 3;

impl GaitRecording {
    /// Reads a recording from a file.
    ///
    /// # Errors
    /// [`GaitRecordingError`] names file, line, column and value, and what would be right.
    pub fn load(file: &Path) -> Result<Self, GaitRecordingError> {
        let text = config::bounded_text(file)
            .map_err(|error| GaitRecordingError::Unreadable { file: file.to_owned(), reason: error.to_string() })?;
        Self::parse(&text, file)
    }

    /// Reads a recording from the text of a file, which is named in errors.
    ///
    /// # Errors
    /// As [`GaitRecording::load`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, GaitRecordingError> {
        let mut samples: Vec<Sample> = Vec::new();
        let mut last_line = 0;
        let mut header_seen = false;
        for (line, text) in (1..).zip(text.lines()) {
            if text.trim().is_empty() || text.starts_with('#') {
                continue;
            }
            let fields: Vec<&str> = text.split(',').map(str::trim).collect();
            if !header_seen {
                if fields != COLUMNS {
                    return Err(GaitRecordingError::WrongHeader {
                        file: file.to_owned(),
                        line,
                        found: config::quoted(text),
                    });
                }
                header_seen = true;
                continue;
            }
            let [percent, hip, knee] = numbers(&fields, file, line)?;
            match samples.last() {
                None if percent != 0.0 => return Err(incomplete(file, line, "begin", percent, 0.0)),
                Some(previous) if percent <= previous.cycle * 100.0 => {
                    let expected = format!("more than the line before, {}", previous.cycle * 100.0);
                    return Err(wrong_value(file, line, 0, fields[0], expected));
                }
                _ => {}
            }
            last_line = line;
            samples.push(Sample {
                cycle: percent / 100.0,
                hip_flexion: hip.to_radians(),
                knee_flexion: knee.to_radians(),
            });
        }
        if !header_seen {
            return Err(GaitRecordingError::WrongHeader { file: file.to_owned(), line: 1, found: String::new() });
        }
        match samples.last() {
            Some(last) if last.cycle != 1.0 => Err(incomplete(file, last_line, "end", last.cycle * 100.0, 100.0)),
            Some(_) if samples.len() >= SAMPLES_MIN => Ok(Self { samples }),
            _ => {
                let (found, expected) = (samples.len(), SAMPLES_MIN);
                Err(GaitRecordingError::TooFewSamples { file: file.to_owned(), found, expected })
            }
        }
    }
}

fn numbers(fields: &[&str], file: &Path, line: usize) -> Result<[f64; 3], GaitRecordingError> {
    if fields.len() != COLUMNS.len() {
        return Err(GaitRecordingError::WrongFieldCount { file: file.to_owned(), line, found: fields.len() });
    }
    let mut numbers = [0.0; 3];
    for (column, number) in numbers.iter_mut().enumerate() {
        let range = &RANGES[column];
        *number = match fields[column].parse() {
            Ok(value) if range.contains(&value) => value,
            _ => {
                let expected = format!("a number from {} to {}", range.start(), range.end());
                return Err(wrong_value(file, line, column, fields[column], expected));
            }
        };
    }
    Ok(numbers)
}

fn wrong_value(file: &Path, line: usize, column: usize, value: &str, expected: String) -> GaitRecordingError {
    GaitRecordingError::WrongValue {
        file: file.to_owned(),
        line,
        column: COLUMNS[column],
        value: config::quoted(value),
        expected,
    }
}

fn incomplete(file: &Path, line: usize, end: &'static str, value: f64, expected: f64) -> GaitRecordingError {
    GaitRecordingError::CycleIncomplete { file: file.to_owned(), line, end, value, expected }
}
