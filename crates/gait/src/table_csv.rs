//! The nominal half-step as a file: CSV that a spreadsheet reads, with a header of `#` lines.
//!
//! Numbers are the shortest that read back to the same bits, so reading and writing again changes no byte. Joint
//! columns carry the paper's numbers: `joint_01_angle_rad` … `joint_20_torque_dynamic_nm`.

use std::io;
use std::path::{Path, PathBuf};

use model::{Joint, JointVector, Motion, PerJoint, Wrench};
use nalgebra::Vector3;

use crate::{NominalRow, NominalTable};

/// Number of header lines, which begin with `#`.
const HEADER_LINES: usize = 4;
/// The first line of the header.
const VERSION: &str = "# halfstep nominal half-step v1";
/// Beginning of the second line of the header, before the command that made the table.
const MADE_BY: &str = "# made by: ";
/// Beginning of the third line of the header, before the fingerprint of the mechanism.
const MECHANISM: &str = "# mechanism: ";
/// Beginning of the fourth line of the header, before the duration.
const DURATION: &str = "# duration_s = ";

/// Shortest and longest half-step (s).
const DURATION_MIN: f64 = 0.05;
const DURATION_MAX: f64 = 10.0;
/// Most rows: a hundred times as many as ours.
const ROWS_MAX: usize = 10_000;
/// Largest difference of a row's time from the one that follows from the duration (s): a spreadsheet may round.
const TIME_TOLERANCE: f64 = 1e-6;

/// The quantities of each joint in a row, in the file's order, after the `interval` and `t_s` columns.
const JOINT_QUANTITIES: [&str; 5] =
    ["angle_rad", "rate_rad_s", "acceleration_rad_s2", "torque_gravity_nm", "torque_dynamic_nm"];
/// The parts of the ground's wrench in a row, after the joints.
const GROUND_PARTS: [&str; 2] = ["gravity", "dynamic"];
/// The components of a wrench, in the file's order.
const WRENCH_COMPONENTS: [&str; 6] = ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"];

/// Why a table's file could not be read or written. Lines and columns count from 1.
#[derive(Debug, thiserror::Error)]
pub enum TableFileError {
    /// The operating system refused.
    #[error("{file}: {source}", file = file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// The reason given by the system.
        source: io::Error,
    },
    /// A line of the header is wrong.
    #[error("{file}:{line}: the header says `{found}` where it must say {expected}", file = file.display())]
    Header {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// The text found there.
        found: String,
        /// The text or value that would be right.
        expected: String,
    },
    /// A column has a wrong name.
    #[error("{file}:{line}: column {column} is named `{found}`; it must be `{expected}`", file = file.display())]
    ColumnName {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// The column, from 1.
        column: usize,
        /// The name found; empty where the line ends early.
        found: String,
        /// The text or value that would be right.
        expected: String,
    },
    /// A row is too short or too long.
    #[error(
        "{file}:{line}: the row has {found} values; it must have {expected}, one for each column",
        file = file.display()
    )]
    RowLength {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// Number of values in the row.
        found: usize,
        /// Number of values that it must have.
        expected: usize,
    },
    /// The file ends before the half-step does.
    #[error("{file}:{line}: the file ends early: {found}; copy it again, or make it anew", file = file.display())]
    EndsEarly {
        /// The file.
        file: PathBuf,
        /// The last line.
        line: u64,
        /// How far the file goes, and how far it should go.
        found: String,
    },
    /// The table is too long.
    #[error("{file}: has {found} rows; it may have at most {ROWS_MAX}", file = file.display())]
    TooManyRows {
        /// The file.
        file: PathBuf,
        /// Number of rows.
        found: usize,
    },
    /// A value is wrong.
    #[error("{file}:{line}: {column} is `{value}`; it must be {expected}", file = file.display())]
    Value {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// The column's name.
        column: String,
        /// The text found there.
        value: String,
        /// The text or value that would be right.
        expected: String,
    },
    /// The text is not valid CSV.
    #[error("{file}: {source}", file = file.display())]
    Csv {
        /// The file.
        file: PathBuf,
        /// The reason given by the CSV reader, with the line.
        source: csv::Error,
    },
    /// The command that made the table has several lines; the header has one for it.
    #[error("the table is said to be made by {0:?}: the file's header needs that on one line")]
    MadeByOnSeveralLines(String),
}

