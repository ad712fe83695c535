//! Goal: whatever text a file holds, its loader ends: with what it read, or with words. `PROPTEST_CASES` sets how many
//! texts are tried.

use std::time::Duration;

use proptest::prelude::*;
use rustix::time::{ClockId, clock_gettime};

use super::loaders::files;

/// A text made of pieces of the committed one and of others.
fn spoilt(text: &str, changes: &[(f64, f64, usize)]) -> String {
    const OTHERS: [&str; 24] = [
        "",
        "[",
        "]",
        "[[",
        "\"",
        "=",
        "\n",
        ",",
        "<a>",
        "</a>",
        "<",
        "&",
        "1e999",
        "-1e308",
        "nan",
        "5e-324",
        "0",
        "-1",
        "{",
        "}",
        "\u{0}",
        "é",
        "#",
        "\n[joint.right_knee]\n",
    ];
    let mut text = text.to_owned();
    for (place, length, what) in changes {
        let at = |share: f64| text.floor_char_boundary((share * text.len() as f64) as usize);
        let from = at(*place);
        let to = text.floor_char_boundary((from + (length * 40.0) as usize).min(text.len())).max(from);
        let piece = text[from..to].to_owned();
        match OTHERS.get(*what) {
            Some(other) => text.replace_range(from..to, other),
            None => text.insert_str(at(1.0 - place), &piece),
        }
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), ..ProptestConfig::with_source_file(file!()) })]

    #[test]
    fn any_text_of_a_file_is_read_or_refused(
        which in 0..12_usize,
        changes in proptest::collection::vec((0.0..1.0, 0.0..1.0, 0..28_usize), 1..8),
    ) {
        let file = &files()[which];
        if let Err(words) = file.load(&spoilt(&file.text, &changes)) {
            prop_assert!(!words.is_empty(), "{} is refused without a word", file.name);
        }
    }
}

/// A run of seconds; more where the environment asks for it.
fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(500)
}

/// How long this thread has computed, whatever else the machine does.
fn computed_for() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// What was made to hurt: nested, long, or many.
#[test]
fn bombs_are_refused_at_once() {
    let megabytes = |piece: &str| piece.repeat((20 << 20) / piece.len());
    for file in files() {
        let head = &file.text[..file.text.len() / 2];
        let bombs = [
            format!("{head}\na = {}", "[".repeat(1_000_000)),
            format!("{head}{}", "<a>".repeat(1_000_000)),
            format!("{head}\n{}", megabytes("[[push]]\n")),
            format!("{head}\n{}", (0..50_000).map(|key| format!("k{key} = {key}\n")).collect::<String>()),
            format!("{head}\nname = \"{}\"", megabytes("x")),
            megabytes(&file.text),
            megabytes("\n"),
        ];
        for (number, bomb) in bombs.iter().enumerate() {
            let began = computed_for();
            let words = file.load(bomb).err();
            let took = computed_for() - began;
            // What hangs takes minutes.
            assert!(took < Duration::from_secs(20), "{}: bomb {number} took {took:?}", file.name);
            if let Some(words) = words {
                assert!(words.len() < 1 << 20, "{}: bomb {number} is refused with {} bytes", file.name, words.len());
            }
        }
    }
}
