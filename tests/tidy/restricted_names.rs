//! Only listed places may name the clock, files, threads and iceoryx2.

use crate::offence::Offence;
use crate::paths::{body_tokens, imports, inline_paths};
use crate::sources::Sources;
use crate::syntax::{Token, parse_without_tests};

/// Names that only listed places may use.
pub struct Restriction<'a> {
    /// What the names stand for, for the error message.
    pub what: &'a str,
    /// Sequences of path segments; a path that contains one of them is restricted.
    pub names: &'a [&'a [&'a str]],
    /// Files and folders that may use the names, each with its reason.
    pub allowed: &'a [(&'a str, &'a str)],
}

/// The clock: all other code takes time as an argument.
pub const CLOCK: Restriction<'_> = Restriction {
    what: "the clock",
    names: &[&["Instant"], &["SystemTime"], &["clock_gettime"], &["now_ns"]],
    allowed: &[
        ("crates/bench/src/", "measures it"),
        ("crates/cli/src/command/send.rs", "when a request expires"),
        ("crates/cli/src/command/status.rs", "how old a report is"),
        ("crates/cli/src/command/stream.rs", "how long a line waits"),
        ("crates/cli/src/process.rs", "how long a child process takes"),
        ("crates/node/src/controller_loop.rs", "how long a period takes"),
        ("crates/node/src/cycle.rs", "how long a run takes"),
        ("crates/node/src/plant_loop.rs", "how long a period takes"),
        ("crates/node/src/recorder.rs", "when a true pose is published"),
        ("crates/operator/src/command_stream.rs", "when a request expires"),
        ("crates/runtime/src/", "deadlines"),
        ("crates/teleop/src/session.rs", "how long a key is held"),
        ("crates/view/src/live_feed.rs", "when a frame is due"),
        ("crates/wire/src/push.rs", "time-out of a reply"),
        ("crates/wire/src/connect_lock.rs", "time-out of connecting"),
        ("crates/wire/src/request.rs", "time-out of a reply"),
        ("crates/wire/src/service_contract.rs", "time-out of connecting"),
    ],
};

/// The file system.
pub const FILES: Restriction<'_> = Restriction {
    what: "files",
    names: &[&["std", "fs"], &["File", "open"], &["File", "create"], &["OpenOptions"]],
    allowed: &[
        ("crates/bench/src/machine.rs", "properties of the machine"),
        ("crates/bench/src/raw_ring.rs", "shared memory measured by itself"),
        ("crates/cli/src/", "what people read and write"),
        ("crates/config/src/text.rs", "configuration files"),
        ("crates/gait/src/table_csv.rs", "the file of the nominal half-step"),
        ("crates/node/src/engine/environment.rs", "the Python environment of MuJoCo"),
        ("crates/node/src/engine/mujoco_program.rs", "the program of the MuJoCo plant"),
        ("crates/node/src/recorder.rs", "recordings"),
        ("crates/paper/src/scenario.rs", "scenarios"),
        ("crates/plots/src/run_log/csv_file.rs", "the tables of a run"),
        ("crates/record/src/", "recordings"),
        ("crates/runtime/src/scheduling.rs", "the cores that the system offers"),
        ("crates/view/src/floor_texts.rs", "the floor that a plant has told of"),
        ("crates/wire/src/connect_lock.rs", "the lock file"),
        ("crates/wire/src/leftovers.rs", "files left behind by a killed process"),
        ("crates/wire/src/running.rs", "the folders of all instances"),
        ("crates/wire/src/runtime_folder.rs", "the folder of all instances"),
        ("crates/wire/src/service_contract.rs", "files left behind by a killed process"),
        ("crates/wire/src/shared_memory.rs", "the files of an instance in shared memory"),
        ("crates/wire/src/urgent_socket.rs", "the socket file"),
    ],
};

/// The middleware: all other code sees the types of `wire`.
pub const ICEORYX2: Restriction<'_> = Restriction {
    what: "iceoryx2",
    names: &[&["iceoryx2"]],
    allowed: &[("crates/wire/src/", "wraps it"), ("crates/bench/src/", "measures it by itself")],
};

