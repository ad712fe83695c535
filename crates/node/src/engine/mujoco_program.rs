//! The program of the MuJoCo plant: Python files that are part of this one, written to disk to be run.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::text_hash::text_hash;

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../../tools/mujoco_plant/", $name)))),*]
    };
}

/// Names and texts of the files. Python runs the folder that holds them.
const FILES: [(&str, &str); 9] = files![
    "__main__.py",
    "plant/__init__.py",
    "plant/floor.py",
    "plant/protocol.py",
    "plant/robot.py",
    "plant/serve.py",
    "plant/urdf.py",
    "plant/urdf_model.py",
    "plant/urdf_robot.py",
];

/// Writes the program into a folder within `parent`, unless it is there; returns the folder.
///
/// Its name depends on its content: a walk with another version of it may be running.
///
/// # Errors
/// What could not be written, and why.
pub(super) fn write(parent: &Path) -> Result<PathBuf, (PathBuf, io::Error)> {
    let content: Vec<&str> = FILES.iter().flat_map(|(name, text)| [*name, *text]).collect();
    let folder = parent.join(format!("plant-{:016x}", text_hash(&content.concat())));
    for (name, text) in FILES {
        let file = folder.join(name);
        if fs::read_to_string(&file).ok().as_deref() != Some(text) {
            write_whole(&file, text).map_err(|error| (file, error))?;
        }
    }
    Ok(folder)
}

/// Writes a file so that it is there with all of its text or not at all: other walks may start at the same time.
fn write_whole(file: &Path, text: &str) -> io::Result<()> {
    fs::create_dir_all(file.parent().unwrap_or(file))?;
    let unfinished = file.with_extension(std::process::id().to_string());
    fs::write(&unfinished, text)?;
    fs::rename(&unfinished, file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_package_is_written_and_a_spoilt_one_anew() {
        let parent = std::env::temp_dir().join(format!("mujoco-program-{}", std::process::id()));
        let folder = write(&parent).unwrap();
        let package = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tools/mujoco_plant/plant");
        for entry in fs::read_dir(package).unwrap().map(|entry| entry.unwrap().path()) {
            let name = entry.file_name().unwrap();
            if entry.extension().is_some_and(|extension| extension == "py") {
                assert_eq!(fs::read(folder.join("plant").join(name)).unwrap(), fs::read(&entry).unwrap(), "{entry:?}");
            }
        }
        let spoilt = folder.join("plant/robot.py");
        fs::write(&spoilt, "half of it").unwrap();
        assert_eq!(write(&parent).unwrap(), folder);
        assert!(fs::read_to_string(&spoilt).unwrap().contains("class Robot"));
        fs::remove_dir_all(&parent).unwrap();
    }
}
