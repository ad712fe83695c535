//! The files that a command writes: whether they can be written is known before the work, and no other file is replaced
//! unless that is wanted.

use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use crate::error::CliError;

/// A folder that a command writes into.
#[derive(Clone, Debug)]
pub(crate) struct OutputFolder {
    folder: PathBuf,
    /// Whether other files may be replaced.
    replaces: bool,
}

/// Bytes that are compared at a time.
const BLOCK: usize = 1 << 16;

impl OutputFolder {
    /// Makes sure that files can be written into a folder, which is made if it is not there.
    ///
    /// # Errors
    /// It cannot be made or written into.
    pub(crate) fn open(folder: &Path, replaces: bool) -> Result<Self, CliError> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        fs::create_dir_all(folder).map_err(CliError::file(folder))?;
        let opened = Self { folder: folder.to_owned(), replaces };
        let probe = opened.own_path();
        File::create(&probe).and_then(|_| fs::remove_file(&probe)).map_err(CliError::file(folder))?;
        Ok(opened)
    }

    /// The same for a single file: gives its folder, and its name there.
    ///
    /// # Errors
    /// Its folder cannot be made or written into, or it is no file.
    pub(crate) fn of_file(file: &Path, replaces: bool) -> Result<(Self, String), CliError> {
        let Some(name) = file.file_name().filter(|_| !file.is_dir()) else {
            return Err(CliError::bad_input(format!("{}: must be a file", file.display())));
        };
        let folder = Self::open(file.parent().unwrap_or(Path::new("")), replaces)?;
        Ok((folder, name.to_string_lossy().into_owned()))
    }

    /// Makes sure that none of these files is there: for results that are never twice the same.
    ///
    /// # Errors
    /// One is there, and is not to be replaced.
    pub(crate) fn require_none(&self, names: &[&str]) -> Result<(), CliError> {
        match names.iter().map(|name| self.folder.join(name)).find(|file| !self.replaces && file.exists()) {
            Some(file) => Err(would_replace(&file)),
            None => Ok(()),
        }
    }

    /// Writes files, given by name and text: all of them, or none if one would replace another file.
    ///
    /// # Errors
    /// A file would replace another one, or cannot be written.
    pub(crate) fn write<N: AsRef<str>>(&self, files: &[(N, String)]) -> Result<(), CliError> {
        let path = |name: &N| self.folder.join(name.as_ref());
        for (name, text) in files {
            let file = path(name);
            if !self.replaces && holds_other(&file, text.as_bytes(), text.len() as u64) {
                return Err(would_replace(&file));
            }
        }
        files.iter().try_for_each(|(name, text)| write_whole(&path(name), text))
    }

    /// Files that `make` writes into an empty folder, moved to their places; gives their names.
    ///
    /// # Errors
    /// A file would replace another one, or cannot be written.
    pub(crate) fn write_with(
        &self,
        make: impl FnOnce(&Path) -> Result<Vec<PathBuf>, CliError>,
    ) -> Result<Vec<String>, CliError> {
        let made_in = self.own_path();
        fs::create_dir(&made_in).map_err(CliError::file(&made_in))?;
        let moved = make(&made_in).and_then(|made| self.adopt(&made));
        // If it stays, it only takes space.
        let _ = fs::remove_dir_all(&made_in);
        moved
    }

    fn adopt(&self, made: &[PathBuf]) -> Result<Vec<String>, CliError> {
        let named = |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for file in made {
            let (place, length) = (self.folder.join(named(file)), fs::metadata(file).map_or(0, |file| file.len()));
            let other = File::open(file).map_err(CliError::file(file))?;
            if !self.replaces && holds_other(&place, other, length) {
                return Err(would_replace(&place));
            }
        }
        for file in made {
            fs::rename(file, self.folder.join(named(file))).map_err(CliError::file(file))?;
        }
        Ok(made.iter().map(named).collect())
    }

    /// The path of a file of the folder.
    pub(crate) fn join(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// A name in the folder that only this process uses.
    fn own_path(&self) -> PathBuf {
        self.folder.join(format!(".halfstep-{}", std::process::id()))
    }
}

/// Writes a file, or leaves nothing of it.
fn write_whole(file: &Path, text: &str) -> Result<(), CliError> {
    fs::write(file, text).map_err(|error| {
        // On a full disk: half a file is worse than none.
        let _ = fs::remove_file(file);
        CliError::file(file)(error)
    })
}

fn would_replace(file: &Path) -> CliError {
    CliError::bad_input(format!(
        "{}: holds something else; name another place with --out, or replace it with --force",
        file.display()
    ))
}

/// Whether a file is there and holds something else. What cannot be read cannot be replaced either: writing says why.
fn holds_other(file: &Path, same: impl Read, length: u64) -> bool {
    let Ok(existing) = File::open(file) else { return false };
    existing.metadata().is_ok_and(|existing| existing.len() != length)
        || !are_same(BufReader::new(existing), BufReader::new(same)).unwrap_or(true)
}

fn are_same(mut one: impl Read, mut other: impl Read) -> io::Result<bool> {
    let mut blocks = [vec![0; BLOCK], vec![0; BLOCK]];
    loop {
        let [first, second] = &mut blocks;
        let lengths = [read_block(&mut one, first)?, read_block(&mut other, second)?];
        if lengths[0] != lengths[1] || first[..lengths[0]] != second[..lengths[0]] {
            return Ok(false);
        }
        if lengths[0] == 0 {
            return Ok(true);
        }
    }
}

/// Reads until the block is full or the input ends.
fn read_block(input: &mut impl Read, block: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < block.len() {
        match input.read(&mut block[filled..])? {
            0 => break,
            read => filled += read,
        }
    }
    Ok(filled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_compared_to_their_ends() {
        let long = vec![7_u8; 3 * BLOCK / 2];
        let mut other = long.clone();
        assert!(are_same(&*long, &*other).unwrap());
        *other.last_mut().unwrap() = 8;
        assert!(!are_same(&*long, &*other).unwrap());
        assert!(!are_same(&*long, &long[1..]).unwrap());
        assert!(are_same(&b""[..], &b""[..]).unwrap());
    }
}