impl NominalTable {
    /// Reads a file. Its values are finite and equally spaced in time; [`check`](Self::check) tests whether they are a
    /// half-step.
    ///
    /// # Errors
    /// The file cannot be read, or the first mistake in it.
    pub fn read_csv(file: &Path) -> Result<Self, TableFileError> {
        let text = config::bounded_text(file).map_err(|source| TableFileError::Io { file: file.into(), source })?;
        Self::from_csv(&text, file)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// The file cannot be written, or `made_by` has several lines.
    pub fn write_csv(&self, file: &Path) -> Result<(), TableFileError> {
        std::fs::write(file, self.to_csv()?).map_err(|source| TableFileError::Io { file: file.into(), source })
    }

    /// The text of the file.
    ///
    /// # Errors
    /// `made_by` has several lines.
    pub fn to_csv(&self) -> Result<String, TableFileError> {
        if self.made_by.contains(['\n', '\r']) {
            return Err(TableFileError::MadeByOnSeveralLines(self.made_by.clone()));
        }
        let mut text = format!(
            "{VERSION}\n{MADE_BY}{}\n{MECHANISM}{:016x}\n{DURATION}{:?}\n{}\n",
            self.made_by,
            self.mechanism,
            self.duration,
            column_names().join(",")
        );
        for (interval, row) in self.rows.iter().enumerate() {
            text.push_str(&interval.to_string());
            for value in std::iter::once(self.time(interval, self.rows.len())).chain(values(row)) {
                // Debug is the shortest text that reads back to the same bits.
                text.push_str(&format!(",{value:?}"));
            }
            text.push('\n');
        }
        Ok(text)
    }

    /// Reads the text of a file; `file` is its name in errors.
    ///
    /// # Errors
    /// The first mistake in it.
    pub fn from_csv(text: &str, file: &Path) -> Result<Self, TableFileError> {
        let mut table = read_header(text, file)?;
        let body: usize = text.split_inclusive('\n').take(HEADER_LINES).map(str::len).sum();
        let mut reader =
            csv::ReaderBuilder::new().flexible(true).has_headers(false).from_reader(&text.as_bytes()[body..]);
        let records = reader
            .records()
            .collect::<Result<Vec<_>, _>>()
            .map_err(|source| TableFileError::Csv { file: file.into(), source })?;
        let names = column_names();
        let (first, rows) = match records.split_first() {
            Some((first, rows)) => (first.clone(), rows),
            None => (csv::StringRecord::new(), records.as_slice()),
        };
        for column in 0..names.len().max(first.len()) {
            let (found, expected) = (first.get(column).unwrap_or(""), names.get(column).map_or("", String::as_str));
            if found != expected {
                let (line, column) = (line_of(&first), column + 1);
                let (file, found, expected) = (file.into(), config::quoted(found), expected.into());
                return Err(TableFileError::ColumnName { file, line, column, found, expected });
            }
        }
        if rows.len() > ROWS_MAX {
            return Err(TableFileError::TooManyRows { file: file.into(), found: rows.len() });
        }
        if let Some((line, found)) = early_end(text, rows, names.len(), table.duration) {
            return Err(TableFileError::EndsEarly { file: file.into(), line, found });
        }
        for (interval, record) in rows.iter().enumerate() {
            let expected_time = table.time(interval, rows.len());
            table.rows.push(read_row(record, &names, interval, expected_time, file)?);
        }
        Ok(table)
    }

    /// Time of the row at the start of `interval`, in a table with this number of rows (s).
    fn time(&self, interval: usize, rows: usize) -> f64 {
        self.duration * interval as f64 / (rows.max(2) - 1) as f64
    }
}

/// The last line, and in words how far the file goes, if it was cut off: in the midst of a row, or after one.
fn early_end(text: &str, rows: &[csv::StringRecord], columns: usize, duration: f64) -> Option<(u64, String)> {
    let last = rows.last()?;
    let line = line_of(last);
    if !text.ends_with('\n') && last.len() < columns {
        return Some((line, format!("its last row has {} of {columns} values", last.len())));
    }
    let time = |row: &csv::StringRecord| row.get(1)?.parse::<f64>().ok();
    let (step, end) = (time(rows.get(1)?)?, time(last)?);
    let is_short = end > 0.0 && end < duration - step / 2.0;
    let is_even = || {
        let mut times = rows.iter().enumerate().map(|(interval, row)| (step * interval as f64, time(row)));
        times.all(|(expected, time)| time.is_some_and(|time| (time - expected).abs() < TIME_TOLERANCE))
    };
    (is_short && is_even()).then(|| (line, format!("its last row is at {end} s of {duration} s")))
}

/// A table without rows, from the four `#` lines.
fn read_header(text: &str, file: &Path) -> Result<NominalTable, TableFileError> {
    let mut lines = text.lines();
    let mut after = |line: u64, prefix: &str, what: &str| {
        let found = lines.next().unwrap_or("");
        found.strip_prefix(prefix).map(str::to_owned).ok_or_else(|| TableFileError::Header {
            file: file.into(),
            line,
            found: config::quoted(found),
            expected: format!("`{prefix}{what}`"),
        })
    };
    let bad = |line: u64, prefix: &str, found: &str, what: &str| TableFileError::Header {
        file: file.into(),
        line,
        found: config::quoted(&format!("{prefix}{found}")),
        expected: format!("`{prefix}` and then {what}"),
    };
    let version = after(1, VERSION, "")?;
    if !version.is_empty() {
        return Err(bad(1, VERSION, &version, "nothing: this program reads version 1"));
    }
    let made_by = after(2, MADE_BY, "<the command that made the table>")?;
    let mechanism = after(3, MECHANISM, "<fingerprint, 16 hexadecimal digits>")?;
    let duration = after(4, DURATION, "<seconds>")?;
    Ok(NominalTable {
        mechanism: u64::from_str_radix(&mechanism, 16)
            .map_err(|_| bad(3, MECHANISM, &mechanism, "the mechanism's fingerprint, 16 hexadecimal digits"))?,
        duration: duration
            .parse()
            .ok()
            .filter(|seconds: &f64| (DURATION_MIN..=DURATION_MAX).contains(seconds))
            .ok_or_else(|| {
                let what = format!("a number of seconds between {DURATION_MIN} and {DURATION_MAX}, like 0.6");
                bad(4, DURATION, &duration, &what)
            })?,
        made_by,
        rows: Vec::new(),
    })
}

fn read_row(
    record: &csv::StringRecord,
    names: &[String],
    interval: usize,
    time: f64,
    file: &Path,
) -> Result<NominalRow, TableFileError> {
    let line = line_of(record);
    if record.len() != names.len() {
        let (found, expected) = (record.len(), names.len());
        return Err(TableFileError::RowLength { file: file.into(), line, found, expected });
    }
    let wrong = |column: usize, expected: String| {
        let (column, value) = (names[column].clone(), config::quoted(&record[column]));
        TableFileError::Value { file: file.into(), line, column, value, expected }
    };
    let number = |column: usize| {
        let number = record[column].parse().ok().filter(|value: &f64| value.is_finite());
        number.ok_or_else(|| wrong(column, "a finite number, like -0.25".into()))
    };
    if record[0].parse() != Ok(interval) {
        return Err(wrong(0, format!("{interval}: rows count from 0 without gaps")));
    }
    // The time only repeats what follows from duration and row.
    if (number(1)? - time).abs() > TIME_TOLERANCE {
        return Err(wrong(1, format!("{time:?}: rows are equally spaced from 0 to the duration")));
    }
    let in_range = |column: usize| {
        let (number, max) = (number(column)?, largest(column));
        if number.abs() > max { Err(wrong(column, format!("between -{max} and {max}"))) } else { Ok(number) }
    };
    let numbers = (2..names.len()).map(in_range).collect::<Result<Vec<_>, _>>()?;
    let joints = |quantity: usize| -> JointVector {
        PerJoint::from_fn(|joint| numbers[quantity * Joint::COUNT + joint.index()])
    };
    let ground = |part: usize| {
        let at = JOINT_QUANTITIES.len() * Joint::COUNT + part * WRENCH_COMPONENTS.len();
        let wrench = &numbers[at..at + WRENCH_COMPONENTS.len()];
        Wrench { force: Vector3::from_column_slice(&wrench[..3]), moment: Vector3::from_column_slice(&wrench[3..]) }
    };
    Ok(NominalRow {
        motion: Motion { angles: joints(0), rates: joints(1), accelerations: joints(2) },
        torque_gravity: joints(3),
        torque_dynamic: joints(4),
        ground_gravity: ground(0),
        ground_dynamic: ground(1),
    })
}

/// The largest value of a column, either way: far more than any robot does.
fn largest(column: usize) -> f64 {
    const LARGEST: [f64; JOINT_QUANTITIES.len()] = [6.3, 100.0, 1e5, 1e6, 1e6];
    const LARGEST_OF_GROUND: f64 = 1e7;
    LARGEST.get(column.saturating_sub(2) / Joint::COUNT).copied().unwrap_or(LARGEST_OF_GROUND)
}

/// The names of all columns, from left to right.
fn column_names() -> Vec<String> {
    let joint = |quantity: &'static str| {
        Joint::ALL.into_iter().map(move |joint| format!("joint_{:02}_{quantity}", joint.number()))
    };
    let ground =
        |part: &'static str| WRENCH_COMPONENTS.into_iter().map(move |component| format!("ground_{part}_{component}"));
    ["interval", "t_s"]
        .into_iter()
        .map(String::from)
        .chain(JOINT_QUANTITIES.into_iter().flat_map(joint))
        .chain(GROUND_PARTS.into_iter().flat_map(ground))
        .collect()
}

/// The values of a row in the order of the columns, after the time.
fn values(row: &NominalRow) -> impl Iterator<Item = f64> {
    let NominalRow { motion, torque_gravity, torque_dynamic, ground_gravity, ground_dynamic } = *row;
    [motion.angles, motion.rates, motion.accelerations, torque_gravity, torque_dynamic]
        .into_iter()
        .flat_map(|joints| joints.0)
        .chain([ground_gravity, ground_dynamic].into_iter().flat_map(|wrench| {
            let Wrench { force, moment } = wrench;
            [force.x, force.y, force.z, moment.x, moment.y, moment.z]
        }))
}

/// The line of the file at which a record begins, from 1.
fn line_of(record: &csv::StringRecord) -> u64 {
    HEADER_LINES as u64 + record.position().map_or(1, csv::Position::line)
}
