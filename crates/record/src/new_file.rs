//! New files for recordings. What was recorded before is never overwritten: it is set aside under another name.

use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::{RecordError, files_of};

/// Creates a file that this process alone writes to. An earlier one of this name is [set aside](set_aside).
///
/// # Errors
/// Another process is writing to the file, or it cannot be created.
pub(crate) fn create(path: &Path) -> Result<File, RecordError> {
    set_aside(path)?;
    let file = File::create_new(path).map_err(RecordError::io(path))?;
    require_unused(path, &file)?;
    Ok(file)
}

/// Gives an earlier recording the next free name: `run.mcap` becomes `run-1.mcap`. Without one nothing happens.
///
/// # Errors
/// Another process is writing to it, or it cannot be renamed.
pub fn set_aside(path: &Path) -> Result<(), RecordError> {
    match File::open(path) {
        Ok(earlier) => require_unused(path, &earlier)?,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(RecordError::io(path)(error)),
    }
    fs::rename(path, free_name(path)).map_err(RecordError::io(path))
}

/// Gives a folder that holds a run the next free name: `run` becomes `run-1`, which is returned. Without a run nothing
/// happens.
///
/// # Errors
/// Another process is writing to the run, or the folder cannot be renamed.
pub fn set_folder_aside(folder: &Path) -> Result<Option<PathBuf>, RecordError> {
    if !folder.is_dir() {
        return Ok(None);
    }
    let Ok(files) = files_of(folder) else { return Ok(None) };
    for file in files {
        require_unused(&file, &File::open(&file).map_err(RecordError::io(&file))?)?;
    }
    let free = free_name(folder);
    fs::rename(folder, &free).map_err(RecordError::io(folder))?;
    Ok(Some(free))
}

/// Makes sure that no process writes to a file.
fn require_unused(path: &Path, file: &File) -> Result<(), RecordError> {
    match file.try_lock() {
        Ok(()) => Ok(()),
        Err(TryLockError::WouldBlock) => Err(RecordError::InUse { file: path.to_owned() }),
        Err(TryLockError::Error(error)) => Err(RecordError::io(path)(error)),
    }
}

/// The first name with a number that is free.
fn free_name(path: &Path) -> PathBuf {
    let free = (1..).map(|number| numbered(path, number)).find(|free| !free.exists());
    free.unwrap_or_else(|| path.to_owned())
}

/// `run.mcap` with a number: `run-1.mcap`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map(|ending| format!(".{}", ending.to_string_lossy())).unwrap_or_default();
    path.with_file_name(format!("{stem}-{number}{ending}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_files_are_set_aside_and_files_in_use_are_refused() {
        let folder = std::env::temp_dir().join(format!("new-file-{}", std::process::id()));
        fs::create_dir(&folder).unwrap();
        let path = folder.join("run.mcap");
        let text = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        for number in 0..3 {
            let file = create(&path).unwrap();
            fs::write(&path, number.to_string()).unwrap();
            assert!(matches!(create(&path), Err(RecordError::InUse { .. })));
            drop(file);
        }
        assert_eq!([text("run-1.mcap"), text("run-2.mcap"), text("run.mcap")], ["0", "1", "2"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