/// Threads: all other code runs on the thread of its caller.
pub const THREADS: Restriction<'_> = Restriction {
    what: "threads",
    names: &[&["thread", "spawn"], &["thread", "scope"], &["thread", "Builder"], &["JoinHandle"]],
    allowed: &[
        ("crates/bench/src/", "load, and partners to measure with"),
        ("crates/cli/src/command/bench.rs", "measures on a thread with a large stack"),
        ("crates/cli/src/command/doctor.rs", "asks for real-time scheduling on a thread that ends at once"),
        ("crates/cli/src/command/stream.rs", "reads lines while replies arrive"),
        ("crates/node/src/admission_worker.rs", "evaluates requests beside the loop"),
        ("crates/node/src/engine/external_engine.rs", "reads what the engine writes"),
        ("crates/node/src/push_bridge.rs", "exchanges pushes beside the loop"),
        ("crates/node/src/request_bridge.rs", "exchanges requests and replies beside the loop"),
        ("crates/paper/src/search/candidate_pool.rs", "judges candidates on all cores"),
        ("crates/python/src/batch.rs", "walks on all cores"),
        ("crates/runtime/src/journal.rs", "writes beside the loop"),
        ("crates/teleop/src/hangup.rs", "waits for the end of the terminal while it is read"),
        ("crates/view/src/server.rs", "watches and drives the robot while pages are served"),
    ],
};

/// Uses of restricted names outside the allowed places.
pub fn offences(sources: &Sources, restriction: &Restriction<'_>) -> Vec<Offence> {
    let mut offences = Vec::new();
    for (file, text) in sources.of_crates() {
        if restriction.allowed.iter().any(|(place, _)| file.starts_with(place)) {
            continue;
        }
        for (named, line) in named_in(file, text) {
            let is_restricted = |names: &&&[&str]| named.windows(names.len()).any(|part| part.iter().eq(names.iter()));
            if restriction.names.iter().any(|names| is_restricted(&names)) {
                let what = format!("`{}`: {} must not be named here", named.join("::"), restriction.what);
                offences.push(Offence::new(file, line, what));
            }
        }
    }
    offences
}

/// Rows of the allow-list that no file needs.
pub fn unneeded<'a>(sources: &Sources, restriction: &'a Restriction<'a>) -> Vec<&'a str> {
    let all = offences(sources, &Restriction { allowed: &[], ..*restriction });
    let is_needed = |place: &str| all.iter().any(|offence| offence.file.starts_with(place));
    restriction.allowed.iter().map(|(place, _)| *place).filter(|place| !is_needed(place)).collect()
}

/// All paths and identifiers that a file mentions outside tests, with their lines.
fn named_in(file: &str, text: &str) -> Vec<(Vec<String>, usize)> {
    let mut named = Vec::new();
    let mut open = vec![parse_without_tests(file, text).items];
    while let Some(items) = open.pop() {
        named.extend(imports(&items).into_iter().map(|import| (import.path.segments, import.path.line)));
        let body = body_tokens(&items);
        named.extend(inline_paths(&body).into_iter().map(|path| (path.segments, path.line)));
        named.extend(body.into_iter().map(|Token { text, line }| (vec![text], line)));
        open.extend(items.into_iter().filter_map(|item| match item {
            syn::Item::Mod(module) => module.content.map(|(_, items)| items),
            _ => None,
        }));
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_none;

    const REMEDY: &str = "Take it as an argument, or give this file a row with its reason in \
                          tests/tidy/restricted_names.rs.";

    fn check(restriction: &Restriction<'_>) {
        let sources = Sources::of_repository();
        assert_none(&offences(&sources, restriction), REMEDY);
        let unneeded = unneeded(&sources, restriction);
        assert!(unneeded.is_empty(), "take these off the list in tests/tidy/restricted_names.rs: {unneeded:?}");
    }

    #[test]
    fn only_loops_and_benches_name_the_clock() {
        check(&CLOCK);
    }

    #[test]
    fn only_what_reads_or_writes_files_names_files() {
        check(&FILES);
    }

    #[test]
    fn only_wire_and_bench_name_iceoryx2() {
        check(&ICEORYX2);
    }

    #[test]
    fn only_what_works_beside_a_loop_names_threads() {
        check(&THREADS);
    }

    #[test]
    fn a_restricted_name_is_found_in_imports_in_code_and_in_macros() {
        let text = "use std::{fs, io};\nfn f() { assert!(std::fs::File::open(\"x\").is_ok()) }\n\
                    #[cfg(test)] mod tests { use std::fs::write; }";
        let sources = Sources::sample(&[("crates/dynamics/src/lib.rs", text), ("crates/record/src/lib.rs", text)]);
        let mut lines: Vec<usize> = offences(&sources, &FILES).iter().map(|offence| offence.line).collect();
        lines.dedup();
        assert_eq!(lines, [1, 2]);
        assert!(offences(&sources, &CLOCK).is_empty());
    }
}
