//! The log as CSV files.

use std::path::{Path, PathBuf};

use super::Row;
use crate::failure::Failure;

/// Writes rows into their file in the folder `dir`, and says which that is.
///
/// # Errors
/// The operating system says no.
pub fn write_rows<R: Row>(dir: &Path, rows: &[R]) -> Result<PathBuf, Failure> {
    let path = dir.join(R::FILE);
    let write = || -> Result<(), csv::Error> {
        let mut csv = csv::WriterBuilder::new().has_headers(false).from_path(&path)?;
        csv.write_record(R::columns())?;
        rows.iter().try_for_each(|row| csv.serialize(row))?;
        Ok(csv.flush()?)
    };
    write().map_err(|error| Failure::new(format!("{}: {error}", path.display())))?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::{ControllerRow, PlantRow, synthetic};
    use super::*;

    #[test]
    fn every_value_has_a_column() {
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
