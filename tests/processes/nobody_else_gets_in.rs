//! Another unprivileged user can neither steer, stop, watch nor lock out a robot, and root does not break a user's
//! robot by using the same name.
//!
//! Needs root, which can become another user; says so when it did not run.

use std::fs;
use std::os::unix::fs::{PermissionsExt, chown, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use halfstep_tests::command_line::{CommandLine, Running};

const NOBODY: u32 = 65_534;

/// Whether this process can become another user.
fn is_root() -> bool {
    let is_root = rustix::process::getuid().is_root() && as_nobody("true").status.success();
    if !is_root {
        eprintln!("NOT RUN: attacks by another user, because this is not root, or there is no setpriv");
    }
    is_root
}

/// A shell command of another user.
fn as_nobody(command: &str) -> Output {
    let mut setpriv = Command::new("setpriv");
    setpriv.args([&format!("--reuid={NOBODY}"), &format!("--regid={NOBODY}"), "--clear-groups", "sh", "-c", command]);
    setpriv.env_remove("XDG_RUNTIME_DIR").current_dir("/").output().unwrap_or_else(|_| Output {
        status: std::os::unix::process::ExitStatusExt::from_raw(1 << 8),
        stdout: Vec::new(),
        stderr: Vec::new(),
    })
}

/// A pair that walks, with the folder of the processes open to look at, as `/tmp` is.
fn walking(command_line: &CommandLine) -> [Running; 2] {
    fs::set_permissions(command_line.folder(), fs::Permissions::from_mode(0o755)).unwrap();
    let pair = ["controller", "plant"].map(|role| command_line.start_here(role));
    command_line.wait_for_controller();
    pair
}

fn files_in_memory(command_line: &CommandLine) -> Vec<PathBuf> {
    let prefix = command_line.wire_instance().prefix();
    let files = fs::read_dir("/dev/shm").unwrap().flatten().map(|file| file.path());
    files.filter(|path| path.file_name().unwrap().to_string_lossy().starts_with(&prefix)).collect()
}

#[test]
fn another_user_can_neither_read_nor_change_anything_of_a_walking_robot() {
    if !is_root() {
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let pair = walking(&command_line);
    let mut files = files_in_memory(&command_line);
    // Connections of those who have just asked whether the controller is there go with them.
    files.retain(|file| file.extension().is_some_and(|kind| kind != "connection"));
    assert!(files.len() > 8, "{files:?}");
    let folder = command_line.wire_instance().folder();
    for file in files.iter().map(PathBuf::as_path).chain([&*folder.join("turn"), &*folder.join("urgent"), folder]) {
        let file = file.display();
        for attack in [
            format!("cat {file}"),
            format!("head -c 16 /dev/zero > {file}"),
            format!("truncate -s 0 {file}"),
            format!("rm -rf {file}"),
            format!("mv {file} {file}.moved"),
            format!("chmod 666 {file}"),
            format!("ln -sf /etc/hostname {file}"),
        ] {
            let tried = as_nobody(&attack);
            assert!(!tried.status.success(), "`{attack}` succeeded");
        }
    }
    assert!(files.iter().all(|file| file.exists()));
    let sent = command_line.start_here("send stop").finish();
    assert_eq!(sent.code, Some(0), "{}", sent.stderr);
    pair.into_iter().for_each(|process| assert_ne!(process.end().code, None));
}

#[test]
fn a_file_that_another_user_has_prepared_in_shared_memory_is_refused() {
    if !is_root() {
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let first = command_line.start_here("controller");
    command_line.wait_for_controller();
    let files = files_in_memory(&command_line);
    let foreseen = files.iter().find(|file| file.display().to_string().ends_with(".global_mgmt")).unwrap();
    first.end();
    assert!(!foreseen.exists(), "a clean exit leaves nothing");

    let made = as_nobody(&format!("head -c 16 /dev/zero > {0} && chmod 666 {0}", foreseen.display()));
    assert!(made.status.success(), "anyone may create files there");
    for words in ["controller", "plant", "walk --for 100ms"] {
        let ended = command_line.start_here(words).finish();
        assert_eq!(ended.code, Some(1), "{words}: {}", ended.stderr);
        assert!(ended.stderr.contains("it belongs to the user 65534"), "{words}: {}", ended.stderr);
    }
    fs::remove_file(foreseen).unwrap();
    assert_eq!(command_line.start_here("walk --lockstep --for 300ms --out own").finish().code, Some(0));
}

/// A copy of the program that another user may execute.
fn program_for_others(folder: &Path) -> PathBuf {
    let program = folder.join("halfstep");
    fs::copy(env!("CARGO_BIN_EXE_halfstep-under-test"), &program).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    program
}

#[test]
fn another_user_is_told_whose_instance_it_is_and_leaves_nothing() {
    if !is_root() {
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let pair = walking(&command_line);
    let program = program_for_others(command_line.folder());
    for words in ["stop", "turn 5"] {
        let send = format!("{} send --instance {} {words}", program.display(), command_line.instance());
        let told = as_nobody(&send);
        let told = String::from_utf8_lossy(&told.stderr).into_owned();
        assert!(told.contains("root runs an instance of this name: use the same user"), "{told}");
    }
    assert!(!Path::new(&format!("/tmp/halfstep-{NOBODY}/{}", command_line.instance())).exists());
    pair.into_iter().for_each(|process| assert_eq!(process.end().code, Some(0)));
}

#[test]
fn a_folder_that_another_user_has_prepared_is_refused() {
    if !is_root() {
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let own = command_line.runtime_folder().join("halfstep-0");
    let instance = own.join(command_line.instance());
    let victim = command_line.folder().join("work");
    fs::create_dir(&victim).unwrap();
    fs::write(victim.join("thesis"), "whole").unwrap();
    fs::set_permissions(&victim, fs::Permissions::from_mode(0o700)).unwrap();

    let refused = |what: &str| {
        for words in ["controller", "plant", "walk --for 100ms"] {
            let ended = command_line.start_here(words).finish();
            assert_eq!(ended.code, Some(1), "{what}, {words}: {}", ended.stderr);
            assert!(ended.stderr.contains("is not safe to use"), "{what}, {words}: {}", ended.stderr);
        }
        assert_eq!(fs::read_to_string(victim.join("thesis")).unwrap(), "whole", "{what}");
    };
    for path in [&own, &instance] {
        fs::create_dir(path).unwrap();
        chown(path, Some(NOBODY), Some(NOBODY)).unwrap();
        refused("a folder of another user");
        fs::remove_dir_all(path).unwrap();

        fs::create_dir(path).unwrap();
        fs::set_permissions(path, fs::Permissions::from_mode(0o777)).unwrap();
        refused("a folder for everybody");
        fs::remove_dir_all(path).unwrap();

        symlink(&victim, path).unwrap();
        refused("a link");
        fs::remove_file(path).unwrap();
        // The instance's folder lies in one of its own.
        std::os::unix::fs::DirBuilderExt::mode(&mut fs::DirBuilder::new(), 0o700).create(path).unwrap();
    }

    // A link in the place of the lock file.
    symlink(victim.join("thesis"), instance.join("turn")).unwrap();
    let ended = command_line.start_here("controller").finish();
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert_eq!(fs::read_to_string(victim.join("thesis")).unwrap(), "whole");
}

/// Root starts a walk under the name of a user's robot, with its own runtime folder and with that of the user.
#[test]
fn root_does_not_break_a_users_robot() {
    if !is_root() {
        return;
    }
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    fs::set_permissions(command_line.folder(), fs::Permissions::from_mode(0o777)).unwrap();
    let program = program_for_others(command_line.folder());
    let base = command_line.folder().join("of-nobody");
    fs::create_dir(&base).unwrap();
    fs::set_permissions(&base, fs::Permissions::from_mode(0o700)).unwrap();
    chown(&base, Some(NOBODY), Some(NOBODY)).unwrap();

    let of_nobody = |words: &str| {
        let program = program.display();
        let instance = command_line.instance();
        let (base, folder) = (base.display(), command_line.folder().display());
        format!("cd {folder} && XDG_RUNTIME_DIR={base} exec {program} {words} --instance {instance}")
    };
    let pair = ["controller --for 300s", "plant --for 300s"].map(|words| {
        let mut setpriv = Command::new("setpriv");
        setpriv.args([&format!("--reuid={NOBODY}"), &format!("--regid={NOBODY}"), "--clear-groups"]);
        setpriv.args(["sh", "-c", &of_nobody(words)]).stderr(std::process::Stdio::null()).spawn().unwrap()
    });
    let asked = (0..3000).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(20));
        as_nobody(&of_nobody("send turn 3")).status.success()
    });
    assert!(asked, "the user's controller does not answer");

    let own = command_line.start_here("walk --lockstep --for 500ms --out own").finish();
    assert_eq!(own.code, Some(0), "{}", own.stderr);
    let mut with_theirs = Command::new(&program);
    with_theirs.args([
        "walk",
        "--lockstep",
        "--for",
        "500ms",
        "--out",
        "theirs",
        "--instance",
        command_line.instance(),
    ]);
    with_theirs.current_dir(command_line.folder()).env("XDG_RUNTIME_DIR", &base);
    assert!(with_theirs.output().unwrap().status.success(), "root has a runtime folder of its own");

    let still = as_nobody(&of_nobody("send turn -3"));
    assert!(still.status.success(), "{}", String::from_utf8_lossy(&still.stderr));
    let stop = as_nobody(&of_nobody("send stop"));
    assert!(stop.status.success(), "{}", String::from_utf8_lossy(&stop.stderr));
    for mut process in pair {
        Command::new("kill").args(["-INT", &process.id().to_string()]).status().unwrap();
        assert!(process.wait().unwrap().code().is_some(), "it ends by itself when asked to");
    }
}
