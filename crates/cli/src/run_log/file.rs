//! Writing and reading the log's files.

use std::fs::File;
use std::io::{self, LineWriter};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use super::Row;

/// Why the log of a run could not be written or read. Lines count from 1; the names of the columns are line 1.
#[derive(Debug, thiserror::Error)]
pub enum RunLogError {
    /// The operating system says no.
    #[error("{file}: {source}", file = file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file was written by another version, or is another file.
    #[error("{file}:1: column {number} is `{found}` where it must be `{expected}`", file = file.display())]
    Column {
        /// The file.
        file: PathBuf,
        /// Which column, from 1.
        number: usize,
        /// Its name in the file; empty when it is missing.
        found: String,
        /// The right name; empty when the file has too many columns.
        expected: String,
    },
    /// A line holds something that does not belong there.
    #[error("{file}:{line}: {problem}", file = file.display())]
    Line {
        /// The file.
        file: PathBuf,
        /// Which line.
        line: u64,
        /// What is wrong.
        problem: String,
    },
}

/// Bytes after the last complete line that wait for their end; no line is as long.
const LINE_MAX: usize = 64 * 1024;

/// Writes rows, buffered. The file only ever grows by complete lines, so that a crash leaves a log that can be read.
pub struct RowWriter<R> {
    path: PathBuf,
    csv: csv::Writer<LineWriter<File>>,
    row: PhantomData<R>,
}

impl<R: Row> RowWriter<R> {
    /// Creates the file in the folder `dir`, or empties it, and writes the names of its columns.
    ///
    /// # Errors
    /// When the operating system says no.
    pub fn create(dir: &Path) -> Result<Self, RunLogError> {
        let path = dir.join(R::FILE);
        let file = File::create(&path).map_err(|source| RunLogError::Io { file: path.clone(), source })?;
        let csv = csv::WriterBuilder::new().has_headers(false).from_writer(LineWriter::with_capacity(LINE_MAX, file));
        let mut writer = Self { path, csv, row: PhantomData };
        writer.csv.write_record(R::columns()).map_err(|error| csv_error(&writer.path, error))?;
        Ok(writer)
    }

    /// Writes one row.
    ///
    /// # Errors
    /// When the operating system says no.
    pub fn write(&mut self, row: &R) -> Result<(), RunLogError> {
        self.csv.serialize(row).map_err(|error| csv_error(&self.path, error))
    }

    /// Writes what is still buffered.
    ///
    /// # Errors
    /// When the operating system says no.
    pub fn flush(&mut self) -> Result<(), RunLogError> {
        self.csv.flush().map_err(|source| RunLogError::Io { file: self.path.clone(), source })
    }
}

/// Reads all rows of the file of `R` in the folder `dir`.
///
/// # Errors
/// See [`RunLogError`].
pub fn read_rows<R: Row>(dir: &Path) -> Result<Vec<R>, RunLogError> {
    let path = dir.join(R::FILE);
    let file = File::open(&path).map_err(|source| RunLogError::Io { file: path.clone(), source })?;
    let mut csv = csv::Reader::from_reader(io::BufReader::new(file));
    let columns = csv.headers().map_err(|error| csv_error(&path, error))?;
    check_columns(&path, columns, &R::columns())?;
    csv.records()
        .map(|record| record.and_then(|record| record.deserialize(None)).map_err(|error| csv_error(&path, error)))
        .collect()
}

fn check_columns(file: &Path, found: &csv::StringRecord, expected: &[String]) -> Result<(), RunLogError> {
    for index in 0..found.len().max(expected.len()) {
        let found = found.get(index).unwrap_or_default();
        let expected = expected.get(index).map(String::as_str).unwrap_or_default();
        if found != expected {
            let (found, expected) = (found.to_owned(), expected.to_owned());
            return Err(RunLogError::Column { file: file.to_owned(), number: index + 1, found, expected });
        }
    }
    Ok(())
}

