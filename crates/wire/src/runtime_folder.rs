//! The folder in which the files of all instances of a user lie. Nobody else may own or enter it: whoever does can pose
//! as controller or plant.

use std::fs::{DirBuilder, File, OpenOptions};
use std::io::{Error, ErrorKind};
use std::os::unix::fs::{DirBuilderExt, MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

use rustix::fs::OFlags;
use rustix::io::Errno;
use rustix::process::getuid;

/// The folder of this user: in `$XDG_RUNTIME_DIR`, in `/run/user/<user id>`, or in `/tmp`, the first that is there and
/// is safe. Nothing is created yet.
pub(crate) fn of_user() -> PathBuf {
    let user = getuid().as_raw();
    let given = std::env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from).filter(|folder| folder.is_absolute());
    let candidates = given.into_iter().chain([PathBuf::from(format!("/run/user/{user}"))]);
    let base = candidates.into_iter().find(|folder| open_own(folder).is_ok()).unwrap_or_else(|| "/tmp".into());
    of_user_in(&base)
}

/// The folder of this user in a folder for files of running programs.
pub(crate) fn of_user_in(base: &Path) -> PathBuf {
    // Without doubled slashes: all processes must write the path in the same way.
    base.join(format!("halfstep-{}", getuid().as_raw())).components().collect()
}

/// Creates a folder of [`of_user`], or one in it, if it is missing, and makes sure that no one else can enter it.
///
/// # Errors
/// The folder cannot be created, is a link, belongs to another user, or others may enter it.
pub(crate) fn create(folder: &Path) -> Result<(), Error> {
    match DirBuilder::new().mode(0o700).create(folder) {
        Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(error),
        _ => {}
    }
    open_own(folder).map(drop)
}

/// Opens a folder that belongs to this user and that nobody else may enter.
///
/// # Errors
/// The folder is missing, is a link, belongs to another user, or others may enter it.
pub(crate) fn open_own(folder: &Path) -> Result<File, Error> {
    let flags = OFlags::DIRECTORY | OFlags::NOFOLLOW;
    let opened = OpenOptions::new().read(true).custom_flags(flags.bits() as i32).open(folder);
    let opened = opened.map_err(|error| {
        let is_no_folder =
            [Errno::NOTDIR, Errno::LOOP].map(Errno::raw_os_error).contains(&error.raw_os_error().unwrap_or(0));
        if is_no_folder { refused(folder, "it is no folder, but a file or a link") } else { error }
    })?;
    let metadata = opened.metadata()?;
    if metadata.uid() != getuid().as_raw() {
        return Err(refused(folder, &format!("it belongs to the user {}", metadata.uid())));
    }
    if metadata.mode() & 0o077 != 0 {
        return Err(refused(folder, &format!("others may enter it (mode {:o})", metadata.mode() & 0o777)));
    }
    Ok(opened)
}

fn refused(folder: &Path, reason: &str) -> Error {
    let folder = folder.display();
    Error::new(
        ErrorKind::PermissionDenied,
        format!("{folder} is not safe to use: {reason}; remove it, or set XDG_RUNTIME_DIR to a folder of your own"),
    )
}

#[cfg(test)]
mod tests {
    use std::fs::{Permissions, create_dir, set_permissions, write};
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    /// A new folder that is removed at the end of the test.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("runtime-folder-{}-{name}", std::process::id()));
            DirBuilder::new().mode(0o700).create(&path).unwrap();
            Self(path)
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_folder_is_created_for_this_user_alone_and_used_again() {
        let scratch = Scratch::new("new");
        let folder = scratch.0.join("a");
        create(&folder).unwrap();
        assert_eq!(folder.metadata().unwrap().mode() & 0o777, 0o700);
        create(&folder).unwrap();
    }

    #[test]
    fn a_folder_that_others_may_enter_is_refused() {
        let scratch = Scratch::new("open");
        for mode in [0o777, 0o755, 0o770, 0o701] {
            let folder = scratch.0.join(format!("{mode:o}"));
            create_dir(&folder).unwrap();
            set_permissions(&folder, Permissions::from_mode(mode)).unwrap();
            let error = create(&folder).unwrap_err().to_string();
            assert!(error.contains("others may enter it"), "{error}");
        }
    }

    #[test]
    fn links_and_files_are_refused() {
        let scratch = Scratch::new("link");
        let (own, link, file) = (scratch.0.join("own"), scratch.0.join("link"), scratch.0.join("file"));
        create(&own).unwrap();
        symlink(&own, &link).unwrap();
        write(&file, "").unwrap();
        for path in [link, file] {
            let error = create(&path).unwrap_err().to_string();
            assert!(error.contains("it is no folder"), "{error}");
        }
    }

    #[test]
    fn a_folder_of_another_user_is_refused() {
        // The root folder belongs to root; for root, a folder that was given away.
        let scratch = Scratch::new("foreign");
        let folder = scratch.0.join("given");
        create(&folder).unwrap();
        let is_root = std::os::unix::fs::chown(&folder, Some(12_345), None).is_ok();
        let foreign = if is_root { folder } else { PathBuf::from("/") };
        let error = create(&foreign).unwrap_err().to_string();
        assert!(error.contains("it belongs to the user"), "{error}");
    }
}
