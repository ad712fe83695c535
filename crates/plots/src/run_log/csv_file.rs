//! Writes the log as CSV files.

use std::path::{Path, PathBuf};

use super::CsvRow;

/// Why a CSV file could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {cause}", path.display())]
pub struct CsvError {
    /// Path of the file.
    pub path: PathBuf,
    /// Why the operating system or the writer refused.
    pub cause: csv::Error,
}

/// Writes rows into their file in the folder `dir`, and returns its path.
///
/// # Errors
/// The file cannot be written.
pub fn write_rows<R: CsvRow>(dir: &Path, rows: &[R]) -> Result<PathBuf, CsvError> {
    let path = dir.join(R::FILE);
    let write = || -> Result<(), csv::Error> {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_path(&path)?;
        csv.write_record(R::columns())?;
        rows.iter().try_for_each(|row| csv.serialize(row))?;
        Ok(csv.flush()?)
    };
    match write() {
        Ok(()) => Ok(path),
        Err(cause) => Err(CsvError { path, cause }),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::{ControllerRow, PlantRow, synthetic};
    use super::*;

    #[test]
    fn csv_rows_have_as_many_values_as_columns() {
        let (log, dir) = (synthetic::log(1, 0.0), tempfile::tempdir().unwrap());
        let plant = write_rows(dir.path(), &log.plant).unwrap();
        let controller = write_rows(dir.path(), &log.controller).unwrap();
        for (file, columns, rows) in [
            (&plant, PlantRow::columns(), log.plant.len()),
            (&controller, ControllerRow::columns(), log.controller.len()),
        ] {
            let text = fs::read_to_string(file).unwrap();
            assert_eq!(text.lines().count(), rows + 1);
            assert!(text.lines().all(|line| line.split(',').count() == columns.len()), "{text}");
        }
        assert!(fs::read_to_string(plant).unwrap().contains(",joint_03_angle_rad,"));
    }
}