fn csv_error(file: &Path, error: csv::Error) -> RunLogError {
    let (file, line) = (file.to_owned(), error.position().map_or(0, csv::Position::line));
    let text = error.to_string();
    match error.into_kind() {
        csv::ErrorKind::Io(source) => RunLogError::Io { file, source },
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            let problem = format!("{len} values where there must be {expected_len}");
            RunLogError::Line { file, line, problem }
        }
        csv::ErrorKind::Deserialize { err, .. } => {
            let column = err.field().map_or(String::new(), |field| format!("value {}: ", field + 1));
            RunLogError::Line { file, line, problem: format!("{column}{}", err.kind()) }
        }
        _ => RunLogError::Line { file, line, problem: text },
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::fs;

    use balance::CentreOfMass;
    use controller::AddedAngles;
    use nalgebra::Vector3;

    use super::super::{ControllerRow, PlantRow, RunLog, synthetic};
    use super::*;

    fn written(log: &RunLog) -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        let mut plant = RowWriter::create(dir.path()).unwrap();
        log.plant.iter().for_each(|row| plant.write(row).unwrap());
        let mut controller = RowWriter::create(dir.path()).unwrap();
        log.controller.iter().for_each(|row| controller.write(row).unwrap());
        plant.flush().unwrap();
        controller.flush().unwrap();
        dir
    }

    /// Replaces text in a written file and says what reading it then says.
    fn complaint(file: &str, from: &str, to: &str) -> String {
        let dir = written(&synthetic::log(2, 0.3));
        let path = dir.path().join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{text}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        RunLog::read(dir.path()).unwrap_err().to_string()
    }

    #[test]
    fn rows_come_back_as_they_were() {
        let mut log = synthetic::log(3, PI / 7.0);
        log.plant[1].zmp_in_world = None;
        log.plant[2].fallen = true;
        log.plant[3].angles.0[4] = -1.0 / 3.0;
        log.controller[1].margin = None;
        log.controller[2].faults = 5;
        // Degrees in the file: exact for angles that are.
        log.controller[2].turn_command = 15_f64.to_radians();
        let com = CentreOfMass { position: Vector3::new(0.1, PI / 31.0, 0.9), velocity: Vector3::new(0.4, -0.2, 1e-9) };
        log.controller[1].com_planned = Some(com);
        log.controller[2].com_measured = Some(CentreOfMass { position: com.velocity, velocity: com.position });
        let [ankle, waist] = [[1.0_f64, -2.0], [15.0, 45.0]].map(|angles| angles.map(f64::to_radians).into());
        log.controller[3].added = Some(AddedAngles { ankle, waist });
        let dir = written(&log);
        assert_eq!(RunLog::read(dir.path()).unwrap(), log);
    }

    #[test]
    fn every_value_has_a_column() {
        let log = synthetic::log(1, 0.0);
        let dir = written(&log);
        for (file, columns) in [("plant.csv", PlantRow::columns()), ("controller.csv", ControllerRow::columns())] {
            let text = fs::read_to_string(dir.path().join(file)).unwrap();
            assert!(text.lines().all(|line| line.split(',').count() == columns.len()), "{text}");
        }
        let text = fs::read_to_string(dir.path().join("plant.csv")).unwrap();
        assert!(text.contains(",joint_03_angle_rad,"));
    }

    #[test]
    fn what_is_wrong_is_named_with_file_and_line() {
        let column = complaint("plant.csv", "com_x_m", "com_x_mm");
        assert!(column.contains("plant.csv:1: column 32 is `com_x_mm` where it must be `com_x_m`"), "{column}");
        let value = complaint("controller.csv", "walking,right,0,0.5", "walking,right,0,half");
        assert!(value.contains("controller.csv:5: value 6:"), "{value}");
        let side = complaint("controller.csv", "walking,left", "walking,front");
        assert!(side.contains("controller.csv:8:") && side.contains("`right` or `left`"), "{side}");
    }

    #[test]
    fn a_killed_writer_leaves_complete_lines() {
        let (dir, log) = (tempfile::tempdir().unwrap(), synthetic::log(60, 0.0));
        let mut writer = RowWriter::create(dir.path()).unwrap();
        log.plant.iter().for_each(|row| writer.write(row).unwrap());
        // Killed: nothing is flushed or dropped.
        std::mem::forget(writer);
        let rows: Vec<PlantRow> = read_rows(dir.path()).unwrap();
        assert!(rows.len() > 100 && rows.len() < log.plant.len(), "{}", rows.len());
        assert_eq!(rows, log.plant[..rows.len()]);
    }
}
