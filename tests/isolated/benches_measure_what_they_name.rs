//! `halfstep bench` measures what it says, with numbers that can be, and judges by ratios.
//!
//! Method: as short as can be; what the numbers are is no matter of a test.

use halfstep_tests::command_line::CommandLine;
use serde_json::Value;

use crate::alone;

fn found(words: &str) -> Value {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let ended = command_line.run(&format!("bench {words} --out findings --json"));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let page = command_line.read("findings/bench.html");
    assert!(page.contains("<img"), "{words}: no histogram");
    let findings: Value =
        serde_json::from_str(&ended.stdout).unwrap_or_else(|error| panic!("{error}: {}", ended.stdout));
    for series in findings["series"].as_array().expect("series") {
        let [p50, p99, max] = ["p50_ns", "p99_ns", "max_ns"].map(|name| series[name].as_f64().unwrap_or(f64::NAN));
        assert!(0.0 < p50 && p50 <= p99 && p99 <= 1.01 * max, "{series}");
    }
    for ratio in findings["ratios"].as_array().expect("ratios") {
        assert!(ratio["ratio"].as_f64().is_some_and(|ratio| ratio > 0.0), "{ratio}");
    }
    findings
}

/// One after the other: they want the machine for themselves.
#[test]
fn benches_measure_computing_latency_and_jitter() {
    let _alone = alone();
    let wanted: [(&str, &[&str]); 3] = [
        (
            "compute --rounds 1 --slice 20ms",
            &["Newton–Euler", "forward dynamics", "plant", "controller tick", "preview", "forecast"],
        ),
        (
            "latency --rounds 1 --trips 500 --requests 1",
            &["setpoint + measurement", "ring in shared memory", "request → reply", "first changed setpoint"],
        ),
        (
            "jitter --segments 1 --segment 200ms",
            &[
                "loop, sleeping",
                "noise floor",
                "tick, p99 of each segment: recorded, shown and observed",
                "wake-up, p99 of each segment: beside stopped viewers",
            ],
        ),
    ];
    for (words, wanted) in wanted {
        let findings = found(words);
        let series = findings["series"].as_array().expect("series");
        let told = |name: &str| series.iter().any(|series| text_of(series).contains(name));
        for name in wanted {
            assert!(told(name), "{words}: {name} is not among what was found");
        }
    }
}

#[test]
fn nothing_is_measured_zero_times() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for words in
        ["compute --rounds 0", "latency --rounds 0", "latency --trips 0", "latency --requests 0", "jitter --segments 0"]
    {
        let ended = command_line.run(&format!("bench {words}"));
        assert_eq!(ended.code, Some(2), "{words}: {}", ended.stderr);
        assert!(ended.stderr.contains("0 is not in 1.."), "{words}: {}", ended.stderr);
    }
}

fn text_of(series: &Value) -> String {
    ["group", "name"].map(|key| series[key].as_str().unwrap_or_default()).join(": ")
}
