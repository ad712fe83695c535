//! Writes the log as CSV files.

use std::fs::File;
use std::path::{Path, PathBuf};

use model::Mechanism;

use super::each_row::{RunRow, each_row};
use super::{ControllerRow, CsvRow, DriveRow, PlantRow};

/// Why a CSV file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum CsvError {
    /// The operating system or the writer refused.
    #[error("{}: {cause}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Why it was refused.
        cause: csv::Error,
    },
    /// The recording cannot be read.
    #[error(transparent)]
    Recording(#[from] record::RecordError),
}

/// Writes every row of a run, however long it is, into the CSV files of plant, controller and drives in the folder
/// `dir`, and returns their paths. Drives have no rows without the mechanism that they belong to.
///
/// # Errors
/// The run cannot be read, or a file cannot be written.
pub fn write_csv(run: &Path, dir: &Path, mechanism: Option<&Mechanism>) -> Result<[PathBuf; 3], CsvError> {
    let (mut plant, mut controller) = (CsvFile::create::<PlantRow>(dir)?, CsvFile::create::<ControllerRow>(dir)?);
    let mut drives = CsvFile::create::<DriveRow>(dir)?;
    each_row(run, mechanism, None, |row| match row {
        RunRow::Plant(row) => plant.write(&row),
        RunRow::Controller(row) => controller.write(&row),
        RunRow::Drives(row) => drives.write(&row),
    })?;
    Ok([plant.finish()?, controller.finish()?, drives.finish()?])
}

/// A CSV file that is being written, until the first failure.
struct CsvFile {
    path: PathBuf,
    writer: csv::Writer<File>,
    result: Result<(), csv::Error>,
}

impl CsvFile {
    fn create<R: CsvRow>(dir: &Path) -> Result<Self, CsvError> {
        let path = dir.join(R::FILE);
        let create = || -> Result<csv::Writer<File>, csv::Error> {
            let mut writer = csv::WriterBuilder::new().has_headers(false).from_path(&path)?;
            writer.write_record(R::columns())?;
            Ok(writer)
        };
        match create() {
            Ok(writer) => Ok(Self { path, writer, result: Ok(()) }),
            Err(cause) => Err(CsvError::File { path, cause }),
        }
    }

    fn write(&mut self, row: &impl CsvRow) {
        if self.result.is_ok() {
            self.result = self.writer.serialize(row);
        }
    }

    fn finish(mut self) -> Result<PathBuf, CsvError> {
        match self.result.and_then(|()| Ok(self.writer.flush()?)) {
            Ok(()) => Ok(self.path),
            Err(cause) => Err(CsvError::File { path: self.path, cause }),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::synthetic;
    use super::*;

    #[test]
    fn csv_rows_have_as_many_values_as_columns() {
        let (log, dir) = (synthetic::log(1, 0.0), tempfile::tempdir().unwrap());
        fn written<R: CsvRow>(dir: &Path, rows: &[R]) -> PathBuf {
            let mut file = CsvFile::create::<R>(dir).unwrap();
            rows.iter().for_each(|row| file.write(row));
            file.finish().unwrap()
        }
        let plant = written(dir.path(), &log.plant);
        let controller = written(dir.path(), &log.controller);
        let drive_rows = [synthetic::drives_at(0.5, &synthetic::mechanism(), |_| 2.0)];
        let drives = written(dir.path(), &drive_rows);
        for (file, columns, rows) in [
            (&plant, PlantRow::columns(), log.plant.len()),
            (&controller, ControllerRow::columns(), log.controller.len()),
            (&drives, DriveRow::columns(), drive_rows.len()),
        ] {
            let text = fs::read_to_string(file).unwrap();
            assert_eq!(text.lines().count(), rows + 1);
            assert!(text.lines().all(|line| line.split(',').count() == columns.len()), "{text}");
        }
        assert!(fs::read_to_string(plant).unwrap().contains(",joint_03_angle_rad,"));
        let drives = fs::read_to_string(drives).unwrap();
        assert!(drives.contains(",joint_05_torque_n_m,") && !drives.contains("NaN"), "{drives}");
    }
}
